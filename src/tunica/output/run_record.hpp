#pragma once
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::output {

enum class RunStatus { running, done, not_converged, failed };

/// What a run was and how it went: "run.json".
///
///   program, status, message, started, ended   texts; dates in UTC; ended null while running
///   ranks, memory                              peak resident memory [MB] of one rank and of all
///   versions, sizes, timings [s], …            one object per section
///
/// The file is replaced as a whole, so that readers never meet a part of it.
class RunRecord {
public:
  /// int and bool stay what they are; string literals become string.
  using Value = std::variant<bool, int, long long, double, std::string>;

  RunRecord(const std::string& path, const std::string& program, const std::string& version,
            const CommPtr& comm);
  /// A record that nobody finished says "failed".
  ~RunRecord();
  RunRecord(const RunRecord&) = delete;
  RunRecord& operator=(const RunRecord&) = delete;

  /// Sets an entry of a section: set("sizes", "fluid points", 12345).
  void set(const std::string& section, const std::string& key, Value value);
  /// Adds seconds to an entry of "timings".
  void add_time(const std::string& name, double seconds);

  /// Goes on with the record of the run that is restarted after that step: keeps when it was
  /// started and adds this restart to those of the section "restarts".
  void take_over(int step);

  /// Writes with status "running". Collective. Throws MachineFault on all ranks if the
  /// disk refuses.
  void save();
  /// Writes the end of the run. Collective, throws as save().
  void finish(RunStatus status, const std::string& message = "");

  /// What the file holds (JSON), for other files of the run that repeat a part of it.
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
};

}  // namespace tunica::output
