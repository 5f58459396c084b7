#include "tunica/coupling/scheme.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace tunica::coupling {

namespace {

template <class Entries, class Name>
auto& named(Entries& entries, const std::string& name, Name name_of) {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const auto& entry) { return name_of(entry) == name; });
  if (found == entries.end()) throw std::out_of_range("a coupling iteration has no " + name);
  return *found;
}

}  // namespace

void add_acceptance_key(params::Table& table) {
  table.choice(
      "when not converged", "stop", {"stop", "accept"},
      "stop with exit status 2, or accept the step with a warning, continue, and end with 4");
}

bool accepts_unconverged(const Teuchos::ParameterList& coupling) {
  return coupling.get<std::string>("when not converged") == "accept";
}

nonlinear::NewtonReport& Iteration::solve(const std::string& field) {
  return named(solves, field, [](const FieldSolve& s) { return s.field; }).report;
}

const nonlinear::NewtonReport& Iteration::solve(const std::string& field) const {
  return named(solves, field, [](const FieldSolve& s) { return s.field; }).report;
}

double& Iteration::seconds(const std::string& stage) {
  return named(stages, stage, [](const Stage& s) { return s.name; }).seconds;
}

int Report::newton_steps(const std::string& field) const {
  int sum = 0;
  for (const Iteration& iteration : iterations)
    sum += static_cast<int>(iteration.solve(field).steps.size());
  return sum;
}

int Report::linear_iterations(const std::string& field) const {
  int sum = 0;
  for (const Iteration& iteration : iterations) sum += iteration.solve(field).linear_iterations();
  return sum;
}

Iteration Scheme::new_iteration() const {
  Iteration iteration;
  for (const std::string& field : fields()) iteration.solves.push_back({field, {}});
  for (const std::string& stage : stages()) iteration.stages.push_back({stage});
  return iteration;
}

// begun_ is set last: a step that could not be begun cannot be solved either.
Outcome Scheme::begin_step(const stepping::Clock& clock) {
  begun_ = -1;
  const Outcome outcome = begin(clock);
  if (outcome.is_success()) begun_ = clock.step();
  return outcome;
}

// Once per beginning, since a solve leaves the fields accepted, or anywhere.
Report Scheme::solve_step(const stepping::Clock& clock, const Watch& watch) {
  if (std::exchange(begun_, -1) != clock.step())
    throw std::logic_error("step " + std::to_string(clock.step()) +
                           " of a coupling is solved before begin_step() has begun it");
  return solve(clock, watch);
}

}  // namespace tunica::coupling
