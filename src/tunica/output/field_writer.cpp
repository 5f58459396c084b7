#include "tunica/output/field_writer.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/fault_point.hpp"
#include "tunica/base/portion.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/io/atomic_file.hpp"
#include "tunica/io/hdf5_arrays.hpp"
#include "tunica/io/parallel_hdf5.hpp"

namespace tunica::output {

namespace {

/// What is wrong with this rank's part of a grid, empty if nothing.
std::string misfit(const Grid& grid, long long points_total) {
  const std::string where = "output grid \"" + grid.name + "\": ";
  const auto owned = static_cast<long long>(grid.points.size());
  if (points_total != grid.points_global) return where + "the ranks own another number of points";
  if (grid.first_point < 0 || grid.first_point + owned > grid.points_global) {
    return where + "the owned points lie outside the global range";
  }
  if (grid.vertex.size() != grid.points.size() || grid.tet_number.size() != grid.tets.size()) {
    return where + "every point needs a vertex of the mesh and every tet a number";
  }
  if (grid.region.size() != grid.tets.size() || grid.partition.size() != grid.tets.size()) {
    return where + "region and partition need one entry per tet";
  }
  for (const auto& tet : grid.tets) {
    for (const long long point : tet) {
      if (point < 0 || point >= grid.points_global) return where + "a tet names an unknown point";
    }
  }
  return "";
}

/// From xx, yy, zz, xy, yz, zx to xx, xy, xz, yy, yz, zz, where an array has tensors.
void bring_into_xdmf_order(Array& array) {
  if (array.components != 6) return;
  for (std::size_t row = 0; row + 6 <= array.values.size(); row += 6) {
    const double* const t = array.values.data() + row;
    const std::array<double, 6> sorted{t[0], t[3], t[5], t[1], t[4], t[2]};
    std::copy(sorted.begin(), sorted.end(), array.values.data() + row);
  }
}

void write_array(io::Hdf5File& file, const std::string& group, io::Hdf5File::Rows rows,
                 const RowOrder* order, const Array& array, const std::string& centre) {
  rows.columns = array.components;
  std::vector<double> values;
  const std::vector<double>* chosen = &array.values;
  if (order != nullptr) chosen = &(values = (*order)(*chosen, array.components));
  file.write(group + "/" + array.name, rows, chosen->data());
  file.attribute(group + "/" + array.name, centre_name, centre);
}

/// An upper bound of what HDF5 writes: the numbers and its own tables.
long long bytes_of(long long numbers, std::size_t datasets) {
  return 8 * numbers + 4096 * static_cast<long long>(datasets) + 65536;
}

}  // namespace

FieldWriter::FieldWriter(const std::string& folder, const std::vector<Grid>& grids,
                         const CommPtr& comm, int kept_step)
    : folder_(folder), comm_(comm) {
  std::string problem;
  for (const Grid& grid : grids) {
    shapes_.push_back(shape_of(grid));
    if (problem.empty()) problem = misfit(grid, global_sum(*comm_, shapes_.back().points));
  }
  throw_if_any<std::logic_error>(*comm_, problem);
  if (comm_->getRank() == 0) xdmf_ = std::make_unique<XdmfFiles>(folder_);

  if (can_go_on(kept_step))
    go_on(grids);
  else
    begin_anew(grids);
  finish();
}

bool FieldWriter::can_go_on(int kept_step) {
  if (kept_step == 0) return false;
  const bool is_root = comm_->getRank() == 0;
  const bool exists = std::filesystem::exists(folder_ + "/" + hdf5_name);
  Outcome going_on = Outcome::success();
  if (is_root) {
    std::vector<xdmf::Grid> grids;
    for (const Shape& s : shapes_) grids.push_back(description_of(s));
    going_on = exists ? xdmf_->take_steps(kept_step, grids) : Outcome::failure("it does not exist");
  }
  going_on = agreed(*comm_, going_on);
  // First: a run that is killed meanwhile must not leave an XDMF of what is gone.
  if (going_on.is_success()) finish();
  try {
    if (going_on.is_success()) drop_steps_behind(kept_step, folder_, comm_);
  } catch (const io::NoRoom&) {
    throw;
  } catch (const MachineFault& fault) {  // a killed run may leave a group in pieces
    going_on = Outcome::failure(fault.what());
  }
  if (going_on.is_success()) return true;
  if (is_root) xdmf_ = std::make_unique<XdmfFiles>(folder_);
  on_root_or_fault(*comm_, [&] { return exists ? set_fields_aside(folder_) : Outcome::success(); });
  remark_ = std::string(hdf5_name) + " cannot be continued and begins anew: " + going_on.reason();
  return false;
}

void FieldWriter::go_on(const std::vector<Grid>& grids) {
  for (std::size_t g = 0; g < grids.size(); ++g) {
    Shape& s = shapes_[g];
    const std::vector<GlobalOrdinal> vertices(grids[g].vertex.begin(), grids[g].vertex.end());
    s.point_order = take_share(s.name + "/vertices", vertices, s.first_point, s.points);
    s.cell_order = take_share(s.name + "/tet_numbers", grids[g].tet_number, s.first_cell, s.cells);
  }
}

std::shared_ptr<const RowOrder> FieldWriter::take_share(const std::string& dataset,
                                                        const std::vector<GlobalOrdinal>& given,
                                                        long long& first, long long& count) const {
  std::vector<GlobalOrdinal> numbers;
  on_all(*comm_, [&] {
    const io::Hdf5Reader in(folder_ + "/" + hdf5_name);
    const Portion mine = portion_of(static_cast<long long>(in.rows(dataset)), *comm_);
    first = mine.first;
    count = mine.count;
    numbers.resize(count);
    in.read(dataset, 1, first, count, numbers.data());
  });
  return std::make_shared<RowOrder>(given, numbers, comm_);
}

void FieldWriter::begin_anew(const std::vector<Grid>& grids) {
  if (comm_->getRank() == 0) {  // an open viewer keeps the old files and disturbs nobody
    std::remove((folder_ + "/" + xdmf_name).c_str());
    std::remove((folder_ + "/" + xdmf2_name).c_str());
    std::remove((folder_ + "/" + hdf5_name).c_str());
  }
  comm_->barrier();
  write_geometry(grids);
}

FieldWriter::Shape FieldWriter::shape_of(const Grid& grid) const {
  const auto cells = static_cast<long long>(grid.tets.size());
  Shape shape;
  shape.name = grid.name;
  shape.points_total = grid.points_global;
  shape.first_point = grid.first_point;
  shape.points = shape.given_points = static_cast<long long>(grid.points.size());
  shape.cells_total = global_sum(*comm_, cells);
  shape.first_cell = sum_before(*comm_, cells);
  shape.cells = shape.given_cells = cells;
  shape.regions = grid.regions;
  return shape;
}

void FieldWriter::write_geometry(const std::vector<Grid>& grids) const {
  const std::string path = folder_ + "/" + hdf5_name;
  io::Hdf5File(path, io::Hdf5File::Mode::create, 0, comm_).close();

  long long numbers = 0;
  for (const Shape& s : shapes_) numbers += 4 * s.points_total + 7 * s.cells_total;
  io::Hdf5File file(path, io::Hdf5File::Mode::extend, bytes_of(numbers, 7 * shapes_.size()), comm_);
  for (std::size_t g = 0; g < grids.size(); ++g) {
    const Shape& s = shapes_[g];
    const std::string group = "/" + s.name;
    const auto* points = reinterpret_cast<const double*>(grids[g].points.data());
    const auto* tets = reinterpret_cast<const long long*>(grids[g].tets.data());
    file.write(group + "/points", {s.points_total, s.first_point, s.points, 3}, points);
    file.write(group + "/tets", {s.cells_total, s.first_cell, s.cells, 4}, tets);
    const io::Hdf5File::Rows per_cell{s.cells_total, s.first_cell, s.cells, 1};
    file.write(group + "/vertices", {s.points_total, s.first_point, s.points, 1},
               grids[g].vertex.data());
    file.write(group + "/tet_numbers", per_cell, grids[g].tet_number.data());
    file.write(group + "/region", per_cell, grids[g].region.data());
    if (!grids[g].regions.empty()) file.write(group + "/region_names", grids[g].regions);
    file.write(group + "/partition", per_cell, grids[g].partition.data());
  }
  file.close();
}

void FieldWriter::write(int step, double time, const std::string& grid,
                        std::vector<Array> point_data, std::vector<Array> cell_data) {
  const auto shape =
      std::find_if(shapes_.begin(), shapes_.end(), [&](const Shape& s) { return s.name == grid; });
  if (shape == shapes_.end()) {
    complaint_ = "field output: there is no grid \"" + grid + "\"";
    return;
  }
  for (std::vector<Array>* arrays : {&point_data, &cell_data})
    for (Array& array : *arrays) bring_into_xdmf_order(array);
  Block block{*shape, std::move(point_data), std::move(cell_data)};
  if (complaint_.empty()) complaint_ = complaint(step, time, block);
  step_ = step;
  time_ = time;
  blocks_.push_back(std::move(block));
}

std::string FieldWriter::complaint(int step, double time, const Block& block) const {
  const std::string where = "field output of \"" + block.shape.name + "\": ";
  if (!blocks_.empty() && (step != step_ || time != time_)) {
    return where + "step " + std::to_string(step_) + " is not finished";
  }
  for (const Block& other : blocks_) {
    if (other.shape.name == block.shape.name) return where + "given twice";
  }
  std::set<std::string> names;
  const auto check = [&](const Array& array, long long rows) -> std::string {
    const std::string what = where + "array \"" + array.name + "\" ";
    if (array.components != 1 && array.components != 3 && array.components != 6) {
      return what + "has " + std::to_string(array.components) + " components, expected 1, 3 or 6";
    }
    if (static_cast<long long>(array.values.size()) != rows * array.components) {
      return what + "has " + std::to_string(array.values.size()) + " values, expected " +
             std::to_string(rows * array.components);
    }
    return names.insert(array.name).second ? "" : what + "is given twice";
  };
  for (const Array& array : block.point_data) {
    if (auto text = check(array, block.shape.given_points); !text.empty()) return text;
  }
  for (const Array& array : block.cell_data) {
    if (auto text = check(array, block.shape.given_cells); !text.empty()) return text;
  }
  return "";
}

void FieldWriter::finish_step() {
  throw_if_any<std::logic_error>(*comm_, complaint_);
  if (blocks_.empty()) return;

  const std::string group = "/" + step_group(step_);
  write_blocks(group);
  on_root_or_fault(*comm_, [&] {
    xdmf_->add(describe_step(group));
    return xdmf_->replace_if_due();
  });
  blocks_.clear();
}

void FieldWriter::finish() {
  on_root_or_fault(*comm_, [&] { return xdmf_->replace(); });
}

void FieldWriter::write_blocks(const std::string& group) const {
  long long numbers = 0;
  std::size_t datasets = 0;
  for (const Block& block : blocks_) {
    for (const Array& a : block.point_data) numbers += a.components * block.shape.points_total;
    for (const Array& a : block.cell_data) numbers += a.components * block.shape.cells_total;
    datasets += block.point_data.size() + block.cell_data.size();
  }
  io::Hdf5File file(folder_ + "/" + hdf5_name, io::Hdf5File::Mode::extend,
                    bytes_of(numbers, datasets), comm_);
  file.compress(compression_);
  fault_point("field output");
  file.make_group(group);
  file.attribute(group, "step", static_cast<long long>(step_));
  for (const Block& block : blocks_) {
    const Shape& s = block.shape;
    const std::string place = group + "/" + s.name;
    for (const Array& array : block.point_data) {
      write_array(file, place, {s.points_total, s.first_point, s.points, 1}, s.point_order.get(),
                  array, at_nodes);
    }
    for (const Array& array : block.cell_data) {
      write_array(file, place, {s.cells_total, s.first_cell, s.cells, 1}, s.cell_order.get(), array,
                  at_cells);
    }
  }
  file.attribute(group, time_name, time_);  // last: a step that lacks something must not get it
  file.close();
}

xdmf::Grid FieldWriter::description_of(const Shape& shape) {
  xdmf::Grid grid{shape.name, shape.points_total, shape.cells_total, {}, shape.regions};
  for (const char* tag : {"region", "partition"})
    grid.attributes.push_back({tag, xdmf::Centre::cell, 1, true, "/" + shape.name + "/" + tag});
  return grid;
}

xdmf::Step FieldWriter::describe_step(const std::string& group) const {
  xdmf::Step step{time_, {}};
  for (const Block& block : blocks_) {
    xdmf::Grid grid = description_of(block.shape);
    const auto first = grid.attributes.size();
    const std::string place = group + "/" + grid.name + "/";
    for (const Array& a : block.point_data)
      grid.attributes.push_back({a.name, xdmf::Centre::node, a.components, false, place + a.name});
    for (const Array& a : block.cell_data)
      grid.attributes.push_back({a.name, xdmf::Centre::cell, a.components, false, place + a.name});
    // As HDF5 lists them to a run that goes on.
    std::sort(grid.attributes.begin() + first, grid.attributes.end(),
              [](const auto& one, const auto& other) { return one.name < other.name; });
    step.grids.push_back(std::move(grid));
  }
  return step;
}

}  // namespace tunica::output
