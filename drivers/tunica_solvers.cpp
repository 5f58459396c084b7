// Takes real Jacobians out of a fluid-structure interaction problem, solves each with a list of
// settings, and compares them in one table. Or reads a linear system of another program.
//
//   tunica-solvers xml/solvers-tiny.xml --output results/solvers
//   tunica-solvers xml/system.xml
//   tunica-solvers K.mtx b.mtx
//   tunica-solvers K.mtx b.mtx xml/paper/muelu-fluid.xml
//   mpirun -n 2 tunica-solvers xml/solvers-tiny.xml --export systems

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "tunica/app/program.hpp"
#include "tunica/compare/solver_table.hpp"
#include "tunica/compare/system_capture.hpp"
#include "tunica/compare/system_export.hpp"
#include "tunica/coupling/registry.hpp"
#include "tunica/foreign/given_operators.hpp"
#include "tunica/io/matrix_market.hpp"
#include "tunica/io/messages.hpp"
#include "tunica/params/read_xml.hpp"
#include "tunica/run/field_problems.hpp"
#include "tunica/run/run_log.hpp"
#include "tunica/setup/schema.hpp"
#include "tunica/systems/read_system.hpp"

namespace {

using namespace tunica;

/// Leaves the march when the wanted coupling iteration is over.
struct Complete {};

/// Marches until the wanted coupling iteration is over. Not converging before it is a result.
Outcome march_to_wanted(compare::SystemCapture& capture, coupling::Scheme& scheme,
                        stepping::Clock clock, run::RunLog& log) {
  scheme.watch_newton([&](const std::string& field, const nonlinear::NewtonStep& step) {
    log.newton(field, step);
  });
  for (; !clock.is_done(); clock.advance()) {
    capture.enter(0, 0);  // what the coupling solves for itself is not asked for
    log.begin({clock.step(), clock.time(), 1});
    if (const Outcome begun = scheme.begin_step(clock); begun.is_failure()) return begun;
    capture.enter(clock.step(), 1);
    const coupling::Report report =
        scheme.solve_step(clock, [&](int k, const coupling::Iteration& iteration) {
          log.coupling(iteration);
          const bool is_solved =
              std::all_of(iteration.solves.begin(), iteration.solves.end(),
                          [](const auto& solve) { return solve.report.is_converged; });
          if (is_solved && capture.is_complete(clock.step(), k)) throw Complete();
          capture.enter(clock.step(), k + 1);
        });
    log.step(clock, run::summary_of(report, scheme.fields()), {});
    if (!report.is_accepted) return Outcome::failure(report.reason);
  }
  return Outcome::success();
}

Outcome march(const setup::Case& the_case, const run::Domain& domain, run::RunOutput& output) {
  Teuchos::ParameterList list(the_case.list);
  Teuchos::ParameterList& coupling = list.sublist("Coupling");
  if (the_case.coupling->is_monolithic)
    list.sublist("Solvers").set("coupling iteration", 1);  // there is one
  else
    coupling.set("halvings", 0);  // a system that cannot be solved is a result

  // 1. The coupled problem of the case.
  run::FieldProblems fields(list, domain);
  const Outcome started = fields.start(output);
  if (started.is_failure() || !output.stopped.empty()) return started;
  coupling::Scheme& scheme = *fields.scheme;

  // 2. Every wanted system is written and goes through all settings before it is solved.
  const CommPtr comm = domain.comm;
  const Teuchos::ParameterList& solvers = list.sublist("Solvers");
  const compare::SystemExport files(solvers.get<std::string>("export folder"), output.record, comm);
  compare::SolverTable table(list, output.folder, output.record, comm->getRank() == 0);
  compare::SystemCapture capture(solvers, [&](const compare::LinearSystem& system) {
    files.write(system);
    files.write(system, table.run(system));
  });
  for (const auto& [field, source] : scheme.systems()) capture.watch(field, *source);

  // 3. March as far as needed.
  run::RunLog log(output, comm->getRank() == 0, scheme.fields(), scheme.stages());
  Outcome outcome = Outcome::success();
  try {
    outcome = march_to_wanted(capture, scheme, stepping::Clock(list.sublist("Time")), log);
  } catch (const Complete&) {  // what was wanted is in the table
  }

  // 4. Report.
  table.print();
  if (outcome.is_success() && capture.count() == 0)
    outcome = Outcome::failure("there is no linear system at " + capture.wish() +
                               "; coupling.csv lists those that exist");
  return outcome;
}

/// "578 vector and 81 scalar unknowns"
std::string describe_unknowns(const algebra::BlockSpace& space) {
  std::string text;
  for (int b = 0; b < space.n_blocks(); ++b)
    text += (b > 0 ? " and " : "") + std::to_string(space[b].map->getGlobalNumElements()) + " " +
            space[b].name;
  return text + " unknowns";
}

/// The list of a case that solves the system as it has been solved.
Teuchos::ParameterList used_case(const Teuchos::ParameterList& list, const systems::System& system,
                                 const compare::BestSolution& best) {
  Teuchos::ParameterList used("Case");
  for (const auto& entry : list.sublist("System"))
    if (!entry.second.isType<std::string>() ||
        !Teuchos::getValue<std::string>(entry.second).empty())
      used.sublist("System").setEntry(entry.first, entry.second);
  used.sublist("System").setParameters(system.found);
  used.sublist("Solvers").set("tolerance", list.sublist("Solvers").get<double>("tolerance"));
  used.sublist("Solvers").sublist("Settings").sublist(best.setting) = best.list;
  return used;
}

std::optional<compare::BestSolution> best_of(compare::SolverTable& table,
                                             const systems::System& system) {
  const foreign::GivenOperators operators(system);
  compare::LinearSystem linear;
  linear.field = "system";
  linear.K = &system.K;
  linear.b = &system.b;
  linear.operators = &operators;
  linear.of_files = &system;
  return table.run(linear);
}

/// A system from files in the place of a coupled problem.
std::function<Outcome(run::RunOutput&)> load_system(const Teuchos::ParameterList& whole,
                                                    const CommPtr& comm) {
  auto system =
      std::make_shared<systems::System>(systems::read_system(whole.sublist("System"), comm));
  if (comm->getRank() == 0)
    std::cout << "system: " << describe_unknowns(*system->K.space()) << ", " << system->order
              << "\nranks: " << comm->getSize() << std::endl;
  if (comm->getRank() == 0) {
    for (const std::string& note : system->notes) io::print_line("note: " + note);
    for (const std::string& remark : system->remarks) io::print_error_line("warning: " + remark);
  }
  return [system, list = Teuchos::ParameterList(whole), comm](run::RunOutput& output) mutable {
    compare::SolverTable table(list, output.folder, output.record, comm->getRank() == 0);
    auto best = best_of(table, *system);
    const bool is_solved = best && best->is_converged;
    if (!is_solved && table.is_chosen() && !system->border.empty()) {
      if (comm->getRank() == 0)
        io::print_line("note: nothing converges without the border: all is solved at once");
      list.sublist("System").set("border", false).set("exclude", "");
      *system = systems::read_system(list.sublist("System"), comm);
      best = best_of(table, *system);
    }
    table.print();
    if (!best) return Outcome::failure("no setting came nearer to the solution than zero");
    const Vector x = systems::in_file_order(*system, systems::in_units_of_files(*system, best->x));
    io::write_matrix_market(output.folder.file("solution.mtx"), {&x}, compare::note_on(*best));
    if (table.is_chosen() && comm->getRank() == 0)
      io::print_line("the case that does the same:\n" +
                     params::to_xml(used_case(list, *system, *best)));
    if (!best->is_converged)
      return Outcome::failure("no setting has converged; solution.mtx is the nearest: " +
                              compare::note_on(*best));
    return Outcome::success();
  };
}

}  // namespace

int main(int argc, char** argv) {
  return tunica::app::run_program(
      argc, argv,
      {"tunica-solvers", "Compares settings of linear solvers on the systems of a coupled problem.",
       tunica::setup::solvers_table()},
      march,
      tunica::app::Alternative{"System", tunica::setup::system_solvers_table(), load_system});
}
