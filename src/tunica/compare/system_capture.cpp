#include "tunica/compare/system_capture.hpp"

#include <tuple>

namespace tunica::compare {

void add_capture_keys(params::Table& table) {
  table.integer("step", 1, params::between(1, 1e9), "the time step whose Jacobians are taken")
      .integer("coupling iteration", 2, params::between(1, 1e5),
               "the coupling iteration of that step; the run ends with it; a monolithic scheme has "
               "one")
      .integer("newton step", 0, params::between(0, 1000),
               "the Newton step of that iteration; 0 takes all")
      .choice(
          "field", "both", {"fluid", "wall", "both"},
          "field whose Jacobians are taken; a monolithic scheme has those of the coupled system");
}

SystemCapture::SystemCapture(const Teuchos::ParameterList& solvers, Show show)
    : wanted_step_(solvers.get<int>("step")),
      wanted_iteration_(solvers.get<int>("coupling iteration")),
      wanted_newton_step_(solvers.get<int>("newton step")),
      wanted_field_(solvers.get<std::string>("field")), show_(std::move(show)) {}

void SystemCapture::watch(const std::string& field, problems::SystemSource& problem) {
  problem.watch_solves([this, field, &problem](const algebra::BlockVector& b) {
    const int newton_step = ++newton_steps_[field];
    if (!is_wanted(field, newton_step)) return;
    ++count_;
    LinearSystem system;
    system.field = field;
    system.step = step_;
    system.coupling_iteration = iteration_;
    system.newton_step = newton_step;
    system.K = &problem.last_jacobian();
    system.b = &b;
    system.operators = &problem.operators();
    system.mesh = &problem.last_jacobian().mesh();
    show_(system);
  });
}

void SystemCapture::enter(int step, int coupling_iteration) {
  step_ = step;
  iteration_ = coupling_iteration;
  newton_steps_.clear();
}

bool SystemCapture::is_complete(int step, int coupling_iteration) const {
  return std::tie(step, coupling_iteration) >= std::tie(wanted_step_, wanted_iteration_);
}

std::string SystemCapture::wish() const {
  return (wanted_field_ == "both" ? "" : wanted_field_ + ", ") + "time step " +
         std::to_string(wanted_step_) + ", coupling iteration " +
         std::to_string(wanted_iteration_) + ", " +
         (wanted_newton_step_ == 0 ? "all Newton steps"
                                   : "Newton step " + std::to_string(wanted_newton_step_));
}

bool SystemCapture::is_wanted(const std::string& field, int newton_step) const {
  return (wanted_field_ == "both" || wanted_field_ == field || field == "system") &&
         step_ == wanted_step_ && iteration_ == wanted_iteration_ &&
         (wanted_newton_step_ == 0 || wanted_newton_step_ == newton_step);
}

}  // namespace tunica::compare
