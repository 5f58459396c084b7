#include "tunica/setup/schema.hpp"

#include "tunica/base/error.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/told_apart.hpp"
#include "tunica/compare/solver_table.hpp"
#include "tunica/compare/system_capture.hpp"
#include "tunica/compare/system_export.hpp"
#include "tunica/coupling/registry.hpp"
#include "tunica/foreign/default_settings.hpp"
#include "tunica/observe/field_kinds.hpp"
#include "tunica/observe/probes.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/mesh_motion.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "tunica/setup/run_settings.hpp"
#include "tunica/stepping/step_control.hpp"
#include "tunica/systems/read_system.hpp"

namespace tunica::setup {

namespace {

/// The wanted step and iteration must come to pass.
void check_wish(const Teuchos::ParameterList& list, const std::string&) {
  const auto check = [&](const char* key, const std::string& where, const char* limit) {
    const int wanted = list.sublist("Solvers").get<int>(key);
    const int most = list.sublist(where).get<int>(limit);
    TUNICA_CHECK(wanted <= most || most == 0,
                 std::string("Solvers: \"") + key + "\" is " + std::to_string(wanted) + ", but " +
                     where + " / " + limit + " is " + std::to_string(most) + ".");
  };
  check("step", "Time", "steps");
  if (!coupling::CouplingSettings(list.sublist("Coupling")).is_monolithic)
    check("coupling iteration", "Coupling", "max iterations");
}

/// On the interface the displacement of a step is its size times the velocity, so that it is
/// finite. Pseudo-time has no instants at which fields could be wanted.
void check_steady(const Teuchos::ParameterList& list, const std::string&) {
  if (!TimeSettings(list.sublist("Time")).is_steady_sought()) return;
  if (list.isSublist("Wall")) {
    TUNICA_CHECK(list.isSublist("Fluid"),
                 "Time: \"step control\" = \"steady\" is for a fluid, alone or with a wall. A wall "
                 "alone with \"analysis\" = \"static\" is in equilibrium in each step.");
    TUNICA_CHECK(
        list.sublist("Time").get<double>("largest step") > 0.0,
        "Time: \"step control\" = \"steady\" with a wall needs a \"largest step\", long "
        "compared with the time in which fluid and wall settle; beyond it steps do not grow.");
    TUNICA_CHECK(coupling::CouplingSettings(list.sublist("Coupling")).is_monolithic,
                 "Time: \"step control\" = \"steady\" with a wall needs \"Coupling / scheme\" = "
                 "\"monolithic\".");
  }
  TUNICA_CHECK(!OutputSettings(list.sublist("Output")).wants_fields_at_times(),
               "Output: \"fields at\" and \"fields interval\" have no meaning for a steady flow; "
               "the last step is always written.");
}

/// Times at which fields are wanted are kept in memory.
void check_interval(const Teuchos::ParameterList& list, const std::string&) {
  constexpr double most = 1e6;
  const double interval = OutputSettings(list.sublist("Output")).fields_interval;
  const double end = TimeSettings(list.sublist("Time")).steps.end;
  const auto [found, least] = told_apart(interval, end / most);
  TUNICA_CHECK(interval == 0.0 || interval * most >= end,
               "Output: \"fields interval\" is " + found + formatted(" ms in a run of %g", end) +
                   " ms, expected at least " + least + " ms.");
}

/// Keys that every case has.
params::Table common_table(const std::string& sentence, bool has_fluid, bool has_wall) {
  params::Table table(sentence);
  table.sublist("Mesh", mesh_table())
      .sublist("Time", time_table())
      .sublist("Output", output_table(has_fluid, has_wall))
      .entries("Probes", observe::probe_table(has_fluid, has_wall),
               "points whose values become columns of steps.csv")
      .check(check_steady)
      .check(check_interval);
  observe::add_field_entries(has_fluid, has_wall, table);
  return table;
}

}  // namespace

params::Table fsi_table() {
  params::Table table = common_table("A fluid-structure interaction problem.", true, true);
  table.sublist("Fluid", problems::fluid_table())
      .sublist("Wall", problems::solid_table())
      .sublist("Mesh Motion", problems::mesh_motion_table())
      .sublist("Coupling", coupling::coupling_table());
  return table;
}

params::Table solid_table() {
  params::Table table = common_table("A wall alone.", false, true);
  table.sublist("Wall", problems::solid_table());
  return table;
}

params::Table fluid_table() {
  params::Table table = common_table("A fluid alone, in a rigid domain.", true, false);
  table.sublist("Fluid", problems::fluid_table());
  return table;
}

params::Table solvers_table() {
  params::Table solvers(
      "Settings that tunica-solvers compares, and the linear systems on which it does.");
  compare::add_capture_keys(solvers);
  compare::add_setting_keys(solvers);
  compare::add_export_keys(solvers);
  params::Table table = fsi_table();
  table.sublist("Solvers", solvers).check(check_wish);
  return table;
}

params::Table system_solvers_table() {
  params::Table solvers("Settings that tunica-solvers compares.");
  foreign::add_settings_keys(solvers);
  params::Table output("What a run leaves behind.");
  output.text("folder", "results", "folder of the results; --output overrides it");
  params::Table table(
      "A linear system of another program, which tunica-solvers reads in place of a case.");
  table.sublist("System", systems::system_table())
      .sublist("Solvers", solvers)
      .sublist("Output", output);
  return table;
}

}  // namespace tunica::setup
