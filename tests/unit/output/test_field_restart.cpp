#include <Teuchos_UnitTestHarness.hpp>

#include "unit/output/field_run.hpp"

namespace tunica::output::test {

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

}  // namespace tunica::output::test
