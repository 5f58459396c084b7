#include "tunica/setup/case.hpp"

#include <Teuchos_XMLParameterListHelpers.hpp>
#include <filesystem>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/io/messages.hpp"
#include "tunica/params/read_xml.hpp"
#include "tunica/setup/initial_state.hpp"
#include "tunica/setup/one_field.hpp"
#include "tunica/stepping/time_function.hpp"

namespace tunica::setup {

namespace {

/// What another case says of settings to compare, for whatever systems.
Teuchos::ParameterList settings_in(const std::string& file) {
  const Teuchos::ParameterList all = params::read_xml(file);
  Teuchos::ParameterList solvers("Solvers");
  TUNICA_CHECK(all.isSublist("Solvers"), file + ": a list \"Solvers\" is missing");
  const Teuchos::ParameterList& from = all.sublist("Solvers");
  if (from.isParameter("tolerance")) solvers.setEntry("tolerance", from.getEntry("tolerance"));
  for (const char* name : {"Settings", "System", "Fluid", "Wall"})
    if (from.isSublist(name) && !solvers.isSublist("Settings"))
      solvers.sublist("Settings") = from.sublist(name);
  TUNICA_CHECK(solvers.isSublist("Settings"), file + ": Solvers: there are no settings");
  return solvers;
}

/// The case of a matrix: a list "System" that names it, and settings that are to be compared.
Teuchos::ParameterList case_of_matrix(const CommandLine& command) {
  Teuchos::ParameterList list("Case");
  if (!command.settings.empty()) list.sublist("Solvers") = settings_in(command.settings);
  const auto set = [&](const char* key, const std::string& file) {
    if (!file.empty())
      list.sublist("System").set(key, std::filesystem::absolute(file).lexically_normal().string());
  };
  set("K", command.case_file);
  set("rhs", command.right_side);
  return list;
}

Teuchos::ParameterList read_on_root(const CommandLine& command, const params::Table& table) {
  Teuchos::ParameterList list = is_matrix_file(command.case_file)
                                    ? case_of_matrix(command)
                                    : params::read_xml(command.case_file);
  const std::string remark = leave_one_field(list, command.program);
  if (!remark.empty()) io::print_line("note: " + remark);
  for (const std::string& assignment : command.set) params::set_from_text(list, table, assignment);
  const std::string& file = command.settings.empty() ? command.case_file : command.settings;
  const std::filesystem::path folder =
      std::filesystem::absolute(file).lexically_normal().parent_path();
  try {
    table.resolve(list, "", folder.string());
    stepping::inline_files(list);
    if (list.isSublist("Time")) {
      place_initial_state(list.sublist("Time"), folder.string());
      const std::string pressures = take_outlet_pressures(list);
      if (!pressures.empty()) io::print_line("note: " + pressures);
    }
  } catch (const Error& error) {
    throw Error(file + ": " + error.what());
  }
  TUNICA_CHECK(!command.steps || list.isSublist("Time"), "--steps: this case has no time steps.");
  TUNICA_CHECK(
      command.export_folder.empty() || list.sublist("Solvers").isParameter("export folder"),
      "--export: this case has no systems to export.");
  if (command.steps) list.sublist("Time").set("steps", *command.steps);
  if (!command.output.empty()) list.sublist("Output").set("folder", command.output);
  if (!command.export_folder.empty())
    list.sublist("Solvers").set("export folder", command.export_folder);
  return list;
}

}  // namespace

Case::Case(const Teuchos::ParameterList& resolved)
    : list(resolved), output(list.sublist("Output")) {
  const auto decode = [this](const char* name, auto& settings) {
    if (list.isSublist(name)) settings.emplace(list.sublist(name));
  };
  decode("Mesh", mesh);
  decode("Time", time);
  decode("Fluid", fluid);
  decode("Wall", wall);
  decode("Mesh Motion", motion);
  decode("Coupling", coupling);
  if (time && time->hits_kinks) kinks = stepping::kinks(list, time->steps.end);
  // On the way to a steady flow Newton's method stops earlier, and begins where the last step
  // ended.
  if (!time || !time->newton_increment) return;
  if (fluid) fluid->solves.newton.relative_increment = *time->newton_increment;
  if (!coupling) return;
  coupling->list.set("predictor order", 0);
  coupling->list.sublist("Newton").set("relative increment", *time->newton_increment);
}

Case read_case(const CommandLine& command, const params::Table& table, const Comm& comm) {
  Teuchos::ParameterList list;
  std::string text;
  on_root(comm, [&] {
    list = read_on_root(command, table);
    text = params::to_xml(list);
  });
  broadcast(comm, text);
  if (comm.getRank() != 0) list = *Teuchos::getParametersFromXmlString(text);
  return list;
}

bool has_list(const std::string& file, const std::string& name, const Comm& comm) {
  std::string found;
  on_root(comm, [&] {
    if (is_matrix_file(file) ? name == "System" : params::read_xml(file).isSublist(name))
      found = name;
  });
  broadcast(comm, found);
  return !found.empty();
}

}  // namespace tunica::setup
