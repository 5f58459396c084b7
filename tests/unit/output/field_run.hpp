#pragma once
#include <hdf5.h>

#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "tunica/io/hdf5_arrays.hpp"
#include "tunica/output/field_writer.hpp"
#include "tunica/output/run_folder.hpp"
#include "unit/io/scratch.hpp"

namespace tunica::output::test {

inline Vec3 position(long long point) {
  const auto p = static_cast<double>(point);
  return {p, p * p, 1.0 / (p + 1.0)};
}

inline double value(int step, long long row, int component) {
  return 1000.0 * step + static_cast<double>(row) + 0.1 * component;
}

/// Points 0..total-1 and a tet (i, i+1, i+2, i+3) for each but the last three, shared out among
/// all ranks but the idle one. A tet is written where its first point is owned.
/// The mesh's vertex of a point is its number from behind.
inline Grid chain(const std::string& name, long long total, int idle) {
  const int size = world()->getSize(), rank = world()->getRank();
  const int workers = size == 1 ? 1 : size - 1;
  const auto start = [&](int r) {
    return total * (size == 1 ? r : r > idle ? r - 1 : r) / workers;
  };
  Grid grid;
  grid.name = name;
  grid.regions = {"blood", "media"};
  grid.points_global = total;
  grid.first_point = start(rank);
  const long long end = size > 1 && rank == idle ? start(rank) : start(rank + 1);
  for (long long i = grid.first_point; i < end; ++i) {
    grid.points.push_back(position(i));
    grid.vertex.push_back(static_cast<int>(total - i));
    if (i + 3 >= total) continue;
    grid.tets.push_back({i, i + 1, i + 2, i + 3});
    grid.tet_number.push_back(static_cast<int>(i));
    grid.region.push_back(static_cast<int>(i % 2));
    grid.partition.push_back(rank);
  }
  return grid;
}

inline Array point_array(const Grid& grid, const std::string& name, int components, int step) {
  Array array{name, components, {}};
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    for (int c = 0; c < components; ++c) {
      array.values.push_back(value(step, grid.first_point + static_cast<long long>(i), c));
    }
  }
  return array;
}

inline Array cell_array(const Grid& grid, const std::string& name, int step) {
  Array array{name, 1, {}};
  for (const auto& tet : grid.tets) array.values.push_back(value(step, tet[0], 0));
  return array;
}

struct Run {
  std::string folder;
  Grid fluid = chain("fluid", 23, world()->getSize() - 1);
  Grid wall = chain("wall", 11, 0);
  FieldWriter writer;

  explicit Run(const std::string& name)
      : folder(RunFolder(scratch(name), world()).path()), writer(folder, {fluid, wall}, world()) {}

  void write(int step) {
    const double time = 0.1 * step;
    writer.write(step, time, "fluid",
                 {point_array(fluid, "velocity", 3, step), point_array(fluid, "pressure", 1, step)},
                 {});
    writer.write(step, time, "wall", {point_array(wall, "cauchy_stress", 6, step)},
                 {cell_array(wall, "von_mises", step)});
  }
};

/// A whole dataset, read without MPI; empty with a failed test if it is not there.
inline std::vector<double> read(const std::string& folder, const std::string& name) {
  const hid_t file = H5Fopen((folder + "/fields.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
  const hid_t space = H5Dget_space(dataset);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space);
  H5Dclose(dataset);
  H5Fclose(file);
  return values;
}

/// Paths the XDMF names, and how many of them the HDF5 file does not have.
inline std::pair<std::vector<std::string>, int> named_and_missing(
    const std::string& folder, const char* name = "/fields.xdmf") {
  const std::string text = content(folder + name);
  const std::regex reference("fields\\.h5:(/[^<]*)<");
  const hid_t file = H5Fopen((folder + "/fields.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  std::pair<std::vector<std::string>, int> result{{}, 0};
  for (std::sregex_iterator it(text.begin(), text.end(), reference), end; it != end; ++it) {
    result.first.push_back((*it)[1]);
    const hid_t dataset = H5Dopen2(file, result.first.back().c_str(), H5P_DEFAULT);
    if (dataset < 0)
      ++result.second;
    else
      H5Dclose(dataset);
  }
  H5Fclose(file);
  return result;
}

inline int count(const std::string& text, const std::string& words) {
  int found = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
    ++found;
  return found;
}

}  // namespace tunica::output::test
