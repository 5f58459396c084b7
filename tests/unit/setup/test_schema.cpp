#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_Core.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/materials/viscosity_law.hpp"
#include "tunica/params/read_xml.hpp"
#include "tunica/setup/case.hpp"
#include "tunica/setup/schema.hpp"

namespace {

using namespace tunica;

const std::string xml_folder = std::string(TUNICA_TEST_DATA) + "/../../xml";

struct Named {
  std::string name;
  params::Table table;
};

std::vector<Named> schemas() {
  return {{"fsi", setup::fsi_table()},
          {"solid", setup::solid_table()},
          {"fluid", setup::fluid_table()},
          {"solvers", setup::solvers_table()},
          {"system", setup::system_solvers_table()}};
}

/// A case's lists decide which program solves it.
params::Table table_for(const Teuchos::ParameterList& list) {
  if (list.isSublist("System")) return setup::system_solvers_table();
  if (list.isSublist("Solvers")) return setup::solvers_table();
  if (!list.isSublist("Wall")) return setup::fluid_table();
  return list.isSublist("Fluid") ? setup::fsi_table() : setup::solid_table();
}

std::string refusal(const std::string& file, const std::vector<std::string>& set = {}) {
  setup::CommandLine command;
  command.case_file = file;
  command.set = set;
  try {
    setup::read_case(command, table_for(params::read_xml(file)), *Tpetra::getDefaultComm());
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEUCHOS_UNIT_TEST(schema, printed_defaults_lack_required_keys_and_nothing_else) {
  const int rank = Tpetra::getDefaultComm()->getRank();
  for (const Named& schema : schemas()) {
    const std::string file = "schema_" + schema.name + "_" + std::to_string(rank) + ".xml";
    {
      std::ofstream text(file);
      schema.table.print_xml(text, "Case");
    }
    Teuchos::ParameterList list = params::read_xml(file);
    std::remove(file.c_str());
    std::string complaints;
    try {
      schema.table.resolve(list, "", "");
    } catch (const Error& error) {
      complaints = error.what();
    }
    std::istringstream lines(complaints);
    int missing = 0;
    for (std::string line; std::getline(lines, line); ++missing) {
      const bool is_required_list = line.find("Wall / Layers: no layer.") == 0;
      TEST_ASSERT(is_required_list || line.find("\" is missing, expected ") != std::string::npos);
    }
    TEST_COMPARE(missing, >=, schema.name == "system" ? 1 : 3);  // mesh, step size, steps
  }
}

TEUCHOS_UNIT_TEST(schema, every_shipped_case_resolves) {
  int cases = 0;
  for (const auto& entry : std::filesystem::directory_iterator(xml_folder)) {
    if (entry.path().extension() != ".xml") continue;
    ++cases;
    const std::string message = refusal(entry.path().string());
    // Meshes that are made on demand need not be there.
    const bool lacks_mesh_only = message.find("Mesh: \"file\" is") != std::string::npos &&
                                 message.find('\n') == std::string::npos;
    out << entry.path().filename() << ": " << (message.empty() ? "fine" : message) << "\n";
    TEST_ASSERT(message.empty() || lacks_mesh_only);
  }
  TEST_COMPARE(cases, >=, 2);
}

TEUCHOS_UNIT_TEST(schema, a_resolved_case_resolves_to_itself) {
  for (const std::string name : {"pulse-tiny.xml", "reference-tube.xml"}) {
    setup::CommandLine command;
    command.case_file = xml_folder + "/" + name;
    auto list = setup::read_case(command, setup::fsi_table(), *Tpetra::getDefaultComm()).list;
    Teuchos::ParameterList again(list);
    setup::fsi_table().resolve(again, "", "");
    TEST_ASSERT(Teuchos::haveSameValues(list, again));
  }
}

TEUCHOS_UNIT_TEST(schema, unknown_keys_stop_at_every_depth_and_name_the_nearest) {
  const std::string file = xml_folder + "/pulse-tiny.xml";
  const std::pair<std::string, std::string> faults[] = {
      {"Tim/steps=1", "unknown key \"Tim\". Did you mean \"Time\"?"},
      {"Fluid/densty=1", "Fluid: unknown key \"densty\". Did you mean \"density\"?"},
      {"Wall/Newton/max iteratons=1", "Did you mean \"max iterations\"?"},
      {"Coupling/qwertz=1", "Valid: "}};
  for (const auto& [assignment, part] : faults) {
    const std::string message = refusal(file, {assignment});
    out << message << "\n";
    TEST_ASSERT(message.find(part) != std::string::npos);
  }
}

TEUCHOS_UNIT_TEST(schema, solver_settings_are_checked_like_a_case) {
  const std::string file = xml_folder + "/solvers-tiny.xml";
  const std::pair<std::string, std::string> faults[] = {
      {"Solvers/newtn step=1", "Solvers: unknown key \"newtn step\". Did you mean"},
      {"Solvers/Wall/direct/fil level=1", "Solvers / Wall / direct: unknown key \"fil level\""},
      {"Solvers/Fluid/direct/method=gmrs", "Solvers / Fluid / direct"},
      {"Solvers/step=17", "Solvers: \"step\" is 17, but Time / steps is 16."},
      {"Solvers/coupling iteration=101", "but Coupling / max iterations is 100."}};
  for (const auto& [assignment, part] : faults) {
    const std::string message = refusal(file, {assignment});
    out << message << "\n";
    TEST_ASSERT(message.find(part) != std::string::npos);
  }
}

TEUCHOS_UNIT_TEST(schema, probes_are_limited_to_the_fields_of_the_case) {
  Teuchos::ParameterList probe;
  probe.set("quantity", std::string("fluid pressure"));
  probe.set("position", Teuchos::Array<double>(3, 0.0));
  for (const Named& schema : schemas()) {
    Teuchos::ParameterList list;
    list.sublist("Probes").sublist("here") = probe;
    std::string complaints;
    try {
      schema.table.resolve(list, "", "");
    } catch (const Error& error) {
      complaints = error.what();
    }
    TEST_EQUALITY(complaints.find("Probes / here: \"quantity\"") != std::string::npos,
                  schema.name == "solid");
  }
}

TEUCHOS_UNIT_TEST(schema, all_or_no_surfaces_are_reported_or_those_named) {
  const std::string file = xml_folder + "/pulse-tiny.xml", key = "Output/surfaces=";
  for (const char* good : {"{all}", "{none}", "{}", "{inlet, outlet}"})
    TEST_EQUALITY(refusal(file, {key + good}), "");
  for (const char* bad : {"{all, inlet}", "{inlet, none}"})
    TEST_ASSERT(refusal(file, {key + bad}).find("Output: \"surfaces\" holds") != std::string::npos);
}

TEUCHOS_UNIT_TEST(read_case, all_ranks_receive_the_same_list) {
  setup::CommandLine command;
  command.case_file = xml_folder + "/pulse-tiny.xml";
  command.set = {"Fluid/density=1.06", "Wall/Layers/media/c10=4"};
  command.steps = 3;
  command.output = "elsewhere";
  const auto list = setup::read_case(command, setup::fsi_table(), *Tpetra::getDefaultComm()).list;
  TEST_EQUALITY(list.sublist("Fluid").get<double>("density"), 1.06);
  TEST_EQUALITY(list.sublist("Wall").sublist("Layers").sublist("media").get<double>("c10"), 4.0);
  TEST_EQUALITY(list.sublist("Time").get<int>("steps"), 3);
  TEST_EQUALITY(list.sublist("Output").get<std::string>("folder"), "elsewhere");
  TEST_EQUALITY(list.sublist("Coupling").get<std::string>("accelerator"), "iqn-ils");
  TEST_ASSERT(std::filesystem::path(list.sublist("Mesh").get<std::string>("file")).is_absolute());
}

TEUCHOS_UNIT_TEST(read_case, the_export_folder_of_the_command_line_wins) {
  setup::CommandLine command;
  command.case_file = xml_folder + "/solvers-tiny.xml";
  command.set = {"Solvers/export folder=here"};
  const Comm& comm = *Tpetra::getDefaultComm();
  const auto folder = [&] {
    const auto list = setup::read_case(command, setup::solvers_table(), comm).list;
    return list.sublist("Solvers").get<std::string>("export folder");
  };
  TEST_EQUALITY(folder(), "here");
  command.export_folder = "there";
  TEST_EQUALITY(folder(), "there");
}

TEUCHOS_UNIT_TEST(read_case, a_fault_of_the_file_is_thrown_on_all_ranks) {
  setup::CommandLine command;
  command.case_file = "there-is-no-such.xml";
  TEST_THROW(setup::read_case(command, setup::fsi_table(), *Tpetra::getDefaultComm()), Error);
}

TEUCHOS_UNIT_TEST(Case, knows_what_its_lists_say) {
  setup::CommandLine command{};
  command.program = "tunica-fsi";
  command.case_file = TUNICA_MESHES "/../xml/pulse-tiny.xml";
  command.set = {"Wall/Prestress/pressure=10.67", "Fluid/viscosity=0.004"};
  const setup::Case the_case =
      setup::read_case(command, setup::fsi_table(), *Tpetra::getDefaultComm());
  TEST_ASSERT(the_case.is_coupled());
  TEST_EQUALITY(the_case.fluid->options.viscosity->reference(), 0.004);
  TEST_EQUALITY(the_case.wall->prestress.pressure, 10.67);
  TEST_EQUALITY(the_case.wall->prestress.surfaces.size(), 1);
  TEST_EQUALITY(the_case.wall->prestress.surfaces.at(0), "interface");
  TEST_EQUALITY(the_case.fluid->options.conditions.size(),
                the_case.list.sublist("Fluid").sublist("Surfaces").numParams());
  TEST_EQUALITY(the_case.time->steps.first_step,
                the_case.list.sublist("Time").get<double>("step size"));
}

}  // namespace
