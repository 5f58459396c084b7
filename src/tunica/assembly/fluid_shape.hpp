#pragma once
#include "tunica/assembly/fluid_assembly.hpp"

namespace tunica::assembly {

/// What the displacement of its mesh makes of the fluid's residual: ∂F/∂d with rows of velocity and
/// pressure and columns 3*node + j. Faces are left out: they are those of surfaces that stand
/// still.
class FluidShapeMatrix {
public:
  /// The fluid's mesh and the graph of its nodes; they must outlive the object.
  FluidShapeMatrix(const fields::FieldMesh& mesh, const fields::NodeGraph& graph);

  /// Sets the values for a state; velocity: the one that τ is made of, on local nodes. Constrained
  /// rows are zero.
  void assemble(const FluidElements& elements, const FluidFields& state,
                const std::vector<Vec3>& velocity, const Constraints& fixed);
  /// F ← F + ∂F/∂d d.
  void add(const Vector& d, algebra::BlockVector& F) const;

private:
  void add(std::size_t e, const kernels::ShapeJacobian& Ke, const Constraints& fixed);

  const fields::FieldMesh* mesh_;
  const fields::NodeGraph* graph_;
  Teuchos::RCP<CrsMatrix> u_, p_;
};

}  // namespace tunica::assembly
