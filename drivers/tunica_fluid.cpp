// Solves a fluid alone in a rigid domain.
//
//   tunica-fluid xml/poiseuille.xml --output results/poiseuille

#include "tunica/app/checkpoints.hpp"
#include "tunica/app/field_output.hpp"
#include "tunica/app/run.hpp"
#include "tunica/app/run_log.hpp"
#include "tunica/app/sanity/watch.hpp"
#include "tunica/app/schema.hpp"
#include "tunica/app/surface_report.hpp"
#include "tunica/app/wall_shear.hpp"

namespace {

using namespace tunica;

Outcome march(const Teuchos::ParameterList& list, const app::Domain& domain,
              app::RunOutput& output) {
  // 1. The fluid, from where it goes on after a restart, and what is written of it.
  problems::FluidProblem fluid(app::fluid_list(list), *domain.fluid);
  fluid.linear_solver();  // wrong names in its lists are told before anything is solved
  app::WallShear shear(list, fluid);
  app::TimeMarch march(list, {{"fluid", &fluid}, {"wall shear", &shear}}, output);
  march.judge(fluid);
  const app::SurfaceReport surfaces(list.sublist("Output"), &*domain.fluid, nullptr);
  const CommPtr comm = domain.fluid->comm;
  app::tell_unknowns(output.record, "fluid", *fluid.space());
  app::Checkpoints checkpoints(output, march, app::wall_limit(list), comm);
  checkpoints.begin();
  app::RunLog log(output, comm->getRank() == 0, {"fluid"}, {});
  app::Watch watch(list);
  app::FieldSeries fields(output, {app::grid_of(*domain.fluid, "fluid")}, comm);

  // 2. March; to a steady flow in pseudo-time.
  fluid.watch_newton([&](const nonlinear::NewtonStep& step) { log.newton("fluid", step); });
  const auto solve = [&](const stepping::Clock& clock, int attempt) {
    log.begin({clock.step(), clock.time(), 0, attempt});
    fluid.begin_step(clock);
    const nonlinear::NewtonReport report = fluid.solve();
    if (report.is_converged) fluid.end_step();
    return app::summary_of(report, "fluid", clock);
  };
  const auto make_step = [&] {
    app::StepSummary step = march.make_step(solve, log);
    const stepping::Clock& clock = march.clock();
    if (step.is_accepted) shear.accept(clock);
    const discretisation::Observables observed =
        app::joined({fluid.observe(), shear.observe(), domain.probes.observe(&fluid, nullptr),
                     surfaces.observe(&fluid, nullptr)});
    log.step(clock, step, observed);
    watch.tell(log, clock, step, observed);
    return step;
  };
  const Outcome marched = checkpoints.march(make_step, [&] {
    if (!fields.is_due(march.clock())) return;
    std::vector<output::Array> arrays = app::fluid_arrays(fluid, {});
    for (output::Array& array : shear.arrays()) arrays.push_back(std::move(array));
    fields.write(march.clock(), {{"fluid", arrays, {}}});
  });
  if (marched.is_failure()) return marched;
  fields.finish();
  app::record_assembly(output.record, "fluid", fluid.jacobian_throughput(), *comm);
  return march.outcome();
}

}  // namespace

int main(int argc, char** argv) {
  return tunica::app::run_program(
      argc, argv,
      {"tunica-fluid", "Solves a fluid alone in a rigid domain.", tunica::app::fluid_table()},
      march);
}
