#include <Teuchos_UnitTestHarness.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "tunica/output/run_folder.hpp"
#include "tunica/output/run_record.hpp"
#include "unit/io/scratch.hpp"

namespace tunica::output::test {

namespace {

nlohmann::json parse(const std::string& path) { return nlohmann::json::parse(content(path)); }

std::string record_file(const std::string& folder) {
  return RunFolder(scratch(folder), world()).file("run.json");
}

}  // namespace

TEUCHOS_UNIT_TEST(run_record, tells_what_the_run_was) {
  const std::string path = record_file("record");
  RunRecord record(path, "tunica-fsi", "0.1.0", world());
  record.set("sizes", "fluid points", 12345LL);
  record.set("sizes", "fluid points", 54321LL);
  record.set("case", "name", "a \"tube\"\n");
  record.set("case", "dynamic", true);
  record.set("case", "undefined", std::numeric_limits<double>::quiet_NaN());
  record.add_time("assembly", 1.5);
  record.add_time("assembly", 0.5);
  record.save();

  const auto json = parse(path);
  TEST_EQUALITY(json["program"].get<std::string>(), "tunica-fsi");
  TEST_EQUALITY(json["status"].get<std::string>(), "running");
  TEST_ASSERT(json["ended"].is_null());
  TEST_EQUALITY(json["ranks"].get<int>(), world()->getSize());
  TEST_EQUALITY(json["sizes"]["fluid points"].get<long long>(), 54321LL);
  TEST_EQUALITY(json["case"]["name"].get<std::string>(), "a \"tube\"\n");
  TEST_ASSERT(json["case"]["dynamic"].get<bool>());
  TEST_ASSERT(json["case"]["undefined"].is_null());
  TEST_EQUALITY(json["timings"]["assembly"].get<double>(), 2.0);
  for (const char* name : {"tunica", "Trilinos", "MPI", "HDF5", "compiler"}) {
    TEST_ASSERT(!json["versions"][name].get<std::string>().empty());
  }
  world()->barrier();  // nobody replaces the file while another reads
  record.finish(RunStatus::done);
}

TEUCHOS_UNIT_TEST(run_record, tells_how_the_run_ended) {
  const std::string path = record_file("ended");
  RunRecord record(path, "tunica-fsi", "0.1.0", world());
  record.save();
  record.note_memory("early");
  record.finish(RunStatus::not_converged, "step 3: 40 coupling iterations");

  const auto json = parse(path);
  const std::vector<double> early = json["memory by phase [MB]"]["early"];
  TEST_EQUALITY(early.size(), static_cast<std::size_t>(world()->getSize()));
  for (const double peak : early)
    TEST_COMPARE(peak, <=, json["memory"]["peak of one rank [MB]"].get<double>());
  TEST_EQUALITY(json["status"].get<std::string>(), "not converged");
  TEST_EQUALITY(json["message"].get<std::string>(), "step 3: 40 coupling iterations");
  TEST_ASSERT(json["ended"].get<std::string>() >= json["started"].get<std::string>());
  const double one = json["memory"]["peak of one rank [MB]"];
  const double all = json["memory"]["peak of all ranks [MB]"];
  TEST_COMPARE(one, >, 1.0);
  TEST_COMPARE(all, >=, one);
  TEST_COMPARE(all, <=, one * world()->getSize() * (1.0 + 1e-12));
  TEST_ASSERT(!std::filesystem::exists(path + ".tmp"));
}

TEUCHOS_UNIT_TEST(run_record, remembers_when_the_run_began_and_its_legs) {
  const std::string path = record_file("legs");
  if (world()->getRank() == 0)
    std::ofstream(path) << R"({"started": "2001-02-03T04:05:06Z", "history": [
      {"after step": 0, "at": "early", "ranks": 3, "parameters": "case.xml"}, "damaged", {}]})";
  world()->barrier();
  RunRecord record(path, "tunica-fsi", "0.1.0", world());
  record.take_over(read_history(path));
  world()->barrier();
  record.begin_leg({7, "", 0, "case-2.xml", {{"Fluid / viscosity", "0.0035", "0.004"}}});
  record.finish(RunStatus::done);
  const auto json = parse(path);
  TEST_EQUALITY(json["started"].get<std::string>(), "2001-02-03T04:05:06Z");
  const std::vector<Leg> history = read_history(path);
  TEST_EQUALITY(history.size(), 2u);
  TEST_EQUALITY(history.at(0).at, "early");
  TEST_EQUALITY(history.at(0).ranks, 3);
  TEST_EQUALITY(history.at(1).after_step, 7);
  TEST_EQUALITY(history.at(1).ranks, world()->getSize());
  TEST_EQUALITY(history.at(1).parameters, "case-2.xml");
  TEST_EQUALITY(history.at(1).changes.at(0).key, "Fluid / viscosity");
  TEST_EQUALITY(history.at(1).changes.at(0).now, "0.004");
}

TEUCHOS_UNIT_TEST(run_record, knows_which_leg_has_made_a_checkpoint) {
  // After step 8 it went on as B, which came to nothing; then as C from the checkpoint before.
  const std::vector<Leg> history{{0, "", 1, "A"}, {8, "", 1, "B"}, {7, "", 1, "C"}};
  TEST_EQUALITY(leg_of_step(history, 7).parameters, "A");
  TEST_EQUALITY(leg_of_step(history, 8).parameters, "C");
  TEST_EQUALITY(leg_of_step(history, 9).parameters, "C");
  TEST_ASSERT(read_history("/nowhere/run.json").empty());
}

TEUCHOS_UNIT_TEST(run_record, that_nobody_finished_says_failed) {
  const std::string path = record_file("abandoned");
  RunRecord(path, "tunica-fsi", "0.1.0", world()).save();
  world()->barrier();
  TEST_EQUALITY(parse(path)["status"].get<std::string>(), "failed");
}

TEUCHOS_UNIT_TEST(run_record, refuses_a_section_with_the_name_of_a_fixed_entry) {
  RunRecord record(record_file("names"), "tunica-fsi", "0.1.0", world());
  TEST_THROW(record.set("status", "key", 1), std::logic_error);
  record.finish(RunStatus::done);
}

TEUCHOS_UNIT_TEST(run_record, unwritable_file_is_an_error_on_all_ranks) {
  RunRecord record("/proc/run.json", "tunica-fsi", "0.1.0", world());
  TEST_THROW(record.save(), std::runtime_error);
  TEST_THROW(record.finish(RunStatus::done), std::runtime_error);
}

}  // namespace tunica::output::test
