#pragma once
#include "tunica/assembly/block_assembler.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/boundary/surface_terms.hpp"
#include "tunica/discretisation/discretisation.hpp"

namespace tunica::discretisation {

/// What fluid and wall have in common: a vector and a scalar at each node, whose residual and
/// Jacobian are summed over elements and faces.
class MixedField : public Discretisation {
public:
  const fields::FieldMesh& mesh() const { return *mesh_; }
  const fields::NodeGraph& graph() const { return K_.graph(); }
  /// Elements of all Jacobians so far and the time they took on this rank.
  const Throughput& throughput() const { return throughput_; }

  // Discretisation
  const algebra::BlockSpacePtr& space() const override { return K_.space(); }
  bool residual(const algebra::BlockVector& x, algebra::BlockVector& F) override;
  void assemble_jacobian(const algebra::BlockVector& x) override;
  const fields::BlockOperator& jacobian() const override { return K_; }
  double mass_norm(const algebra::BlockVector& dx) const override;

  /// What the surfaces remember from step to step, see boundary::SurfaceTerms.
  void save_surfaces(fields::State& state) const { surfaces_.save(state); }
  std::string restore_surfaces(const fields::State& state) { return surfaces_.restore(state); }

protected:
  /// mesh must outlive the object. Collective.
  MixedField(const fields::FieldMesh& mesh, const fields::NodalBlocks& blocks,
             const std::vector<boundary::Condition>& conditions,
             const std::vector<boundary::ConditionEntry>& registry);

  /// Takes the values at x to owned and ghost nodes. Collective.
  virtual void read(const algebra::BlockVector& x) = 0;
  /// False where the values read cannot be assembled, on all ranks alike.
  virtual bool is_admissible() { return true; }
  /// Fills R_, and K where it is not null, for the values read.
  virtual void assemble(assembly::BlockAssembler* K) = 0;
  /// What the terms of the surfaces see, of the values read.
  virtual boundary::Surroundings surroundings() const = 0;
  /// Moves the states of the surfaces on to x, which is accepted. Collective.
  void end_step_on_surfaces(const algebra::BlockVector& x);
  /// The elements on which masses are taken.
  virtual const std::vector<kernels::Tet4>& geometry() const = 0;

  const fields::FieldMesh* mesh_;
  boundary::SurfaceTerms surfaces_;
  assembly::Constraints fixed_;  ///< per local node
  fields::BlockOperator K_;
  assembly::NodalResidual R_;

private:
  Throughput throughput_;
};

}  // namespace tunica::discretisation
