#pragma once
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tunica/base/types.hpp"
#include "tunica/fields/state.hpp"

namespace tunica::output {

/// Where a run stood.
struct CheckpointHead {
  std::string mesh;                    ///< its fingerprint
  int step = 0;                        ///< accepted last, counted from 1
  double time = 0.0, step_size = 0.0;  ///< [ms]; a size of zero: steps of any size
  double seconds = 0.0;                ///< spent on the steps up to here
  /// State that the step control needs to continue, by name.
  std::map<std::string, std::vector<double>> control{};
  std::string parameters{};  ///< with which the step was made, XML; empty in older files
  /// Hashes of what the files held that these name, by key; on rank 0.
  std::map<std::string, std::string> files{};
};

constexpr const char* checkpoint_format = "tunica-checkpoint 5";

/// Under which the hashes of files stand among the texts of the part "run", and
/// under which the numbers of the control stand among those of the part "run".
constexpr const char* file_prefix = "file ";
constexpr const char* control_prefix = "control ";

/// The parts of a run ("fluid", "coupling") by name, and what makes their states: the same whenever
/// it is asked, on all ranks.
using StateSources = std::vector<std::pair<std::string, std::function<fields::State()>>>;

/// Writes a checkpoint file, HDF5:
///
///   attribute "format" of the root = "tunica-checkpoint 5"; earlier ones are refused
///   /text_names  /texts                                         strings
///   /number_names  /number_counts  /numbers
///   /array_names  /array_columns  /array_checksums
///   /parameters                                                 XML, in pieces
///   /head_checksum                                              of all above
///   `/<part>/places`                                              int64, vertex or element of each
///   row
///   `/<part>/<array>`                                             float64, rows × columns
///
/// Names are "`<part>/<name>`"; what the head has is of the part "run". The rows stand in any
/// order. A file of that name appears complete and on the disk, or not at all: until then it has
/// the ending ".tmp". Each state is made twice, and there is one at a time: together they would
/// take as much as a tenth of a run. Collective. Throws MachineFault on all ranks if the disk
/// refuses.
void write_checkpoint(const std::string& path, const CheckpointHead& head,
                      const StateSources& parts, const CommPtr& comm);

/// A checkpoint file. Every failure is an Error that begins with the path.
class CheckpointFile {
public:
  /// Reads all but the arrays.
  explicit CheckpointFile(const std::string& path);

  const CheckpointHead& head() const { return head_; }
  bool has(const std::string& part) const;
  /// "`<part>/<name>`".
  const std::string& text(const std::string& name) const;
  /// Compares all arrays with their checksums, part by part. Not collective; takes room for few
  /// rows at a time.
  void verify() const;
  /// The state of a part with the rows of these places, in this order, on every rank. No rank
  /// takes in more than its portion of the file and its rows. Throws on all ranks alike.
  /// Collective.
  fields::State read(const std::string& part, const std::vector<GlobalOrdinal>& places,
                     const CommPtr& comm) const;

private:
  struct Entry {
    int columns;
    std::string checksum;
  };

  double number(const std::string& name) const;

  std::string path_;
  CheckpointHead head_;
  std::map<std::string, std::string> texts_;
  std::map<std::string, std::vector<double>> numbers_;
  std::map<std::string, Entry> arrays_;
};

}  // namespace tunica::output
