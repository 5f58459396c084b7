#include <Teuchos_UnitTestHarness.hpp>
#include <fstream>

#include "tunica/params/read_xml.hpp"
#include "tunica/run/restart_changes.hpp"
#include "tunica/setup/schema.hpp"
#include "unit/io/scratch.hpp"

namespace {

using namespace tunica;

Teuchos::ParameterList shipped(const std::string& name) {
  return params::read_xml(std::string(TUNICA_TEST_DATA) + "/../../xml/" + name);
}

TEUCHOS_UNIT_TEST(restart_changes, are_free_where_they_do_not_change_what_is_solved) {
  for (const char* path :
       {"Time / steps", "Time / end time", "Output / averages from", "Output / checkpoint every",
        "Output / fields every", "Fluid / Newton / relative increment",
        "Wall / Linear Solver / MueLu / verbosity", "Coupling / tolerance",
        "Coupling / Added Mass Solver / tolerance", "Probes / tip / position",
        "Mesh / partitioner"})
    TEST_ASSERT(run::may_change_freely(path));
  for (const char* path : {"Time / step size", "Time / tolerance", "Fluid / viscosity",
                           "Fluid / Surfaces / Newton / pressure", "Wall / Layers / media / law",
                           "Wall / Newtonian", "Coupling / geometry", "Coupling / scheme",
                           "Mesh / scale", "Mesh Motion / stiffening", "Outputs"})
    TEST_ASSERT(!run::may_change_freely(path));
}

TEUCHOS_UNIT_TEST(restart_changes, are_found_in_a_case_that_defaults_have_completed) {
  Teuchos::ParameterList was = shipped("pulse-tiny.xml");
  output::CheckpointHead head;
  head.parameters = params::to_xml(was);
  Teuchos::ParameterList now = was;
  setup::fsi_table().resolve(now, "", std::string(TUNICA_TEST_DATA) + "/../../xml");
  TEST_ASSERT(run::changes_since(head, now, setup::fsi_table()).empty());
  now.sublist("Output").set("folder", "elsewhere");
  TEST_ASSERT(run::changes_since(head, now, setup::fsi_table()).empty());
  now.sublist("Fluid").set("stabilisation", "inertial");
  const run::Changes changes = run::changes_since(head, now, setup::fsi_table());
  TEST_EQUALITY(changes.size(), 1u);
  TEST_EQUALITY(params::text_of(changes.at(0)), "Fluid / stabilisation: tracked -> inertial");
}

TEUCHOS_UNIT_TEST(restart_changes, do_not_count_where_files_lie) {
  Teuchos::ParameterList now = shipped("benchmarks/obstacle.xml");
  setup::fsi_table().resolve(now, "", std::string(TUNICA_TEST_DATA) + "/../../xml/benchmarks");
  Teuchos::ParameterList was = now;
  const auto changes_from = [&](const std::string& file) {
    was.sublist("Fluid").sublist("Surfaces").sublist("inlet").set("file", file);
    output::CheckpointHead head;
    head.parameters = params::to_xml(was);
    return run::changes_since(head, now, setup::fsi_table()).size();
  };
  TEST_EQUALITY(changes_from("/elsewhere/obstacle-inlet.csv"), 0u);
  TEST_EQUALITY(changes_from("/elsewhere/another.csv"), 1u);
}

TEUCHOS_UNIT_TEST(restart_changes, count_what_files_hold) {
  Teuchos::ParameterList now = shipped("benchmarks/obstacle.xml");
  setup::fsi_table().resolve(now, "", std::string(TUNICA_TEST_DATA) + "/../../xml/benchmarks");
  Teuchos::ParameterList& inlet = now.sublist("Fluid").sublist("Surfaces").sublist("inlet");
  const int rank = output::test::world()->getRank();
  const std::string file = output::test::scratch("restart_changes") + std::to_string(rank) + ".csv";
  std::filesystem::create_directories(std::filesystem::path(file).parent_path());
  inlet.set("file", file);
  const auto write = [&](const std::string& text) { std::ofstream(file) << text; };
  write("0,0,0,1,0,0\n");
  output::CheckpointHead head;
  head.parameters = params::to_xml(now);
  head.files = run::hashes_of_files(now);
  TEST_EQUALITY(head.files.size(), 1u);  // without the mesh
  TEST_ASSERT(run::changes_since(head, now, setup::fsi_table()).empty());
  write("0,0,0,2,0,0\n");
  const run::Changes changes = run::changes_since(head, now, setup::fsi_table());
  TEST_EQUALITY(changes.size(), 1u);
  TEST_EQUALITY(changes.at(0).path, "Fluid / Surfaces / inlet / file");
  TEST_ASSERT(!run::may_change_freely(changes.at(0).path));
  head.files.clear();  // of an earlier version
  TEST_ASSERT(run::changes_since(head, now, setup::fsi_table()).empty());
}

TEUCHOS_UNIT_TEST(restart_changes, to_a_case_that_nobody_can_read_are_all_there_is) {
  output::CheckpointHead head;
  head.parameters = "<Parameter";
  Teuchos::ParameterList now("Case");
  now.sublist("Fluid").set("viscosity", 1.0);
  TEST_EQUALITY(run::changes_since(head, now, setup::fsi_table()).size(), 1u);
}

}  // namespace
