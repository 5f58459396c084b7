#include <Teuchos_UnitTestHarness.hpp>

#include "unit/io/full_disk.hpp"
#include "unit/output/field_run.hpp"

namespace tunica::output::test {

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
