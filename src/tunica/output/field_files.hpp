#pragma once
#include <string>
#include <vector>

#include "tunica/base/outcome.hpp"
#include "tunica/base/types.hpp"

namespace tunica::output {

constexpr const char* hdf5_name = "fields.h5";
constexpr const char* xdmf_name = "fields.xdmf";    // for readers of version 3
constexpr const char* xdmf2_name = "fields.xdmf2";  // of version 2; ParaView knows the ending

struct GridSize {
  std::string name;
  long long points, cells;
};

/// Whether the field files of a folder can go on behind that step: the grids are of these sizes and
/// all finished steps are there. Not collective.
Outcome can_be_continued(const std::string& folder, const std::vector<GridSize>& grids, int step);

/// Gives the field files of a folder names that are free, fields.old.h5, fields.old.xdmf and
/// fields.old.xdmf2 or such. Not collective.
Outcome set_fields_aside(const std::string& folder);

/// The XDMF text of the steps of a folder up to that one. Not collective.
std::string xdmf_up_to(int step, const std::string& folder);

/// Takes the steps behind that one out of fields.h5, finished or not. Collective. Throws
/// MachineFault on all ranks, NoRoom where the file itself is sound.
void drop_steps_behind(int step, const std::string& folder, const CommPtr& comm);

}  // namespace tunica::output
