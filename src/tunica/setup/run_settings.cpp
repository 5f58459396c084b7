#include "tunica/setup/run_settings.hpp"

#include <Teuchos_Array.hpp>

#include "tunica/mesh/distributed/partition_slab.hpp"
#include "tunica/observe/budget.hpp"
#include "tunica/observe/surface_report.hpp"
#include "tunica/observe/wall_field.hpp"
#include "tunica/observe/wall_shear.hpp"
#include "tunica/setup/initial_state.hpp"
#include "tunica/stepping/wall_limit.hpp"

namespace tunica::setup {

MeshSettings::MeshSettings(const Teuchos::ParameterList& list)
    : file(list.get<std::string>("file")), scale(list.get<double>("scale")),
      partitioner(list.get<std::string>("partitioner")) {}

TimeSettings::TimeSettings(const Teuchos::ParameterList& list)
    : step_control(list.get<std::string>("step control")),
      steps(stepping::step_control_options(list)),
      hits_kinks(steps.is_adaptive && list.get<bool>("hit kinks")),
      wall_limit(stepping::seconds_of(list.get<std::string>("wall limit"))) {
  if (step_control != "fixed") tolerance = problems::step_tolerance(list);
  from = initial_state(list);
  if (is_steady_sought()) newton_increment = list.get<double>("newton increment");
}

params::Table time_table() {
  params::Table table = stepping::time_table();
  add_initial_state_key(table);
  return table;
}

OutputSettings::OutputSettings(const Teuchos::ParameterList& list)
    : folder(list.get<std::string>("folder")) {
  // A key that the program does not have leaves what nothing asks for.
  const auto take = [&list](const char* key, auto& value) {
    if (list.isParameter(key)) value = list.get<std::decay_t<decltype(value)>>(key);
  };
  take("fields every", fields_every);
  take("checkpoint every", checkpoint_every);
  take("fields interval", fields_interval);
  take("compression", compression);
  take("progress every", progress_every);
  if (list.isParameter("fields at"))
    fields_at = list.get<Teuchos::Array<double>>("fields at").toVector();
  surfaces = observe::surfaces_in(list);
  wall_arrays = observe::wall_arrays_in(list);
  averages_from = observe::averages_from(list);
}

std::vector<double> OutputSettings::times_of_fields(double end) const {
  std::vector<double> times(fields_at);
  if (fields_interval > 0.0)
    for (int k = 1; k * fields_interval < end; ++k) times.push_back(k * fields_interval);
  return times;
}

params::Table mesh_table() {
  params::Table table("The mesh of fluid and wall.");
  table
      .file("file", std::nullopt,
            "Gmsh 2.2 or 4.1, Netgen .vol, or our HDF5; lengths in mm, or see scale")
      .number("scale", 1.0, params::positive(), "",
              "the vertices are multiplied by it; 1000 for a mesh in m, 10 for one in cm")
      .choice(
          "partitioner", "automatic", mesh::partitioner_names(),
          "partitioner of the mesh: metis, for which the whole mesh must fit on rank 0; geometric, "
          "by planes, which needs no whole mesh; automatic, metis up to 100,000 tetrahedra");
  return table;
}

params::Table output_table(bool has_fluid, bool has_wall) {
  params::Table table("What a run leaves behind.");
  table.text("folder", "results", "folder of the results; --output overrides it")
      .integer("fields every", 1, params::non_negative(),
               "write the fields after every so many steps; 0 never")
      .numbers("fields at", std::vector<double>{}, params::positive(), 0, "ms",
               "times at which the fields are written, too; a step ends there")
      .number("fields interval", 0.0, params::non_negative(), "ms",
              "the same at every multiple of this time; 0 never")
      .integer("compression", 0, params::between(0, 9),
               "of the fields in fields.h5, without loss: 1 fast to 9 small; 0 none")
      .integer("checkpoint every", 1, params::non_negative(),
               "write a checkpoint for --restart after every so many steps; 0 never")
      .number("progress every", 5.0, params::non_negative(), "s",
              "interval of progress lines on the screen within a long step: its Newton step, "
              "iteration and residual; 0: each iteration");
  observe::add_budget_keys(table);
  observe::add_surface_keys(table);
  if (has_wall) observe::add_wall_array_keys(table);
  if (has_fluid) observe::add_wall_shear_keys(table);
  if (has_fluid) observe::add_force_group_keys(table);
  return table;
}

}  // namespace tunica::setup
