#include "tunica/run/prestress.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/stop_signals.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/io/csv_table.hpp"
#include "tunica/io/messages.hpp"
#include "tunica/output/checkpoint_series.hpp"
#include "tunica/problems/prestress.hpp"
#include "tunica/run/run_log.hpp"

namespace tunica::run {

namespace {

/// What is told of the search while it goes on: a line on the screen and a row of prestress.csv.
class PrestressLog {
public:
  /// from: keeps the rows of load steps up to there.
  PrestressLog(const RunOutput& output, bool is_root, const problems::PrestressPoint& from)
      : is_root_(is_root), table_(output.folder.file("prestress.csv"),
                                  {"load_step", "iteration", "load", "linear", "residual_ratio",
                                   "moved_mm", "goal_mm", "min_det_G", "max_det_G",
                                   "tissue_mean_kPa", "tissue_largest_kPa", "seconds", "given_up"},
                                  is_root, from.load_step),
        last_load_(from.load) {}

  void tell(const problems::PrestressIteration& now) {
    table_.row({now.load_step, now.iteration, now.load, now.linear, now.residual, now.moved,
                now.goal, now.least, now.most, now.tissue.mean, now.tissue.most, now.seconds,
                now.reason});
    if (now.load < last_load_) last_load_ = 0.0;  // it has begun anew
    ++iterations_;
    linear_ += now.linear;
    print(now);
    last_ = now;
  }
  void record(output::RunRecord& record, double seconds) const {
    record.add_time("prestress", seconds);
    record.set("prestress", "iterations", iterations_);
    record.set("prestress", "linear iterations", linear_);
    record.set("prestress", "mm from the mesh", last_.moved);
    record.set("prestress", "least det G", last_.least);
    record.set("prestress", "largest det G", last_.most);
    record.set("prestress", "tissue holds kPa", last_.tissue.mean);
    record.set("prestress", "tissue holds at most kPa", last_.tissue.most);
  }

private:
  /// Iterations to come; some eight are usual at all of the load.
  double iterations_left(const problems::PrestressIteration& now) const {
    if (now.load < 1.0) return 8.0 + (1.0 - now.load) / std::max(now.load - last_load_, 1e-3);
    if (now.goal <= 0.0 || now.moved <= now.goal) return 0.0;
    const bool has_rate = last_.load == 1.0 && last_.moved > 0.0;
    const double rate = has_rate ? std::clamp(now.moved / last_.moved, 0.2, 0.95) : 0.7;
    return std::log(now.goal / now.moved) / std::log(rate);
  }

  void print(const problems::PrestressIteration& now) {
    if (!is_root_) return;
    std::string line = formatted("prestress: load %.4f, iteration %d  %d linear  ", now.load,
                                 now.iteration, now.linear);
    if (now.reason.empty()) {
      line += formatted("%.2e mm off the mesh", now.moved);
      if (now.goal > 0.0) line += formatted(" (goal %.1e)", now.goal);
    } else {
      line += "given up: " + now.reason;
    }
    line += formatted("  %.2f s", now.seconds);
    const double left = iterations_left(now);
    if (now.reason.empty() && left > 0.5)
      line += ", about " + rough_duration(left * now.seconds) + " left";
    io::print_line(line);
    if (now.reason.empty() && now.load < 1.0) last_load_ = now.load;
  }

