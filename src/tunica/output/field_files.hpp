#pragma once
#include <string>
#include <vector>

#include "tunica/base/outcome.hpp"
#include "tunica/base/types.hpp"
#include "tunica/output/xdmf.hpp"

namespace tunica::output {

constexpr const char* hdf5_name = "fields.h5";
constexpr const char* xdmf_name = "fields.xdmf";    // for readers of version 3
constexpr const char* xdmf2_name = "fields.xdmf2";  // of version 2; ParaView knows the ending

/// The attribute of a step in fields.h5 that is written last.
constexpr const char* time_name = "time";
/// The attribute of an array in fields.h5 that says where its rows stand.
constexpr const char* centre_name = "centre";
constexpr const char* at_nodes = "node";
constexpr const char* at_cells = "cell";

/// Gives the field files of a folder names that are free, fields.old.h5, fields.old.xdmf and
/// fields.old.xdmf2 or such. Not collective.
Outcome set_fields_aside(const std::string& folder);

/// "step_000016", the group of a step in fields.h5.
std::string step_group(int step);

/// Takes the steps behind that one out of fields.h5, finished or not. Collective. Throws
/// MachineFault on all ranks, NoRoom where the file itself is sound.
void drop_steps_behind(int step, const std::string& folder, const CommPtr& comm);

/// fields.xdmf and fields.xdmf2 of a folder, on one rank.
///
/// They name every step and are made anew as a whole, so that a reader finds a whole file at any
/// time. So that this stays cheap they are allowed to lag behind by one step in a hundred; a run
/// that comes to its end or goes on brings them up to date.
class XdmfFiles {
public:
  explicit XdmfFiles(std::string folder) : folder_(std::move(folder)) {}
  /// Brings them up to date where the disk lets it: the way out of an exception.
  ~XdmfFiles();
  XdmfFiles(const XdmfFiles&) = delete;
  XdmfFiles& operator=(const XdmfFiles&) = delete;

  /// Takes the steps of fields.h5 up to that one, or says why it cannot be continued: its grids
  /// must be of the sizes of these, which lack what the steps hold.
  Outcome take_steps(int last, const std::vector<xdmf::Grid>& grids);
  void add(const xdmf::Step& step) { document_.add(step, hdf5_name); }

  /// Replaces both files.
  Outcome replace();
  /// Replaces the files if they lag behind too far.
  Outcome replace_if_due();

private:
  std::string folder_;
  xdmf::Document document_;
  int n_written_ = -1;
};

}  // namespace tunica::output
