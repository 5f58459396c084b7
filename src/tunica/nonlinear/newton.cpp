#include "tunica/nonlinear/newton.hpp"

#include <NOX.H>

#include <Teuchos_oblackholestream.hpp>
#include <Thyra_DefaultProductVectorSpace.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>
#include <Thyra_VectorStdOps.hpp>

#include "tunica/linear/direct/direct_factor.hpp"
#include "tunica/nonlinear/guarded_line_search.hpp"
#include "tunica/nonlinear/increment_test.hpp"
#include "tunica/nonlinear/nox_group.hpp"

namespace tunica::nonlinear {

params::Table newton_table(const NewtonDefaults& defaults) {
  params::Table next;
  next.number("safety", 30.0, params::positive(), "1",
              "s in s |F_k|/|F_{k-1}|, the predicted ratio of the next increment to the last one: "
              "residuals fall faster than errors");
  params::Table table("Newton's method.");
  table
      .integer("max iterations", 20, params::between(1, 1000),
               "cap on the Newton steps of a solve; after a failed solve of monolithic coupling, "
               "the careful repetition may take four times as many")
      .number("relative increment", defaults.relative_increment, params::non_negative(), "1",
              "stop when the norm of the increment has fallen to this part of the first one")
      .number("absolute increment", defaults.absolute_increment, params::non_negative(),
              defaults.unit,
              "or when the norm of the increment is at most this; keeps round-off from "
              "deciding in late coupling iterations, whose first increment is already tiny")
      .variant("stop at", defaults.stop_at,
               {{"increment", params::Table()},
                {"next increment", next},
                {"remaining error", params::Table()}},
               "quantity that those two bound: the last increment, as in the paper; the next "
               "increment, predicted from the residual, which saves the last step; or the "
               "remaining error, if increments go on falling like the last two")
      .number("jacobian cost", defaults.jacobian_cost, params::non_negative(), "1",
              "cost of a new Jacobian, in Newton steps: within a time step the last one is reused "
              "as long as it needs no more steps than a new one would, plus this cost; 0: a new "
              "one in each step")
      .number("growth limit", 1e4, params::positive(), "1",
              "give up when the increment has grown to this multiple of the first one")
      .choice("line search", "guarded",
              {"guarded", "decrease", "full step", "backtrack", "polynomial"},
              "guarded: full steps, halved only if an element would be inverted or the residual "
              "grow a thousandfold; if the increment exceeds \"growth limit\", decrease from the "
              "start; decrease: also halved until the residual falls; the others are those of NOX");
  add_forcing_keys(table, defaults.linear_tolerance);
  return table;
}

NewtonOptions newton_options(const Teuchos::ParameterList& list) {
  const auto& stop = list.get<std::string>("stop at");
  NewtonOptions options;
  options.max_iterations = list.get<int>("max iterations");
  options.relative_increment = list.get<double>("relative increment");
  options.absolute_increment = list.get<double>("absolute increment");
  options.stop_at = stop == "increment"        ? StopAt::increment
                    : stop == "next increment" ? StopAt::next_increment
                                               : StopAt::remaining_error;
  if (list.isParameter("safety")) options.safety = list.get<double>("safety");
  options.growth_limit = list.get<double>("growth limit");
  options.jacobian_cost = list.get<double>("jacobian cost");
  options.line_search = list.get<std::string>("line search");
  options.forcing = forcing_options(list);
  return options;
}

int NewtonReport::linear_iterations() const {
  int sum = 0;
  for (const NewtonStep& step : steps) sum += step.linear.iterations;
  return sum;
}

void NewtonReport::comes_after(const NewtonReport& earlier) {
  steps.insert(steps.begin(), earlier.steps.begin(), earlier.steps.end());
  earlier_steps += static_cast<int>(earlier.steps.size());
}

namespace {

using ProductSpace = Teuchos::RCP<const Thyra::VectorSpaceBase<double>>;

/// The space of the block vectors. Clones of a product vector refer to it without owning it:
/// it must outlive them all.
ProductSpace product_space(const algebra::BlockSpace& space) {
  Teuchos::Array<ProductSpace> blocks;
  for (int b = 0; b < space.n_blocks(); ++b)
    blocks.push_back(
        Thyra::createVectorSpace<double, LocalOrdinal, GlobalOrdinal, Node>(space[b].map));
  return Thyra::productVectorSpace<double>(blocks());
}

NOX::Thyra::Vector nox_vector(const ProductSpace& space, const algebra::BlockVector& x) {
  NOX::Thyra::Vector vector(Thyra::createMember<double>(space));
  blocks_of(vector, x.space()).assign(x);
  return vector;
}

Teuchos::RCP<Teuchos::ParameterList> nox_list(const NewtonOptions& options,
                                              const NewtonReport& report, int rank) {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set("Nonlinear Solver", "Line Search Based");
  // What goes wrong is in the report.
  const Teuchos::RCP<std::ostream> nowhere = Teuchos::rcp(new Teuchos::oblackholestream);
  list->sublist("Printing")
      .set("Output Information", 0)
      .set("MyPID", rank)
      .set("Output Stream", nowhere)
      .set("Error Stream", nowhere);
  choose_direction(options.forcing, {options.relative_increment, options.absolute_increment},
                   report, *list);
  Teuchos::ParameterList& search = list->sublist("Line Search");
  if (options.line_search == "guarded" || options.line_search == "decrease") {
    search.set("Method", "User Defined");
    search.set<Teuchos::RCP<NOX::LineSearch::UserDefinedFactory>>(
        "User Defined Line Search Factory",
        Teuchos::rcp(new GuardedLineSearchFactory(options.line_search == "decrease")));
  } else {
    search.set("Method", options.line_search == "full step"   ? "Full Step"
                         : options.line_search == "backtrack" ? "Backtrack"
                                                              : "Polynomial");
  }
  return list;
}

std::string gave_up(const NewtonOptions& options, const SolveLog& log) {
  return "no step with the line search \"" + options.line_search + "\"" +
         (log.refusal.empty() ? "" : ": " + log.refusal);
}

NewtonReport try_newton(NonlinearProblem& problem, const NewtonOptions& options,
                        algebra::BlockVector& x, JacobianRule& rule) {
  const ProductSpace space = product_space(*problem.space());
  NewtonReport report;
  SolveLog log;
  rule.begin_solve();
  const JacobianChoice choice{&rule, &report, options.absolute_increment,
                              options.relative_increment};
  const auto group = Teuchos::rcp(new NoxGroup(problem, choice, log, nox_vector(space, x)));
  if (group->computeF() != NOX::Abstract::Group::Ok) {
    report.reason = "the residual cannot be computed at the start: " + log.refusal;
    return report;
  }
  const auto test = Teuchos::rcp(new IncrementTest(problem, options, log, rule, report));
  const int rank = problem.space()->comm()->getRank();
  const auto solver = NOX::Solver::buildSolver(group, test, nox_list(options, report, rank));
  NOX::StatusTest::StatusType status = NOX::StatusTest::Failed;
  try {
    status = solver->solve();
  } catch (const char* message) {  // NOX 13 throws "NOX Error" as it stands
    report.reason = std::string(message) == "NOX Error" ? gave_up(options, log) : message;
  } catch (const linear::SetupFailure& error) {
    report.reason = error.what();
    report.is_linear_failure = true;
  } catch (const std::runtime_error& error) {  // its successors in an exception
    if (std::string(error.what()) != "NOX Error") throw;
    report.reason = gave_up(options, log);
  }
  report.is_converged = status == NOX::StatusTest::Converged;
  if (!report.is_converged) rule.forget();
  if (!report.is_converged && report.reason.empty())
    report.reason = "no admissible step along the Newton direction" +
                    (log.refusal.empty() ? "" : ": " + log.refusal);
  x.assign(blocks_of(solver->getSolutionGroup().getX(), problem.space()));
  return report;
}

bool has_diverged(const NewtonReport& report, const NewtonOptions& options) {
  return !report.is_converged && !report.steps.empty() &&
         report.steps.back().relative_increment > options.growth_limit;
}

}  // namespace

NewtonReport solve_newton(NonlinearProblem& problem, const NewtonOptions& options,
                          algebra::BlockVector& x, JacobianRule* rule) {
  JacobianRule always(0.0);
  if (rule == nullptr) rule = &always;
  algebra::BlockVector start(x.space());
  start.assign(x);
  const bool had_led_away = rule->has_led_away();
  NewtonReport report = try_newton(problem, options, x, *rule);
  const auto try_again = [&](const NewtonOptions& chosen, JacobianRule& choice) {
    x.assign(start);
    NewtonReport again = try_newton(problem, chosen, x, choice);
    again.comes_after(report);
    return again;
  };
  if (!report.is_converged && rule->has_led_away() && !had_led_away)
    report = try_again(options, *rule);
  if (report.is_converged || !options.tries_again) return report;
  if (rule->has_lagged()) report = try_again(options, always);
  if (!has_diverged(report, options) || options.line_search != "guarded") return report;
  // Full steps that lead away: shorter ones may not.
  NewtonOptions careful = options;
  careful.line_search = "decrease";
  const std::string reason = report.reason;
  report = try_again(careful, always);
  if (!report.is_converged) report.reason = reason + "; with shorter steps, " + report.reason;
  return report;
}

}  // namespace tunica::nonlinear
