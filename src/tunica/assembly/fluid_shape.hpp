#pragma once
#include "tunica/assembly/fluid_assembly.hpp"

namespace tunica::assembly {

/// ALE shape derivatives of the fluid's residual, by the displacement of its mesh: ∂F/∂d with rows
/// of velocity and pressure and columns 3*node + j. Constrained rows are zero. Loads on open
/// surfaces may add products s w vᵀ of all of a surface.
class FluidShapeMatrix {
public:
  /// The fluid's mesh, the graph of its nodes and what is prescribed at them; they must outlive the
  /// object.
  FluidShapeMatrix(const fields::FieldMesh& mesh, const fields::NodeGraph& graph,
                   const Constraints& fixed);

  /// Begins anew with the elements of a state; velocity: the one that τ is made of, on local nodes.
  void begin(const FluidElements& elements, const FluidFields& state,
             const std::vector<Vec3>& velocity);
  /// Adds ∂R/∂x of a face.
  void add(const fields::Face& face, const kernels::SurfaceJacobian& Ke);
  /// Adds s w vᵀ, w of the momentum's rows, v of displacements, given on the owned nodes.
  void add(double s, const std::vector<Vec3>& w, const std::vector<Vec3>& v);
  void finish();

  /// F ← F + ∂F/∂d d. Collective.
  void add_product(const Vector& d, algebra::BlockVector& F) const;

private:
  using Values = CrsMatrix::local_matrix_host_type::values_type;

  void add(const Values& u, int a, std::size_t column_of_b, const double (&k)[3][3]) const;
  void add(std::size_t e, const kernels::ShapeJacobian& Ke);

  struct Product {
    double scale;
    Vector w, v;
  };

  const fields::FieldMesh* mesh_;
  const fields::NodeGraph* graph_;
  const Constraints* fixed_;
  Teuchos::RCP<CrsMatrix> u_, p_;
  std::vector<Product> products_;
};

}  // namespace tunica::assembly
