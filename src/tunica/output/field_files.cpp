#include "tunica/output/field_files.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/io/atomic_file.hpp"
#include "tunica/io/hdf5_arrays.hpp"
#include "tunica/io/parallel_hdf5.hpp"
#include "tunica/output/xdmf.hpp"

namespace tunica::output {

namespace {

const std::string step_group = "step_";

int number_of(const std::string& group) { return std::stoi(group.substr(step_group.size())); }

std::string content(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

void check_steps(const io::Hdf5Reader& in, const std::string& xdmf) {
  const std::string mark = ":/" + step_group;
  for (std::size_t at = xdmf.find(mark); at != std::string::npos; at = xdmf.find(mark, at + 1)) {
    const std::size_t begin = at + 2, end = xdmf.find('/', begin);
    const std::string group = xdmf.substr(begin, end - begin);
    TUNICA_CHECK(in.has(group), "the group /" + group + " is missing");
  }
}

}  // namespace

Outcome can_be_continued(const std::string& folder, const std::vector<GridSize>& grids, int step) {
  try {
    const io::Hdf5Reader in(folder + "/" + hdf5_name);
    for (const GridSize& grid : grids) {
      const std::size_t points = in.rows(grid.name + "/vertices");
      const std::size_t cells = in.rows(grid.name + "/tet_numbers");
      TUNICA_CHECK(static_cast<long long>(points) == grid.points &&
                       static_cast<long long>(cells) == grid.cells,
                   "the grid \"" + grid.name + "\" has another size");
    }
    TUNICA_CHECK(content(folder + "/" + xdmf_name).find("mesh_displacement") == std::string::npos,
                 "it is of a version that gave the displacement of the fluid another name");
    check_steps(in, xdmf_up_to(step, folder));
  } catch (const Error& error) {
    return Outcome::failure(error.what());
  }
  return Outcome::success();
}

Outcome set_fields_aside(const std::string& folder) {
  const Result<std::string> new_path = io::set_aside(folder + "/" + hdf5_name);
  if (new_path.is_failure()) return new_path.outcome();
  const std::filesystem::path moved(new_path.value());
  const std::string name = moved.filename().string(), mark = std::string(hdf5_name) + ":";
  for (const std::string old : {xdmf_name, xdmf2_name}) {
    std::string text = content(folder + "/" + old);
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1))
      text.replace(at, mark.size() - 1, name);
    const std::string renamed = moved.stem().string() + old.substr(old.find('.'));
    const Outcome outcome = io::replace_file(folder + "/" + renamed, text);
    if (outcome.is_failure()) return outcome;
  }
  return Outcome::success();
}

std::string xdmf_up_to(int step, const std::string& folder) {
  return xdmf::steps_up_to(step, content(folder + "/" + xdmf_name));
}

void drop_steps_behind(int step, const std::string& folder, const CommPtr& comm) {
  io::Hdf5File file(folder + "/" + hdf5_name, io::Hdf5File::Mode::extend, 65536, comm);
  for (const std::string& group : file.groups())
    if (group.rfind(step_group, 0) == 0 && number_of(group) > step) file.remove(group);
  file.close();
}

}  // namespace tunica::output
