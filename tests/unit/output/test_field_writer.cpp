#include <hdf5.h>

#include <Teuchos_UnitTestHarness.hpp>
#include <regex>

#include "tunica/io/hdf5_arrays.hpp"
#include "tunica/output/field_writer.hpp"
#include "tunica/output/run_folder.hpp"
#include "unit/io/full_disk.hpp"
#include "unit/io/scratch.hpp"

namespace tunica::output::test {

namespace {

Vec3 position(long long point) {
  const auto p = static_cast<double>(point);
  return {p, p * p, 1.0 / (p + 1.0)};
}

double value(int step, long long row, int component) {
  return 1000.0 * step + static_cast<double>(row) + 0.1 * component;
}

/// Points 0..total-1 and a tet (i, i+1, i+2, i+3) for each but the last three, shared out among
/// all ranks but the idle one. A tet is written where its first point is owned.
/// The mesh's vertex of a point is its number from behind.
Grid chain(const std::string& name, long long total, int idle) {
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

Array point_array(const Grid& grid, const std::string& name, int components, int step) {
  Array array{name, components, {}};
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    for (int c = 0; c < components; ++c) {
      array.values.push_back(value(step, grid.first_point + static_cast<long long>(i), c));
    }
  }
  return array;
}

Array cell_array(const Grid& grid, const std::string& name, int step) {
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
std::vector<double> read(const std::string& folder, const std::string& name) {
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
std::pair<std::vector<std::string>, int> named_and_missing(const std::string& folder,
                                                           const char* name = "/fields.xdmf") {
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

int count(const std::string& text, const std::string& words) {
  int found = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
    ++found;
  return found;
}

}  // namespace

TEUCHOS_UNIT_TEST(field_writer, geometry_comes_back_from_any_number_of_ranks) {
  const Run run("geometry");
  const auto points = read(run.folder, "/fluid/points");
  const auto tets = read(run.folder, "/fluid/tets");
  const auto region = read(run.folder, "/fluid/region");
  TEST_EQUALITY(points.size(), 3u * 23u);
  TEST_EQUALITY(tets.size(), 4u * 20u);
  TEST_EQUALITY(read(run.folder, "/fluid/partition").size(), 20u);
  TEST_EQUALITY(read(run.folder, "/wall/tets").size(), 4u * 8u);
  const io::Hdf5Reader file(run.folder + "/fields.h5");
  TEST_EQUALITY(file.strings("/wall/region_names").at(1), "media");
  for (std::size_t p = 0; p < 23; ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      TEST_EQUALITY(points[3 * p + i], position(static_cast<long long>(p))[i]);
    }
  }
  for (std::size_t t = 0; t < 20; ++t) {
    TEST_EQUALITY(tets[4 * t + 3], static_cast<double>(t + 3));
    TEST_EQUALITY(region[t], static_cast<double>(t % 2));
  }
}

TEUCHOS_UNIT_TEST(field_writer, fields_come_back_from_any_number_of_ranks) {
  Run run("fields");
  for (const int step : {16, 32}) {
    run.write(step);
    run.writer.finish_step();
  }
  for (const int step : {16, 32}) {
    const std::string group = "/step_0000" + std::to_string(step);
    const auto velocity = read(run.folder, group + "/fluid/velocity");
    const auto von_mises = read(run.folder, group + "/wall/von_mises");
    TEST_EQUALITY(velocity.size(), 3u * 23u);
    TEST_EQUALITY(von_mises.size(), 8u);
    for (std::size_t i = 0; i < velocity.size(); ++i) {
      TEST_EQUALITY(velocity[i], value(step, static_cast<long long>(i / 3), i % 3));
    }
    for (std::size_t i = 0; i < von_mises.size(); ++i) {
      TEST_EQUALITY(von_mises[i], value(step, static_cast<long long>(i), 0));
    }
  }
}

TEUCHOS_UNIT_TEST(field_writer, symmetric_tensors_are_stored_in_the_order_of_xdmf) {
  Run run("tensors");
  run.write(1);
  run.writer.finish_step();
  const auto stress = read(run.folder, "/step_000001/wall/cauchy_stress");
  const std::array<int, 6> xx_xy_xz_yy_yz_zz{0, 3, 5, 1, 4, 2};
  for (std::size_t i = 0; i < 6; ++i) {
    TEST_EQUALITY(stress[6 * 7 + i], value(1, 7, xx_xy_xz_yy_yz_zz[i]));
  }
}

TEUCHOS_UNIT_TEST(field_writer, xdmf_names_only_what_is_in_the_file) {
  Run run("xdmf");
  TEST_EQUALITY(named_and_missing(run.folder).first.size(), 0u);
  for (const int step : {1, 2, 3}) {
    world()->barrier();
    run.write(step);
    const auto before = named_and_missing(run.folder);
    TEST_EQUALITY(before.first.size(), 12u * (step - 1));  // 4 of geometry and 2 fields, twice
    TEST_EQUALITY(before.second, 0);
    world()->barrier();
    run.writer.finish_step();
    const auto after = named_and_missing(run.folder);
    TEST_EQUALITY(after.first.size(), 12u * step);
    TEST_EQUALITY(after.second, 0);
  }
}

TEUCHOS_UNIT_TEST(field_writer, blocks_keep_their_names_in_readers_of_both_versions) {
  Run run("names");
  for (const int step : {1, 2, 3}) {
    run.write(step);
    run.writer.finish_step();
    world()->barrier();
    const std::string by_step = content(run.folder + "/fields.xdmf");
    // Version 3: no grid below a collection with a name but that over time.
    TEST_EQUALITY(count(by_step, "Collection\" CollectionType=\"Spatial"), step);
    TEST_EQUALITY(count(by_step, "<Grid GridType=\"Collection\" CollectionType=\"Spatial"), step);
    TEST_EQUALITY(count(by_step, "<Grid Name=\"wall\" GridType=\"Uniform"), step);
    // Version 2: a collection over time for each block.
    const std::string by_block = content(run.folder + "/fields.xdmf2");
    for (const char* name : {"fluid", "wall"}) {
      const std::string grid = "<Grid Name=\"" + std::string(name) + "\" GridType=\"";
      TEST_EQUALITY(count(by_block, grid + "Collection\" CollectionType=\"Temporal"), 1);
      TEST_EQUALITY(count(by_block, grid + "Uniform"), step);
    }
    TEST_EQUALITY(count(by_block, "<Time Value=\"0.10000000000000001\"/>"), 2);
    TEST_EQUALITY(count(by_block, "<Grid"), count(by_block, "</Grid>"));
    const auto named = named_and_missing(run.folder, "/fields.xdmf2");
    TEST_EQUALITY(named.first.size(), 12u * step);
    TEST_EQUALITY(named.second, 0);
    world()->barrier();
  }
}

TEUCHOS_UNIT_TEST(field_writer, killed_run_leaves_its_finished_steps) {
  Run run("killed");
  run.write(1);
  run.writer.finish_step();
  run.write(2);
  const std::string remains = run.folder + "/remains" + std::to_string(world()->getRank());
  std::filesystem::create_directory(remains);
  for (const char* name : {"/fields.h5", "/fields.xdmf", "/fields.xdmf2"}) {
    std::filesystem::copy_file(run.folder + name, remains + name);
  }
  world()->barrier();
  run.writer.finish_step();

  const auto named = named_and_missing(remains);
  TEST_EQUALITY(named.first.size(), 12u);
  TEST_EQUALITY(named.second, 0);
  TEST_EQUALITY(named_and_missing(remains, "/fields.xdmf2").first.size(), 12u);
  TEST_EQUALITY(read(remains, "/step_000001/fluid/pressure")[22], value(1, 22, 0));
}

TEUCHOS_UNIT_TEST(field_writer, full_disk_is_an_error_on_all_ranks_and_not_in_the_xdmf) {
  const std::string folder = RunFolder(scratch("full"), world()).path();
  const Grid fluid = chain("fluid", 4000, world()->getSize() - 1);
  FieldWriter writer(folder, {fluid}, world());
  writer.write(1, 0.1, "fluid", {point_array(fluid, "velocity", 3, 1)}, {});
  {
    const FullDisk full;
    TEST_THROW(writer.finish_step(), std::runtime_error);
  }
  TEST_EQUALITY(content(folder + "/fields.xdmf").find("step_000001"), std::string::npos);
  TEST_EQUALITY(read(folder, "/fluid/points").size(), 12000u);
}

/// Bytes that a dataset takes in the file.
hsize_t stored_bytes(const std::string& folder, const std::string& name) {
  const hid_t file = H5Fopen((folder + "/fields.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
  const hsize_t bytes = H5Dget_storage_size(dataset);
  H5Dclose(dataset);
  H5Fclose(file);
  return bytes;
}

// Several chunks, whose rows belong to more than one rank, and ranks without rows.
TEUCHOS_UNIT_TEST(field_writer, compressed_fields_are_smaller_and_the_same) {
  const std::string folder = RunFolder(scratch("compressed"), world()).path();
  const Grid fluid = chain("fluid", 50000, world()->getSize() - 1);
  FieldWriter writer(folder, {fluid}, world());
  for (const int step : {1, 2}) {
    if (step == 2) writer.compress(1);
    writer.write(step, 0.1 * step, "fluid", {point_array(fluid, "velocity", 3, 7)},
                 {cell_array(fluid, "shear", 7)});
    writer.finish_step();
  }
  world()->barrier();
  for (const char* name : {"velocity", "shear"}) {
    const std::string plain = "/step_000001/fluid/" + std::string(name),
                      small = "/step_000002/fluid/" + std::string(name);
    TEST_ASSERT(read(folder, plain) == read(folder, small));
    TEST_COMPARE(2 * stored_bytes(folder, small), <, stored_bytes(folder, plain));
  }
}

TEUCHOS_UNIT_TEST(field_writer, replaces_the_files_of_an_earlier_run) {
  Run run("earlier");
  run.write(7);
  run.writer.finish_step();
  world()->barrier();
  FieldWriter(run.folder, {run.fluid}, world());
  TEST_EQUALITY(content(run.folder + "/fields.xdmf").find("step_000007"), std::string::npos);
  const hid_t file = H5Fopen((run.folder + "/fields.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  TEST_EQUALITY(H5Lexists(file, "/step_000007", H5P_DEFAULT), 0);
  TEST_EQUALITY(H5Lexists(file, "/wall", H5P_DEFAULT), 0);
  H5Fclose(file);
}

/// The same mesh with the points numbered from the other side, and the tets in another order.
Grid turned(const Grid& grid) {
  Grid other;
  other.name = grid.name;
  other.points_global = grid.points_global;
  const int size = world()->getSize(), rank = world()->getRank();
  other.first_point = grid.points_global * rank / size;
  for (long long i = other.first_point; i < grid.points_global * (rank + 1) / size; ++i) {
    const long long point = grid.points_global - 1 - i;
    other.points.push_back(position(point));
    other.vertex.push_back(static_cast<int>(grid.points_global - point));
    if (point + 3 >= grid.points_global) continue;
    other.tets.push_back({i, i - 1, i - 2, i - 3});
    other.tet_number.push_back(static_cast<int>(point));
    other.region.push_back(static_cast<int>(point % 2));
    other.partition.push_back(rank);
  }
  return other;
}

TEUCHOS_UNIT_TEST(field_writer, goes_on_in_the_order_of_the_file) {
  Run run("go on");
  for (const int step : {1, 2, 3}) {
    run.write(step);
    run.writer.finish_step();
  }
  const Grid fluid = turned(run.fluid);
  FieldWriter writer(run.folder, {fluid, turned(run.wall)}, world(), 1);
  TEST_EQUALITY(writer.remark(), "");
  TEST_EQUALITY(named_and_missing(run.folder).first.size(), 12u);
  world()->barrier();
  Array speed{"velocity", 3, {}}, number{"number", 1, {}};
  for (const int vertex : fluid.vertex)
    for (int c = 0; c < 3; ++c) speed.values.push_back(value(2, 23 - vertex, c));
  for (const int tet : fluid.tet_number) number.values.push_back(value(2, tet, 0));
  writer.write(2, 0.2, "fluid", {speed}, {number});
  writer.finish_step();

  const auto named = named_and_missing(run.folder);
  TEST_EQUALITY(named.first.size(), 18u);
  TEST_EQUALITY(named.second, 0);
  const auto velocity = read(run.folder, "/step_000002/fluid/velocity");
  const auto numbers = read(run.folder, "/step_000002/fluid/number");
  TEST_EQUALITY(read(run.folder, "/fluid/points")[3], position(1)[0]);
  TEST_EQUALITY(read(run.folder, "/step_000001/fluid/velocity")[3], value(1, 1, 0));
  for (std::size_t i = 0; i < velocity.size(); ++i)
    TEST_EQUALITY(velocity[i], value(2, static_cast<long long>(i / 3), i % 3));
  for (std::size_t i = 0; i < numbers.size(); ++i)
    TEST_EQUALITY(numbers[i], value(2, static_cast<long long>(i), 0));
}

TEUCHOS_UNIT_TEST(field_writer, names_the_steps_of_a_killed_run_again) {
  Run whole("whole");
  for (const int step : {1, 2, 3}) {
    whole.write(step);
    whole.writer.finish_step();
  }
  Run killed("restarted");
  for (const int step : {1, 2}) {
    killed.write(step);
    killed.writer.finish_step();
  }
  world()->barrier();
  if (world()->getRank() == 0)
    for (const char* name : {"/fields.xdmf", "/fields.xdmf2"})
      std::filesystem::remove(killed.folder + name);
  killed.writer = FieldWriter(killed.folder, {killed.fluid, killed.wall}, world(), 2);
  TEST_EQUALITY(killed.writer.remark(), "");
  world()->barrier();
  TEST_EQUALITY(named_and_missing(killed.folder).first.size(), 24u);
  world()->barrier();
  killed.write(3);
  killed.writer.finish_step();
  world()->barrier();
  for (const char* name : {"/fields.xdmf", "/fields.xdmf2"})
    TEST_EQUALITY(content(killed.folder + name), content(whole.folder + name));
}

TEUCHOS_UNIT_TEST(field_writer, step_that_was_not_finished_is_not_named) {
  Run run("unfinished");
  for (const int step : {1, 2}) {
    run.write(step);
    run.writer.finish_step();
  }
  world()->barrier();
  if (world()->getRank() == 0) {
    const hid_t file = H5Fopen((run.folder + "/fields.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Adelete_by_name(file, "/step_000001", "time", H5P_DEFAULT);
    H5Ldelete(file, "/step_000001/wall", H5P_DEFAULT);
    H5Fclose(file);
  }
  world()->barrier();
  const FieldWriter writer(run.folder, {run.fluid, run.wall}, world(), 2);
  TEST_EQUALITY(writer.remark(), "");
  world()->barrier();
  const std::string text = content(run.folder + "/fields.xdmf");
  TEST_EQUALITY(count(text, "/step_000001/"), 0);
  TEST_EQUALITY(count(text, "/step_000002/"), 4);
}

TEUCHOS_UNIT_TEST(field_writer, sets_aside_what_it_cannot_continue) {
  Run run("aside");
  run.write(1);
  run.writer.finish_step();
  world()->barrier();
  if (world()->getRank() == 0) std::filesystem::resize_file(run.folder + "/fields.h5", 1000);
  world()->barrier();
  const FieldWriter writer(run.folder, {run.fluid, run.wall}, world(), 1);
  TEST_ASSERT(writer.remark().find("fields.h5 cannot be continued") == 0);
  TEST_EQUALITY(named_and_missing(run.folder).first.size(), 0u);
  TEST_ASSERT(std::filesystem::exists(run.folder + "/fields.old.h5"));
  for (const char* name : {"/fields.old.xdmf", "/fields.old.xdmf2"})
    TEST_ASSERT(content(run.folder + name).find("fields.old.h5:/") != std::string::npos);
}

TEUCHOS_UNIT_TEST(field_writer, array_that_fits_not_is_refused_on_all_ranks) {
  const auto refuses = [](const std::string& name, const std::vector<Array>& wrong) {
    Run run("refusal");
    run.writer.write(1, 0.1, name, wrong, {});
    try {
      run.writer.finish_step();
    } catch (const std::logic_error&) {
      return true;
    }
    return false;
  };
  const Grid fluid = chain("fluid", 23, world()->getSize() - 1);
  Array longer = point_array(fluid, "pressure", 1, 1);
  TEST_ASSERT(!refuses("fluid", {longer}));
  TEST_ASSERT(refuses("fluid", {longer, longer}));
  TEST_ASSERT(refuses("lumen", {longer}));
  if (world()->getRank() == 0) longer.values.push_back(0.0);
  TEST_ASSERT(refuses("fluid", {longer}));
  TEST_ASSERT(refuses("fluid", {Array{"pair", 2, std::vector<double>(2 * fluid.points.size())}}));
}

TEUCHOS_UNIT_TEST(field_writer, tet_with_an_unknown_point_is_refused_on_all_ranks) {
  const std::string folder = RunFolder(scratch("unknown"), world()).path();
  Grid wall = chain("wall", 11, 0);
  if (world()->getRank() == world()->getSize() - 1) wall.tets[0][2] = 11;
  TEST_THROW(FieldWriter(folder, {wall}, world()), std::logic_error);
}

TEUCHOS_UNIT_TEST(field_writer, folder_that_is_gone_is_an_error_on_all_ranks) {
  TEST_THROW(FieldWriter(scratch("gone"), {chain("wall", 11, 0)}, world()), std::runtime_error);
}

}  // namespace tunica::output::test
