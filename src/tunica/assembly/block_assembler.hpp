#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "tunica/assembly/constraints.hpp"
#include "tunica/fields/embed_field.hpp"
#include "tunica/kernels/surface_tri3.hpp"
#include "tunica/kernels/tet4.hpp"

namespace tunica::assembly {

class CommonMotions;

/// The elements that a pack of kernels' results belongs to: the first n of its lanes; the others
/// hold the last of them again.
struct PackedElements {
  std::array<std::size_t, Pack::size> number;
  int n;

  /// The next elements, from first on, of count.
  PackedElements(std::size_t first, std::size_t count)
      : n(static_cast<int>(std::min<std::size_t>(Pack::size, count - first))) {
    for (int lane = 0; lane < Pack::size; ++lane) number[lane] = first + std::min(lane, n - 1);
  }
};

/// Residual of a field on the owned nodes, before Dirichlet rows are removed, so that it holds
/// the reactions there.
struct NodalResidual {
  std::vector<Vec3> u;
  std::vector<double> p;

  /// split: carries the scalars where it is not null. It must outlive the object.
  explicit NodalResidual(const fields::FieldMesh& mesh, const fields::SplitMesh* split = nullptr)
      : u(mesh.n_owned), p(fields::scalar_mesh(mesh, split).n_owned), split_(split) {}
  void set_zero();
  void add(const fields::FieldMesh& mesh, const PackedElements& elements,
           const kernels::MixedResidualOf<Pack>& R);
  void add(const fields::FieldMesh& mesh, const fields::Face& face,
           const kernels::SurfaceResidual& R);
  /// Copies into F with zeros in the constrained rows.
  void store(const Constraints& fixed, algebra::BlockVector& F) const;

private:
  const fields::SplitMesh* split_;
};

/// An element's Jacobian by pairs of its nodes: k[a][b][i][j] is ∂R_ai/∂x_bj, the scalar last.
struct alignas(sizeof(Pack)) ElementMatrix {
  double k[4][4][4][4];
};

/// Rows of the unknowns of an element's nodes; null if they are on other ranks.
struct ElementRows {
  double *vector[4], *scalar[4];  ///< of component 0
  std::size_t length[4];          ///< of the vector's rows
};

/// The Jacobian that the Jacobian of a field is part of: that of several fields, in which the field
/// has other numbers and units. Without place and units it is the field's own, which finish()
/// completes.
struct Whole {
  fields::BlockOperator* K;         ///< open for writing
  const fields::FieldPlace* place;  ///< of the field's elements and nodes
  const algebra::Embedding* units;  ///< of its unknowns and equations
};

/// Writes element Jacobians straight into the values of a BlockOperator.
///
/// Constrained rows and columns keep only their diagonal, summed like any other entry, so
/// that it has the size of its neighbours; the increments there are zero, so that the dropped
/// columns need no right-hand side. Across the axes they are projected, see constrain() in the
/// source. Products of vectors go to a part of low rank in the numbers and
/// units of the field, which has as many as are added.
class BlockAssembler {
public:
  /// To the field's own Jacobian, whose products are those that K has: writing begins with zeros
  /// and ends with finish(). motions: take what they need of the dropped rows and columns; may be
  /// null.
  BlockAssembler(fields::BlockOperator& K, const Constraints& fixed,
                 CommonMotions* motions = nullptr);
  /// Added to a larger one; products may be null where there are none.
  BlockAssembler(const Whole& whole, const fields::FieldMesh& mesh, const Constraints& fixed,
                 CommonMotions* motions, algebra::LowRank* products);
  /// Finds the rows of the elements that add() is given next, once, and asks for them: their
  /// kernels take longer than memory does.
  void begin(const PackedElements& elements);
  void add(const kernels::MixedJacobianOf<Pack>& Ke);
  void add(const fields::Face& face, const kernels::SurfaceJacobian& Ke);
  /// s w vᵀ on the vector unknown, given on the owned nodes.
  void add(double s, const std::vector<Vec3>& w, const std::vector<Vec3>& v);
  void finish();

private:
  BlockAssembler(const Whole& whole, const fields::FieldMesh& mesh, const Constraints& fixed,
                 CommonMotions* motions, algebra::LowRank* products, double* values);

  int node_of(int a) const { return place_ != nullptr ? place_->nodes[a] : a; }
  /// The tetrahedron of K's mesh that element e of the field is.
  std::size_t tet_of(std::size_t e) const { return place_ != nullptr ? place_->tets[e] : e; }
  ElementRows rows_of(std::size_t tet) const;
  void scatter(std::size_t tet, const ElementRows& rows, const ElementMatrix& Ke);
  /// Diagonal of the vector unknowns at the owned nodes, in the field's units.
  Vector diagonal() const;

  fields::BlockOperator* K_;
  const fields::FieldPlace* place_;  ///< null: K is the field's own
  const fields::FieldMesh* mesh_;    ///< of the field
  const Constraints* fixed_;
  CommonMotions* motions_;
  algebra::LowRank* products_;
  double* values_;
  double units_[2][2];             ///< of the blocks
  PackedElements elements_{0, 0};  ///< of begin(), until they are added
  ElementRows rows_[Pack::size];   ///< theirs
  int next_product_ = 0;
};

}  // namespace tunica::assembly
