#pragma once
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::output {

enum class RunStatus { running, done, stopped, not_converged, failed };

/// A part of a run, from its beginning or a restart on: an entry of "history".
struct Leg {
  int after_step = 0;  ///< it begins behind this one
  std::string at{};    ///< UTC
  int ranks = 1;
  std::string parameters{};  ///< file of the folder that holds them
  struct Change {
    std::string key, before, now;
  };
  std::vector<Change> changes{};  ///< against the leg that made its first checkpoint
};

/// The history in a run.json, oldest first; nothing where there is none. Not collective.
std::vector<Leg> read_history(const std::string& path);

/// The one that made the checkpoint of a step, which is not empty.
const Leg& leg_of_step(const std::vector<Leg>& history, int step);

/// The section with the peaks of memory of each rank at the ends of phases.
constexpr const char* memory_section = "memory by phase [MB]";

/// Record of a run and its outcome: "run.json".
///
///   program, status, message, started, ended   texts; dates in UTC; ended null while running
///   ranks, memory                              peak resident memory [MB] of one rank and of all
///   history                                    legs of the run, each with what a restart changed
///   versions, sizes, timings [s], …            one object per section
///
/// The file is replaced as a whole, so that readers never meet a part of it.
class RunRecord {
public:
  /// int and bool stay what they are; string literals become string.
  using Value = std::variant<bool, int, long long, double, std::string, std::vector<double>>;

  RunRecord(const std::string& path, const std::string& program, const std::string& version,
            const CommPtr& comm);
  /// A record that nobody finished says "failed".
  ~RunRecord();
  RunRecord(const RunRecord&) = delete;
  RunRecord& operator=(const RunRecord&) = delete;

  /// Sets an entry of a section: set("sizes", "fluid points", 12345).
  void set(const std::string& section, const std::string& key, Value value);
  /// Notes the peaks of memory up to here, of each rank, in the section "memory by phase [MB]".
  /// Collective.
  void note_memory(const std::string& phase);
  /// Adds seconds to an entry of "timings".
  void add_time(const std::string& name, double seconds);

  /// Goes on with the record of the run that is restarted: keeps when it was started, and its
  /// history. On rank 0.
  void take_over(const std::vector<Leg>& history);
  /// Adds what begins now to the history.
  void begin_leg(Leg leg);

  /// Writes with status "running". Collective. Throws MachineFault on all ranks if the
  /// disk refuses.
  void save();
  /// Writes the end of the run. Collective, throws as save().
  void finish(RunStatus status, const std::string& message = "");

  /// Content of the file (JSON), for other files of the run that repeat a part of it.
  std::string text() const;

private:
  using Section = std::vector<std::pair<std::string, Value>>;

  void measure_memory();
  void replace();

  std::string path_, program_, message_, started_, ended_;
  CommPtr comm_;
  RunStatus status_ = RunStatus::running;
  double memory_of_one_ = 0.0, memory_of_all_ = 0.0;  ///< [MB]
  std::vector<std::pair<std::string, Section>> sections_;
  std::vector<Leg> history_;
};

}  // namespace tunica::output
