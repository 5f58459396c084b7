#include "tunica/app/run.hpp"

#include <Teuchos_Array.hpp>
#include <filesystem>
#include <iostream>

#include "tunica/app/extent.hpp"
#include "tunica/app/guard.hpp"
#include "tunica/app/prestress.hpp"
#include "tunica/app/results_folder.hpp"
#include "tunica/app/sanity/sanity.hpp"
#include "tunica/app/time_march.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/session.hpp"
#include "tunica/base/stop_signals.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/io/atomic_file.hpp"
#include "tunica/io/progress.hpp"
#include "tunica/linear/direct_factor.hpp"
#include "tunica/output/processors.hpp"
#include "tunica/output/traffic_report.hpp"
#include "tunica/params/read_xml.hpp"

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

void describe_domain(const Domain& domain, const Comm& comm) {
  std::ostringstream text;
  if (domain.fluid) describe(text, "fluid", *domain.fluid);
  if (domain.wall) describe(text, "wall", *domain.wall);
  if (domain.interface) text << "interface: " << domain.interface->n_total() << " vertices\n";
  text << "ranks: " << comm.getSize() << "\n";
  const std::string doubt =
      output::doubt_of(output::scarcest_processors(comm), output::ranks_yield());
  if (!doubt.empty()) text << "warning: " << doubt << "\n";
  if (comm.getRank() == 0) std::cout << text.str() << std::flush;
}

void record_sizes(const Domain& domain, output::RunRecord& record) {
  const auto put = [&record](const std::string& name, const fields::FieldMesh& mesh) {
    record.set("sizes", name + " vertices", global_nodes(mesh));
    record.set("sizes", name + " tetrahedra", global_tets(mesh));
  };
  if (domain.fluid) put("fluid", *domain.fluid);
  if (domain.wall) put("wall", *domain.wall);
  if (domain.interface) record.set("sizes", "interface vertices", domain.interface->n_total());
}

