#include "tunica/app/program.hpp"

#include <sstream>

#include "tunica/app/guard.hpp"
#include "tunica/app/large_pages.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/session.hpp"
#include "tunica/base/stop_signals.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/io/messages.hpp"
#include "tunica/io/progress.hpp"
#include "tunica/judge/sanity.hpp"
#include "tunica/linear/direct/direct_factor.hpp"
#include "tunica/output/processors.hpp"
#include "tunica/output/traffic_report.hpp"
#include "tunica/run/extent.hpp"
#include "tunica/run/prestress.hpp"
#include "tunica/run/results_folder.hpp"
#include "tunica/run/time_march.hpp"
#include "tunica/setup/case.hpp"

namespace tunica::app {

namespace {

long long global_nodes(const fields::FieldMesh& mesh) {
  return static_cast<long long>(mesh.node_map->getGlobalNumElements());
}

long long global_tets(const fields::FieldMesh& mesh) {
  double counted = 0.0;
  for (const char is_owned : mesh.is_owned) counted += is_owned;
  return static_cast<long long>(global_sum(*mesh.comm, counted));
}

void describe(std::ostream& out, const std::string& name, const fields::FieldMesh& mesh) {
  out << name << ": " << global_nodes(mesh) << " vertices, " << global_tets(mesh)
      << " tetrahedra\n";
}

void describe_domain(const run::Domain& domain, const Comm& comm) {
  std::ostringstream text;
  for (const auto& [name, mesh] : domain.meshes) describe(text, name, mesh);
  if (domain.interface) text << "interface: " << domain.interface->n_total() << " vertices\n";
  text << "ranks: " << comm.getSize();
  const std::string doubt =
      output::doubt_of(output::scarcest_processors(comm), output::ranks_yield());
  if (!doubt.empty()) text << "\nwarning: " << doubt;
  if (comm.getRank() == 0) io::print_line(text.str());
}

void record_sizes(const run::Domain& domain, output::RunRecord& record) {
  const auto put = [&record](const std::string& name, const fields::FieldMesh& mesh) {
    record.set("sizes", name + " vertices", global_nodes(mesh));
    record.set("sizes", name + " tetrahedra", global_tets(mesh));
  };
  for (const auto& [name, mesh] : domain.meshes) put(name, mesh);
  if (domain.interface) record.set("sizes", "interface vertices", domain.interface->n_total());
}

/// What the rank with most of each has: what it computes, and what it gets from others.
void record_shares(const run::Domain& domain, const Comm& comm, output::RunRecord& record) {
  int owned = 0, ghosts = 0, tets = 0;
  for (const auto& [name, mesh] : domain.meshes) {
    owned += mesh.n_owned;
    ghosts += mesh.n_nodes() - mesh.n_owned;
    tets += static_cast<int>(mesh.tets.size());
  }
  const auto put = [&](const char* what, int mine) {
    record.set("largest share", what, static_cast<long long>(global_max(comm, mine)));
  };
  put("vertices", owned);
  put("vertices of other ranks", ghosts);
  put("tetrahedra", tets);
}

/// Empty where there are none.
std::string about_unconverged(int steps) {
  if (steps == 0) return "";
  return std::to_string(steps) + (steps == 1 ? " step was" : " steps were") +
         " accepted without convergence; steps.csv marks them.";
}

void print_defaults(const Program& program) {
  std::ostringstream text;
  program.table.print_xml(text, "Case");
  io::print_line(text.str());
}

/// The work, which a signal may end before the first step.
Outcome until_stopped(run::RunOutput& output, const std::function<Outcome()>& work) {
  try {
    return work();
  } catch (const StopRequest& request) {
    output.stopped = "stopped by " + signal_name(request.signal) + " before the first step.";
    return Outcome::success();
  }
}

/// The work and what is written about it.
int conclude(const Program& program, run::RunOutput& output, const Comm& comm,
             const std::function<Outcome()>& work) {
  output.record.save();
  const Stopwatch marching;
  const Outcome outcome = until_stopped(output, work);
  output.record.add_time("march", marching.seconds());
  output::record_traffic(output.record, output.steps_of_traffic, comm);
  if (output.restart)
    output.record.add_time("march from the first step",
                           output.restart->head.seconds + marching.seconds());
  const bool is_stopped = outcome.is_success() && !output.stopped.empty();
  const std::string message = outcome.is_failure() ? outcome.reason()
                              : is_stopped         ? output.stopped
                                                   : about_unconverged(output.unconverged_steps);
  output.record.finish(outcome.is_failure() ? output::RunStatus::not_converged
                       : is_stopped         ? output::RunStatus::stopped
                                            : output::RunStatus::done,
                       message);
  if (comm.getRank() == 0) {
    if (!message.empty()) io::print_error_line(program.name + ": " + message);
    io::print_line("results in " + output.folder.path());
  }
  if (outcome.is_failure()) return run::exit_not_converged;
  if (is_stopped) return run::exit_stopped;
  return message.empty() ? run::exit_done : run::exit_unconverged_steps;
}

/// True, and says so, if the run has made all its steps before.
bool is_over(const output::CheckpointHead& head, const setup::Case& the_case, const Comm& comm) {
  stepping::StepControl control = run::step_control(the_case);
  control.restore(head.control);
  if (!control.is_done()) return false;
  const int steps = the_case.time->steps.most_steps;
  const std::string of_how_many = steps > 0 ? " of " + std::to_string(steps) : "";
  const std::string cure = control.is_adaptive() ? "a later \"end time\"" : "--steps";
  if (comm.getRank() == 0)
    io::print_line(formatted("nothing to do: the run has made %d%s steps, to %g ms. More with %s.",
                             head.step, of_how_many.c_str(), head.time, cure.c_str()));
  return true;
}

int run_case(const Program& program, const setup::CommandLine& command, const March& march,
             const CommPtr& comm) {
  const Stopwatch set_up;
  const bool is_root = comm->getRank() == 0;
  const setup::Case the_case = setup::read_case(command, program.table, *comm);
  const Teuchos::ParameterList& list = the_case.list;
  io::FolderLock lock;
  if (!command.dry_run) {
    catch_early_notice();
    run::enter(the_case.output.folder, command, *comm, lock);
  }
  const run::Domain domain = run::load_domain(the_case, comm);
  run::print_extent(domain.extent, program.name, *comm);
  describe_domain(domain, *comm);
  std::optional<run::Restart> restart;
  const auto begun = command.restart ? run::begun_prestress(the_case, domain) : std::nullopt;
  if (begun) run::accepted_changes(*begun, "prestress.h5", list, program.table, command, *comm);
  if (command.restart && !begun) {
    restart = run::find_restart(the_case, domain);
    restart->changes =
        run::accepted_changes(restart->head, restart->file, list, program.table, command, *comm);
  }
  if (restart && is_over(restart->head, the_case, *comm)) return run::exit_done;
  if (command.dry_run) {
    run::check_fields(the_case, domain);
    run::print_expectations(the_case, domain);
    return run::exit_done;
  }
  run::check_held(the_case, domain);
  if (is_root) judge::print_brief(judge::sanity_of(the_case, domain.vessel));
  if (is_root) io::show_progress(the_case.output.progress_every);
  linear::check_direct_solver(comm);
  run::RunOutput output(command, the_case, domain, lock, restart, set_up);
  output.resumes_prestress = begun.has_value();
  record_sizes(domain, output.record);
  record_shares(domain, *comm, output.record);
  for (const auto& [phase, peaks] : domain.memory.phases())
    output.record.set(output::memory_section, phase, peaks);
  output.record.add_time("set-up", set_up.seconds());
  return conclude(program, output, *comm, [&] { return march(the_case, domain, output); });
}

int run_alternative(const Program& program, const setup::CommandLine& command,
                    const Alternative& alternative, const CommPtr& comm) {
  const Stopwatch set_up;
  const setup::Case the_case = setup::read_case(command, alternative.table, *comm);
  io::FolderLock lock;
  if (!command.dry_run) run::enter(the_case.output.folder, command, *comm, lock);
  const auto work = alternative.load(the_case.list, comm);
  if (command.dry_run) return run::exit_done;
  linear::check_direct_solver(comm);
  run::RunOutput output(command, the_case, comm, lock, {}, set_up);
  output.record.add_time("set-up", set_up.seconds());
  return conclude(program, output, *comm, [&] { return work(output); });
}

}  // namespace

int run_program(int argc, char** argv, const Program& program, const March& march,
                const std::optional<Alternative>& alternative) {
  use_large_pages(argv);
  const Session session;
  const CommPtr comm = all_ranks();
  const bool is_root = comm->getRank() == 0;
  return guarded(program.name, *comm, [&] {
    const setup::CommandLine command = setup::parse(argc, argv, program.name, program.sentence);
    if (command.help && is_root) io::print_line(setup::usage(program.name, program.sentence));
    if (command.print_defaults && is_root) print_defaults(program);
    if (command.help || command.print_defaults) return run::exit_done;
    if (alternative && setup::has_list(command.case_file, alternative->list, *comm))
      return run_alternative(program, command, *alternative, comm);
    return run_case(program, command, march, comm);
  });
}

}  // namespace tunica::app