  bool is_root_;
  io::CsvTable table_;
  problems::PrestressIteration last_{};
  double last_load_;
  int iterations_ = 0, linear_ = 0;
};

/// The wall with what is in it, by names as in checkpoints.
std::vector<std::pair<std::string, fields::Restartable*>> parts_of(problems::SolidProblem& wall) {
  std::vector<std::pair<std::string, fields::Restartable*>> parts{{"wall", &wall}};
  for (const auto& [name, part] : wall.inner_parts()) parts.emplace_back("wall " + name, part);
  return parts;
}

constexpr const char* file_name = "prestress.h5";
constexpr const char* point_name = "prestress";
constexpr const char* shape_name = "shape";

/// Leaves a search that has come so far in the folder of the run. Collective.
void save(const problems::PrestressPoint& point, problems::SolidProblem& wall,
          const RunOutput& output) {
  output::CheckpointHead head;
  head.mesh = output.fingerprint;
  head.control[point_name] = {point.load, point.step, double(point.load_step),
                              point.leans ? 1.0 : 0.0, double(point.releases)};
  head.parameters = output.parameters;
  head.files = output.files;
  output::StateSources states;
  for (const auto& [name, part] : parts_of(wall))
    states.emplace_back(name, [part = part] { return part->save(); });
  states.emplace_back(point_name, [&] {
    fields::State state = fields::state_on(wall.mesh());
    if (!point.shape.empty())
      state.arrays[shape_name] = fields::rows_of(point.shape, wall.mesh().n_owned);
    return state;
  });
  output::write_checkpoint(output.folder.file(file_name), head, states, wall.mesh().comm);
}

/// Brings the wall to where the search was left. Collective.
problems::PrestressPoint restore(const std::string& path, problems::SolidProblem& wall) {
  const CommPtr comm = wall.mesh().comm;
  std::optional<output::CheckpointFile> file;
  on_all(*comm, [&] { file.emplace(path); });
  for (const auto& [name, part] : parts_of(wall))
    part->restore(file->read(name, part->save().places, comm));
  const std::vector<double>& numbers = file->head().control.at(point_name);
  problems::PrestressPoint point{numbers.at(0), numbers.at(1), static_cast<int>(numbers.at(2)),
                                 numbers.size() > 3 && numbers[3] != 0.0};
  if (numbers.size() > 4) point.releases = static_cast<int>(numbers[4]);
  const fields::State state = file->read(point_name, fields::state_on(wall.mesh()).places, comm);
  if (state.has_array(shape_name))
    point.shape = fields::as_vectors(state.array(shape_name, 3).values);
  return point;
}

/// Gives the wall what was found.
Outcome give(const problems::Prestress& found, problems::SolidProblem& wall) {
  const Outcome stretched = wall.field().set_prestretch(found.prestretch);
  if (stretched.is_success()) {
    wall.field().set_spring_offset(found.offset);
    wall.take(found.state);
    wall.field().settle(wall.state());
  }
  return stretched;
}

/// What a run says that a signal has ended. kept: the part of the load in the file, 0 without one.
std::string about_stop(int signal, double kept, bool has_checkpoints) {
  std::string text = "stopped by " + signal_name(signal) + " in the prestress, ";
  if (!has_checkpoints) return text + "without a checkpoint, since \"checkpoint every\" is 0.";
  if (kept == 0.0) return text + "before there was a step to continue from.";
  return text + formatted("with %.3g of the load borne. Continue with --restart.", kept);
}

}  // namespace

std::optional<output::CheckpointHead> begun_prestress(const setup::Case& the_case,
                                                      const Domain& domain) {
  if (!domain.has("wall")) return {};
  const Comm& comm = *domain.comm;
  const std::string& folder = the_case.output.folder;
  const std::string path = folder + "/" + file_name;
  bool is_there = false;
  on_root(comm, [&] {
    is_there = output::checkpoints_in(folder).empty() && std::filesystem::exists(path);
  });
  if (!all_agree(comm, is_there || comm.getRank() > 0)) return {};
  output::CheckpointHead head;
  on_all(comm, [&] { head = output::CheckpointFile(path).head(); });
  TUNICA_CHECK(head.mesh == domain.fingerprint,
               "--restart: " + path + " belongs to another mesh than " + the_case.mesh->file +
                   ". A run continues with the mesh it began with.");
  return head;
}

Outcome take_prestress(const problems::SolidSettings& settings, RunOutput& output,
                       problems::SolidProblem& wall, problems::FluidProblem* fluid) {
  if (settings.prestress.pressure == 0.0 || output.restart) return Outcome::success();
  catch_stop_signals();
  const Stopwatch watch;
  const CommPtr comm = wall.mesh().comm;
  problems::PrestressPoint from;
  if (output.resumes_prestress) from = restore(output.folder.file(file_name), wall);
  PrestressLog log(output, comm->getRank() == 0, from);
  double kept = from.load;
  problems::PrestressWatch looks_on;
  looks_on.report = [&](const problems::PrestressIteration& now) { log.tell(now); };
  looks_on.say = [&](const std::string& text) {
    if (comm->getRank() == 0) io::print_line("prestress: " + text);
  };
  looks_on.goes_on = [&](const problems::PrestressPoint& point, const problems::Prestress& found) {
    const Outcome given = give(found, wall);
    if (given.is_success() && output.settings.checkpoint_every > 0) {
      save(point, wall, output);
      kept = point.load;
    }
    const int signal = static_cast<int>(global_max(*comm, stop_signal()));
    if (signal != 0)
      output.stopped = about_stop(signal, kept, output.settings.checkpoint_every > 0);
    return signal == 0;
  };
  Result<problems::Prestress> found = Result<problems::Prestress>::failure("stopped");
  try {
    found = problems::find_prestress(settings, wall, looks_on, from);
  } catch (const StopRequest& request) {
    output.stopped = about_stop(request.signal, kept, output.settings.checkpoint_every > 0);
  }
  log.record(output.record, watch.seconds());
  if (!output.stopped.empty()) return Outcome::success();
  if (found.is_failure()) return found.outcome();
  if (fluid != nullptr) fluid->set_initial_pressure(settings.prestress.pressure);
  return give(found.value(), wall);
}

}  // namespace tunica::run
