// Solves a wall alone, static or dynamic.
//
//   tunica-solid xml/inflation.xml --output results/inflation

#include "tunica/app/checkpoints.hpp"
#include "tunica/app/field_output.hpp"
#include "tunica/app/prestress.hpp"
#include "tunica/app/run.hpp"
#include "tunica/app/run_log.hpp"
#include "tunica/app/sanity/watch.hpp"
#include "tunica/app/schema.hpp"
#include "tunica/app/surface_report.hpp"

namespace {

using namespace tunica;

Outcome march(const Teuchos::ParameterList& list, const app::Domain& domain,
              app::RunOutput& output) {
  // 1. The wall, from where it goes on after a restart, and what is written of it.
  problems::SolidProblem wall(list.sublist("Wall"), *domain.wall);
  wall.linear_solver();  // wrong names in its lists are told before anything is solved
  const Outcome stressed = app::take_prestress(list.sublist("Wall"), output, wall);
  if (stressed.is_failure() || !output.stopped.empty()) return stressed;
  app::TimeMarch march(list, {{"wall", &wall}}, output);
  march.judge(wall);
  const app::SurfaceReport surfaces(list.sublist("Output"), nullptr, &*domain.wall);
  const CommPtr comm = domain.wall->comm;
  app::tell_unknowns(output.record, "wall", *wall.space());
  app::Checkpoints checkpoints(output, march, app::wall_limit(list), comm);
  checkpoints.begin();
  app::RunLog log(output, comm->getRank() == 0, {"wall"}, {});
  app::Watch watch(list);
  const app::WallOutput of_wall(wall, list.sublist("Output"));
  app::FieldSeries fields(output, {of_wall.grid()}, comm);

  // 2. March; in statics each step is an equilibrium.
  wall.watch_newton([&](const nonlinear::NewtonStep& step) { log.newton("wall", step); });
  const auto solve = [&](const stepping::Clock& clock, int attempt) {
    log.begin({clock.step(), clock.time(), 0, attempt});
    wall.begin_step(clock);
    const nonlinear::NewtonReport report = wall.solve();
    if (report.is_converged) wall.end_step();
    return app::summary_of(report, "wall", clock);
  };
  const auto make_step = [&] {
    app::StepSummary step = march.make_step(solve, log);
    const stepping::Clock& clock = march.clock();
    const discretisation::Observables observed = app::joined(
        {wall.observe(), domain.probes.observe(nullptr, &wall), surfaces.observe(nullptr, &wall)});
    log.step(clock, step, observed);
    watch.tell(log, clock, step, observed, nullptr, {}, [&] { return app::layer_volumes(wall); });
    return step;
  };
  const Outcome marched = checkpoints.march(make_step, [&] {
    if (fields.is_due(march.clock())) fields.write(march.clock(), {of_wall.fields()});
  });
  if (marched.is_failure()) return marched;
  fields.finish();
  app::record_assembly(output.record, "wall", wall.jacobian_throughput(), *comm);
  return Outcome::success();
}

}  // namespace

int main(int argc, char** argv) {
  return tunica::app::run_program(
      argc, argv, {"tunica-solid", "Solves a wall alone.", tunica::app::solid_table()}, march);
}
