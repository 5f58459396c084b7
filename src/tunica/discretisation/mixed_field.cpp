#include "tunica/discretisation/mixed_field.hpp"

#include "tunica/assembly/mass_norm.hpp"

namespace tunica::discretisation {

MixedField::MixedField(const fields::FieldMesh& mesh, const fields::NodalBlocks& blocks,
                       const std::vector<boundary::Condition>& conditions,
                       const std::vector<boundary::ConditionEntry>& registry)
    : mesh_(&mesh), surfaces_(conditions, registry, mesh), fixed_(mesh.n_nodes(), 0),
      K_(mesh, blocks), R_(mesh) {
  surfaces_.constrain(fixed_);
  if (surfaces_.rank() > 0) K_.make_low_rank(surfaces_.rank());
}

bool MixedField::residual(const algebra::BlockVector& x, algebra::BlockVector& F) {
  read(x);
  if (!is_admissible()) return false;
  assemble(nullptr);
  R_.store(*mesh_, fixed_, F);
  return true;
}

void MixedField::assemble_jacobian(const algebra::BlockVector& x) {
  read(x);
  const Stopwatch watch;
  assembly::BlockAssembler assembler(K_, fixed_);
  assemble(&assembler);
  assembler.finish();
  throughput_.items += static_cast<long long>(mesh_->tets.size());
  throughput_.seconds += watch.seconds();
}

void MixedField::end_step_on_surfaces(const algebra::BlockVector& x) {
  if (!surfaces_.has_state()) return;
  read(x);
  surfaces_.end_step(surroundings());
}

double MixedField::mass_norm(const algebra::BlockVector& dx) const {
  return assembly::mass_norm(*mesh_, geometry(), dx);
}

}  // namespace tunica::discretisation
