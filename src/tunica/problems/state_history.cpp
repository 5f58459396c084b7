#include "tunica/problems/state_history.hpp"

#include <algorithm>
#include <string>

namespace tunica::problems {

StateHistory::StateHistory(const FieldProblem& field, int degree)
    : field_(&field), degree_(degree) {
  accept();
}

void StateHistory::remember(const algebra::BlockVector& x) {
  algebra::BlockVector copy(x.space());
  copy.assign(x);
  states_.push_front(copy);
  if (static_cast<int>(states_.size()) > degree_ + 1) states_.pop_back();
}

void StateHistory::accept() { remember(field_->state()); }

algebra::BlockVector StateHistory::extrapolated(const stepping::StepSizes& sizes) const {
  const int degree = std::min(degree_, static_cast<int>(states_.size()) - 1);
  const std::array<double, 3> weights = stepping::extrapolation(degree, sizes);
  algebra::BlockVector x(field_->space());
  for (int k = 0; k <= degree; ++k)
    for (int b = 0; b < x.n_blocks(); ++b) x[b].update(weights[k], states_[k][b], 1.0);
  return x;
}

fields::State StateHistory::save() const {
  fields::State state = fields::state_on(field_->mesh());
  state.numbers["states"] = {static_cast<double>(states_.size())};
  for (std::size_t k = 0; k < states_.size(); ++k)
    field_->save_blocks(states_[k], " " + std::to_string(k), state);
  return state;
}

std::string StateHistory::restore(const fields::State& state) {
  states_.clear();
  for (int k = static_cast<int>(state.number_list("states").at(0)) - 1; k >= 0; --k) {
    algebra::BlockVector x(field_->space());
    field_->restore_blocks(state, " " + std::to_string(k), x);
    remember(x);
  }
  return "";
}

}  // namespace tunica::problems
