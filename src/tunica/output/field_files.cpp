#include "tunica/output/field_files.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/io/atomic_file.hpp"
#include "tunica/io/hdf5_arrays.hpp"
#include "tunica/io/parallel_hdf5.hpp"

namespace tunica::output {

namespace {

const std::string step_prefix = "step_";

/// Whoever reads fields.h5 may have added groups of other names.
bool is_step(const std::string& name) {
  return name.rfind(step_prefix, 0) == 0 && name.size() > step_prefix.size() &&
         name.size() < step_prefix.size() + 10 &&
         name.find_first_not_of("0123456789", step_prefix.size()) == std::string::npos;
}

int number_of(const std::string& group) { return std::stoi(group.substr(step_prefix.size())); }

std::string content(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

void check_size(const io::Hdf5Reader& in, const xdmf::Grid& grid) {
  const std::size_t points = in.rows(grid.name + "/vertices");
  const std::size_t cells = in.rows(grid.name + "/tet_numbers");
  TUNICA_CHECK(
      static_cast<long long>(points) == grid.points && static_cast<long long>(cells) == grid.cells,
      "the grid \"" + grid.name + "\" has another size");
}

/// Their groups, in their order. What was not finished has no time.
std::vector<std::string> steps_up_to(int last, const io::Hdf5Reader& in) {
  std::vector<std::string> groups;
  for (const std::string& name : in.names("/"))
    if (is_step(name) && number_of(name) <= last && in.has_attribute(time_name, name))
      groups.push_back(name);
  std::sort(groups.begin(), groups.end(), [](const std::string& one, const std::string& other) {
    return number_of(one) < number_of(other);
  });
  return groups;
}

/// What a step has of a grid. Throws Error where that is nothing.
xdmf::Grid grid_of(const io::Hdf5Reader& in, const std::string& group, const xdmf::Grid& geometry) {
  xdmf::Grid grid = geometry;
  const std::string place = group + "/" + grid.name;
  for (const std::string& name : in.names(place)) {
    const std::string dataset = place + "/" + name;
    if (!in.has_attribute(centre_name, dataset)) continue;  // not ours
    const std::string centre = in.attribute(centre_name, dataset);
    TUNICA_CHECK(centre == at_nodes || centre == at_cells, dataset + " has no known centre");
    grid.attributes.push_back({name, centre == at_nodes ? xdmf::Centre::node : xdmf::Centre::cell,
                               in.columns(dataset), false, "/" + dataset});
  }
  TUNICA_CHECK(grid.attributes.size() > geometry.attributes.size(),
               "no array of " + place + " says where it stands; an earlier version made them");
  return grid;
}

}  // namespace

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

std::string step_group(int step) {
  std::array<char, 32> name;
  std::snprintf(name.data(), name.size(), "%s%06d", step_prefix.c_str(), step);
  return name.data();
}

void drop_steps_behind(int step, const std::string& folder, const CommPtr& comm) {
  io::Hdf5File file(folder + "/" + hdf5_name, io::Hdf5File::Mode::extend, 65536, comm);
  for (const std::string& group : file.groups())
    if (is_step(group) && number_of(group) > step) file.remove(group);
  file.close();
}

XdmfFiles::~XdmfFiles() {
  if (n_written_ >= 0 && document_.n_steps() > n_written_)
    static_cast<void>(replace());  // nobody is left to hear of a failure
}

Outcome XdmfFiles::take_steps(int last, const std::vector<xdmf::Grid>& grids) {
  xdmf::Document document;
  try {
    const io::Hdf5Reader in(folder_ + "/" + hdf5_name);
    for (const xdmf::Grid& grid : grids) check_size(in, grid);
    for (const std::string& group : steps_up_to(last, in)) {
      xdmf::Step step{in.number(time_name, group), {}};
      for (const xdmf::Grid& grid : grids) step.grids.push_back(grid_of(in, group, grid));
      document.add(step, hdf5_name);
    }
  } catch (const Error& error) {
    return Outcome::failure(error.what());
  }
  document_ = std::move(document);
  return Outcome::success();
}

Outcome XdmfFiles::replace() {
  const Outcome outcome = document_.replace_version_3(folder_ + "/" + xdmf_name);
  if (outcome.is_failure()) return outcome;
  const Outcome second = document_.replace_version_2(folder_ + "/" + xdmf2_name);
  if (second.is_success()) n_written_ = document_.n_steps();
  return second;
}

Outcome XdmfFiles::replace_if_due() {
  const int n_behind = document_.n_steps() - n_written_;
  return n_behind > 0 && 100 * n_behind >= document_.n_steps() ? replace() : Outcome::success();
}

}  // namespace tunica::output