/// What the rank with most of each has: what it computes, and what it gets from others.
void record_shares(const Domain& domain, const Comm& comm, output::RunRecord& record) {
  int owned = 0, ghosts = 0, tets = 0;
  for (const auto* mesh : {&domain.fluid, &domain.wall}) {
    if (!*mesh) continue;
    owned += (*mesh)->n_owned;
    ghosts += (*mesh)->n_nodes() - (*mesh)->n_owned;
    tets += static_cast<int>((*mesh)->tets.size());
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

/// The work, which a signal may end before the first step.
Outcome until_stopped(RunOutput& output, const std::function<Outcome()>& work) {
  try {
    return work();
  } catch (const StopRequest& request) {
    output.stopped = "stopped by " + signal_name(request.signal) + " before the first step.";
    return Outcome::success();
  }
}

/// The work and what is written about it.
int conclude(const Program& program, RunOutput& output, const Comm& comm,
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
    // At once, or a launcher puts what the other stream says in between.
    if (!message.empty()) std::cerr << program.name + ": " + message + "\n" << std::flush;
    std::cout << "results in " << output.folder.path() << std::endl;
  }
  if (outcome.is_failure()) return exit_not_converged;
  if (is_stopped) return exit_stopped;
  return message.empty() ? exit_done : exit_unconverged_steps;
}

/// True, and says so, if the run has made all its steps before.
bool is_over(const output::CheckpointHead& head, const Teuchos::ParameterList& list,
             const Comm& comm) {
  stepping::StepControl control = step_control(list);
  control.restore(head.control);
  if (!control.is_done()) return false;
  const int steps = list.sublist("Time").get<int>("steps");
  std::ostringstream made;
  made << head.step;
  if (steps > 0) made << " of " << steps;
  if (comm.getRank() == 0)
    std::cout << "nothing to do: the run has made " << made.str() << " steps, to " << head.time
              << " ms. More with " << (control.is_adaptive() ? "a later \"end time\"" : "--steps")
              << "." << std::endl;
  return true;
}

/// What begins now, with the history of a run that goes on taken over. On rank 0.
output::Leg next_leg(RunOutput& output, const std::string& case_file) {
  const std::string& folder = output.folder.path();
  const std::vector<output::Leg> history = history_of(folder);
  if (!output.restart || history.empty()) {
    remove_parameters(folder, history, case_file);
    const std::string name = name_for_parameters(folder, case_file);
    return {output.steps_done(), "", 1, name.empty() ? name_for_changed(folder, "case.xml") : name};
  }
  output.record.take_over(history);
  output::Leg leg{output.steps_done()};
  for (const params::Difference& change : output.restart->changes)
    leg.changes.push_back({change.path, change.before, change.after});
  leg.parameters = leg.changes.empty() ? output::leg_of_step(history, leg.after_step).parameters
                                       : name_for_changed(folder, history.front().parameters);
  return leg;
}

std::string folder_of(const Teuchos::ParameterList& list) {
  return list.sublist("Output").get<std::string>("folder");
}

/// A key of the list "Output" that not every case has.
int of_output(const Teuchos::ParameterList& list, const std::string& key) {
  const Teuchos::ParameterList& output = list.sublist("Output");
  return output.isParameter(key) ? output.get<int>(key) : 0;
}

bool has_asked_times_in(const Teuchos::ParameterList& output) {
  return output.isParameter("fields at") &&
         (!output.get<Teuchos::Array<double>>("fields at").empty() ||
          output.get<double>("fields interval") > 0.0);
}

/// Keeps others out of the folder, and looks whether the run may write there.
void enter(const std::string& folder, const Call& call, const Comm& comm, io::FolderLock& lock) {
  lock_results_folder(lock, folder, comm);
  check_results_folder(folder, call.command, call.program.name, comm);
}

int solve(const Program& program, const CommandLine& command, const March& march,
          const CommPtr& comm) {
  const Stopwatch set_up;
  const bool is_root = comm->getRank() == 0;
  const Teuchos::ParameterList list = read_case(command, program.table, *comm);
  io::FolderLock lock;
  if (!command.dry_run) {
    catch_early_notice();
    enter(folder_of(list), {program, command}, *comm, lock);
  }
  const Domain domain = load_domain(list, comm);
  print_extent(domain.extent, program.name, *comm);
  describe_domain(domain, *comm);
  std::optional<Restart> restart;
  const auto begun = command.restart ? begun_prestress(list, domain) : std::nullopt;
  if (begun) accepted_changes(*begun, "prestress.h5", list, program.table, command, *comm);
  if (command.restart && !begun) {
    restart = find_restart(list, domain);
    restart->changes =
        accepted_changes(restart->head, restart->file, list, program.table, command, *comm);
  }
  if (restart && is_over(restart->head, list, *comm)) return exit_done;
  if (command.dry_run) {
    check_fields(list, domain);
    print_expectations(list, domain);
    return exit_done;
  }
  check_held(list, domain);
  if (is_root) print_brief(judge(list, domain.vessel));
  if (is_root) io::show_progress(list.sublist("Output").get<double>("progress every"));
  linear::check_direct_solver(comm);
  RunOutput output({program, command, set_up}, list, comm, lock, restart);
  output.fingerprint = domain.fingerprint;
  output.resumes_prestress = begun.has_value();
  on_root(*comm, [&] { output.files = hashes_of_files(list); });
  record_sizes(domain, output.record);
  record_shares(domain, *comm, output.record);
  for (const auto& [phase, peaks] : domain.memory.phases())
    output.record.set(output::memory_section, phase, peaks);
  output.record.add_time("set-up", set_up.seconds());
  return conclude(program, output, *comm, [&] { return march(list, domain, output); });
}

int solve(const Program& program, const CommandLine& command, const Alternative& alternative,
          const CommPtr& comm) {
  const Stopwatch set_up;
  const Teuchos::ParameterList list = read_case(command, alternative.table, *comm);
  io::FolderLock lock;
  if (!command.dry_run) enter(folder_of(list), {program, command}, *comm, lock);
  const auto work = alternative.load(list, comm);
  if (command.dry_run) return exit_done;
  linear::check_direct_solver(comm);
  RunOutput output({program, command, set_up}, list, comm, lock);
  output.record.add_time("set-up", set_up.seconds());
  return conclude(program, output, *comm, [&] { return work(output); });
}

}  // namespace

RunOutput::RunOutput(const Call& call, const Teuchos::ParameterList& list, const CommPtr& comm,
                     io::FolderLock& lock, std::optional<Restart> from)
    : folder(folder_of(list), comm),
      record(folder.file("run.json"), call.program.name, TUNICA_VERSION, comm),
      fields_every(of_output(list, "fields every")),
      checkpoint_every(of_output(list, "checkpoint every")),
      compression(of_output(list, "compression")),
      has_asked_times(has_asked_times_in(list.sublist("Output"))), restart(std::move(from)),
      parameters(params::to_xml(list)), since_start(call.since_start) {
  enter(folder.path(), call, *comm, lock);  // again, for it may be new
  record.set("case", "file", call.command.case_file);
  on_root_or_fault(*comm, [&] {
    const output::Leg leg = next_leg(*this, call.command.case_file);
    record.begin_leg(leg);
    const std::string path = folder.file(leg.parameters);
    const bool is_kept = restart && std::filesystem::exists(path);
    return is_kept ? Outcome::success() : io::replace_file(path, parameters);
  });
}

int run_program(int argc, char** argv, const Program& program, const March& march,
                const std::optional<Alternative>& alternative) {
  const Session session;
  const CommPtr comm = all_ranks();
  const bool is_root = comm->getRank() == 0;
  return guarded(program.name, *comm, [&] {
    const CommandLine command = parse(argc, argv, program.name, program.sentence);
    if (command.help && is_root) std::cout << usage(program.name, program.sentence);
    if (command.print_defaults && is_root) program.table.print_xml(std::cout, "Case");
    if (command.help || command.print_defaults) return exit_done;
    if (alternative && has_list(command.case_file, alternative->list, *comm))
      return solve(program, command, *alternative, comm);
    return solve(program, command, march, comm);
  });
}

}  // namespace tunica::app
