#pragma once
#include <cstdint>
#include <vector>

#include "tunica/fields/block_operator.hpp"
#include "tunica/kernels/surface_tri3.hpp"
#include "tunica/kernels/tet4.hpp"

namespace tunica::assembly {

class CommonMotions;

/// Dirichlet dofs of the local nodes: bits 0, 1, 2 for the components of the vector unknown,
/// bit 3 for the scalar one.
using Constraints = std::vector<std::uint8_t>;
constexpr std::uint8_t fixed_vector = 7;
constexpr std::uint8_t fixed_scalar = 8;

/// Residual of a field on the owned nodes, before Dirichlet rows are removed, so that it holds
/// the reactions there.
struct NodalResidual {
  std::vector<Vec3> u;
  std::vector<double> p;

  /// split: carries the scalars where it is not null. It must outlive the object.
  explicit NodalResidual(const fields::FieldMesh& mesh, const fields::SplitMesh* split = nullptr)
      : u(mesh.n_owned), p(fields::scalar_mesh(mesh, split).n_owned), split_(split) {}
  void set_zero();
  void add(const fields::FieldMesh& mesh, std::size_t e, const kernels::MixedResidual& R);
  void add(const fields::FieldMesh& mesh, const fields::Face& face,
           const kernels::SurfaceResidual& R);
  /// Copies into F with zeros in the constrained rows.
  void store(const fields::FieldMesh& mesh, const Constraints& fixed,
             algebra::BlockVector& F) const;

private:
  const fields::SplitMesh* split_;
};

/// Writes element Jacobians straight into the values of a BlockOperator's four matrices.
///
/// Constrained rows and columns keep only their diagonal, summed like any other entry, so
/// that it has the size of its neighbours; the increments there are zero, so that the dropped
/// columns need no right-hand side. Writing begins with zeros and ends with finish(). Products of
/// vectors go to the operator's part of low rank, which has as many as are added.
class BlockAssembler {
public:
  /// motions: take what they need of the dropped rows and columns; may be null.
  BlockAssembler(fields::BlockOperator& K, const Constraints& fixed,
                 CommonMotions* motions = nullptr);
  void add(std::size_t e, const kernels::MixedJacobian& Ke);
  void add(const fields::Face& face, const kernels::SurfaceJacobian& Ke);
  /// s w vᵀ on the vector unknown, given on the owned nodes.
  void add(double s, const std::vector<Vec3>& w, const std::vector<Vec3>& v);
  void finish();

private:
  void scatter(std::size_t e, const kernels::MixedJacobian& Ke);

  fields::BlockOperator* K_;
  const fields::FieldMesh *mesh_, *scalar_mesh_;
  const Constraints* fixed_;
  CommonMotions* motions_;
  double *A_, *B1T_, *B2_, *mC_;
  int next_product_ = 0;
};

}  // namespace tunica::assembly
