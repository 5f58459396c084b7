#include "tunica/nonlinear/forcing.hpp"

#include <NOX_Abstract_Group.H>
#include <NOX_Direction_Generic.H>
#include <NOX_Direction_UserDefinedFactory.H>

#include <Teuchos_ParameterList.hpp>
#include <algorithm>

#include "tunica/nonlinear/newton.hpp"
#include "tunica/params/check_order.hpp"

namespace tunica::nonlinear {

namespace {

const params::Range part{0.0, 1.0, true, true};

/// What the rule looks at during a Newton solve.
struct IncrementRule {
  ForcingOptions options;
  NewtonGoal goal;
  const NewtonReport* report;

  double tolerance() const {
    if (report->steps.empty()) return options.largest;
    const double first = report->steps.front().increment;
    const double stop = std::max(goal.relative, first > 0.0 ? goal.absolute / first : 1.0);
    return increment_forcing(options, report->steps.back().relative_increment, stop);
  }
};

class IncrementForcedDirection : public NOX::Direction::Generic {
public:
  explicit IncrementForcedDirection(const IncrementRule& rule) : rule_(rule) {}

  bool reset(const Teuchos::RCP<NOX::GlobalData>&, Teuchos::ParameterList&) override {
    return true;
  }

  bool compute(NOX::Abstract::Vector& direction, NOX::Abstract::Group& group,
               const NOX::Solver::Generic&) override {
    Teuchos::ParameterList linear;
    linear.set("Tolerance", rule_.tolerance());
    if (group.computeF() != NOX::Abstract::Group::Ok) return false;
    if (group.computeJacobian() != NOX::Abstract::Group::Ok) return false;
    group.computeNewton(linear);  // whether it converged is in the report
    direction = group.getNewton();
    return true;
  }

private:
  IncrementRule rule_;
};

class IncrementForcedDirectionFactory : public NOX::Direction::UserDefinedFactory {
public:
  explicit IncrementForcedDirectionFactory(const IncrementRule& rule) : rule_(rule) {}

  Teuchos::RCP<NOX::Direction::Generic> buildDirection(const Teuchos::RCP<NOX::GlobalData>&,
                                                       Teuchos::ParameterList&) const override {
    return Teuchos::rcp(new IncrementForcedDirection(rule_));
  }

private:
  IncrementRule rule_;
};

params::Table eisenstat_walker_table() {
  params::Table table;
  table
      .number("linear tolerance", 0.01, part, "1",
              "reduction of the linear residual in the first step")
      .number("smallest tolerance", 1e-6, part, "1", "bound of the later ones from below")
      .number("largest tolerance", 0.01, part, "1", "bound of the later ones from above")
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        if (!list.isParameter("smallest tolerance")) return;  // another kind
        params::check_order(list, path, "smallest tolerance", "largest tolerance");
      });
  return table;
}

}  // namespace

void add_forcing_keys(params::Table& table, double linear_tolerance) {
  params::Table constant, increment;
  constant.number("linear tolerance", linear_tolerance, part, "1",
                  "reduction of the linear residual in each step");
  increment
      .number("largest tolerance", 0.1, part, "1",
              "relative tolerance of the first step, and upper bound of the later ones; small if "
              "the residual falls faster than the error, as in nearly incompressible walls")
      .number("smallest tolerance", 1e-12, part, "1", "bound of the later ones from below")
      .number("scale", 100.0, params::positive(), "1",
              "s in (s |dx_{k-1}|/|dx_1|)^2, the reduction of the linear residual in step k")
      .number("final part", 0.0, params::Range{0.0, 1.0, false, true}, "1",
              "solve no more accurately than to leave this part of the increment at which Newton's "
              "method stops; 0: the paper's rule, which ignores that increment");
  table.variant(
      "forcing", "constant",
      {{"constant", constant},
       {"type 1", eisenstat_walker_table()},
       {"type 2", eisenstat_walker_table()},
       {"increment", increment}},
      "relative tolerance of each linear system: constant, by the choices of Eisenstat and Walker "
      "(type 1, type 2), or from the increments by the paper's rule (increment)");
}

ForcingOptions forcing_options(const Teuchos::ParameterList& list) {
  const auto number = [&](const char* key) {
    return list.isParameter(key) ? list.get<double>(key) : 0.0;
  };
  return {list.get<std::string>("forcing"),
          number("linear tolerance"),
          number("smallest tolerance"),
          number("largest tolerance"),
          number("scale"),
          number("final part")};
}

// η = min(η_max, max((s e)², f·stop/e, η_min))
double increment_forcing(const ForcingOptions& options, double e, double stop) {
  const double wanted = options.scale * e * options.scale * e;
  const double enough = e > 0.0 ? options.final_part * stop / e : options.largest;
  return std::min(options.largest, std::max({wanted, enough, options.smallest}));
}

void choose_direction(const ForcingOptions& options, const NewtonGoal& goal,
                      const NewtonReport& report, Teuchos::ParameterList& nox) {
  Teuchos::ParameterList& direction = nox.sublist("Direction");
  if (options.kind == "increment") {
    direction.set("Method", "User Defined");
    direction.set<Teuchos::RCP<NOX::Direction::UserDefinedFactory>>(
        "User Defined Direction Factory",
        Teuchos::rcp(new IncrementForcedDirectionFactory({options, goal, &report})));
    return;
  }
  Teuchos::ParameterList& newton = direction.set("Method", "Newton").sublist("Newton");
  newton.sublist("Linear Solver").set("Tolerance", options.tolerance);
  newton.set("Forcing Term Method", options.kind == "constant" ? "Constant"
                                    : options.kind == "type 1" ? "Type 1"
                                                               : "Type 2");
  if (options.kind == "constant") return;
  newton.set("Forcing Term Initial Tolerance", options.tolerance);
  newton.set("Forcing Term Minimum Tolerance", options.smallest);
  newton.set("Forcing Term Maximum Tolerance", options.largest);
}

}  // namespace tunica::nonlinear
