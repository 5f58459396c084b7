#include "tunica/problems/state_history.hpp"

namespace tunica::problems {

// A polynomial of the degree needs degree + 1 values, of which the first is the state at the start.
StateHistory::StateHistory(const FieldProblem& field, int degree)
    : field_(&field), degree_(degree) {
  const algebra::BlockVector& x = field.state();
  for (int b = 0; b < x.n_blocks(); ++b) {
    const fields::State::Array rows = fields::rows_of(x, b, field.split());
    blocks_.emplace_back(fields::Places::owned_nodes(field.mesh()), rows.columns,
                         std::vector<std::string>(), degree + 1);
    blocks_.back().start_from(rows.values);
  }
}

void StateHistory::accept() {
  int b = 0;
  for (stepping::Timeline& block : blocks_)
    block.push(fields::rows_of(field_->state(), b++, field_->split()).values);
}

// x⁰ = Σ_k c_k xⁿ⁻ᵏ, each block by itself
algebra::BlockVector StateHistory::extrapolated(const stepping::StepSizes& sizes) const {
  algebra::BlockVector x(field_->space());
  int b = 0;
  for (const stepping::Timeline& block : blocks_)
    fields::assign_rows({block.width(), block.extrapolated(degree_, sizes)}, b++, field_->split(),
                        x);
  return x;
}

fields::State StateHistory::save() const {
  fields::State state = fields::state_on(field_->mesh());
  int b = 0;
  for (const stepping::Timeline& block : blocks_)
    block.save_past((*field_->space())[b++].name + " ", state);
  return state;
}

// The value of the last step is the field's state, which has been restored before.
std::string StateHistory::restore(const fields::State& state) {
  int b = 0;
  for (stepping::Timeline& block : blocks_) {
    block.restore_past((*field_->space())[b].name + " ", state,
                       fields::rows_of(field_->state(), b, field_->split()).values);
    ++b;
  }
  return "";
}

}  // namespace tunica::problems
