// Solves a wall alone, static or dynamic.
//
//   tunica-solid xml/inflation.xml --output results/inflation

#include "tunica/app/checkpoints.hpp"
#include "tunica/app/field_output.hpp"
#include "tunica/app/run.hpp"
#include "tunica/app/run_log.hpp"
#include "tunica/app/schema.hpp"
#include "tunica/app/surface_report.hpp"

namespace {

using namespace tunica;

Outcome march(const Teuchos::ParameterList& list, const app::Domain& domain,
              app::RunOutput& output) {
  // 1. The wall, from where it goes on after a restart, and what is written of it.
  problems::SolidProblem wall(list.sublist("Wall"), *domain.wall);
  stepping::Clock clock(list.sublist("Time"));
  const app::SurfaceReport surfaces(list.sublist("Output"), nullptr, &*domain.wall);
  const CommPtr comm = domain.wall->comm;
  const app::Checkpoints checkpoints(output, {{"wall", &wall}}, comm);
  checkpoints.begin(clock);
  app::RunLog log(output, comm->getRank() == 0, clock.steps(), {"wall"}, {});
  app::FieldSeries fields(output, {app::grid_of(*domain.wall, "wall")}, comm);

  // 2. March; in statics each step is an equilibrium.
  for (; !clock.is_done(); clock.advance()) {
    wall.begin_step(clock);
    const nonlinear::NewtonReport report = wall.solve();
    if (report.is_converged) wall.end_step();
    log.newton({clock.step(), clock.time(), 0}, "wall", report);
    log.step({clock.step(), clock.time(), 0}, app::summary_of(report, "wall"),
             app::joined({wall.observe(), domain.probes.observe(nullptr, &wall),
                          surfaces.observe(nullptr, &wall)}));
    if (!report.is_converged) return app::failure(clock, "the wall", report);
    if (fields.is_due(clock))
      fields.write(clock, {{"wall", app::wall_arrays(wall), app::wall_cell_arrays(wall)}});
    checkpoints.write_if_due(clock);
  }
  app::record_assembly(output.record, "wall", wall.jacobian_throughput(), *comm);
  return Outcome::success();
}

}  // namespace

int main(int argc, char** argv) {
  return tunica::app::run_program(
      argc, argv, {"tunica-solid", "Solves a wall alone.", tunica::app::solid_table()}, march);
}
