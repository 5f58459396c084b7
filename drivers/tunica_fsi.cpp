// Marches a fluid-structure interaction problem in time.
//
//   tunica-fsi xml/pulse.xml --output results/pulse
//   mpirun -n 2 tunica-fsi xml/pulse-tiny.xml --steps 2 --set "Coupling/accelerator=aitken"

#include "tunica/app/checkpoints.hpp"
#include "tunica/app/field_output.hpp"
#include "tunica/app/prestress.hpp"
#include "tunica/app/run.hpp"
#include "tunica/app/run_log.hpp"
#include "tunica/app/sanity/watch.hpp"
#include "tunica/app/schema.hpp"
#include "tunica/app/surface_report.hpp"
#include "tunica/app/wall_shear.hpp"
#include "tunica/coupling/registry.hpp"

namespace {

using namespace tunica;

std::vector<app::GridFields> both_fields(const problems::FluidProblem& fluid,
                                         const problems::MeshMotion& motion,
                                         const app::WallShear& shear,
                                         const app::WallOutput& of_wall) {
  std::vector<output::Array> of_fluid = app::fluid_arrays(fluid, motion.displacement());
  for (output::Array& array : shear.arrays()) of_fluid.push_back(std::move(array));
  std::vector<app::GridFields> both;  // not copied from a list of them: they are long
  both.push_back({"fluid", std::move(of_fluid), {}});
  both.push_back(of_wall.fields());
  return both;
}

Outcome march(const Teuchos::ParameterList& list, const app::Domain& domain,
              app::RunOutput& output) {
  // 1. Three fields, each with its kernels, blocks and solver.
  problems::FluidProblem fluid(list.sublist("Fluid"), *domain.fluid);
  problems::SolidProblem wall(list.sublist("Wall"), *domain.wall);
  const Outcome stressed = app::take_prestress(list.sublist("Wall"), output, wall, &fluid);
  if (stressed.is_failure() || !output.stopped.empty()) return stressed;
  problems::MeshMotion motion(list.sublist("Mesh Motion"), *domain.fluid, domain.interface_surfaces,
                              fluid.staying_surfaces(), fluid.time_scheme());

  // 2. Couple them.
  const std::unique_ptr<coupling::Scheme> scheme = coupling::make_scheme(
      list.sublist("Coupling"),
      {*domain.interface, fluid, wall, motion, domain.common ? &*domain.common : nullptr});

  // 3. From where it goes on after a restart; what is written, and when.
  const CommPtr comm = domain.fluid->comm;
  for (const auto& [name, system] : scheme->systems())
    app::tell_unknowns(output.record, name, *system->last_jacobian().space());
  app::WallShear shear(list, fluid);
  app::TimeMarch march(list,
                       {{"fluid", &fluid},
                        {"wall", &wall},
                        {"mesh motion", &motion},
                        {"coupling", scheme.get()},
                        {"wall shear", &shear}},
                       output);
  march.judge(fluid);
  march.judge(wall);
  const app::SurfaceReport surfaces(list.sublist("Output"), &*domain.fluid, &*domain.wall);
  app::Checkpoints checkpoints(output, march, app::wall_limit(list), comm);
  checkpoints.begin();
  app::RunLog log(output, comm->getRank() == 0, scheme->fields(), scheme->stages());
  app::Watch watch(list);
  const app::WallOutput of_wall(wall, list.sublist("Output"));
  app::FieldSeries fields(output, {app::grid_of(*domain.fluid, "fluid"), of_wall.grid()}, comm);

  // 4. March.
  scheme->watch_newton([&](const std::string& field, const nonlinear::NewtonStep& step) {
    log.newton(field, step);
  });
  const auto solve = [&](const stepping::Clock& clock, int attempt) {
    log.begin({clock.step(), clock.time(), 1, attempt});
    const Outcome begun = scheme->begin_step(clock);
    if (begun.is_failure()) return app::summary_of(begun, scheme->fields());
    const coupling::Report report = scheme->solve_step(
        clock, [&](int, const coupling::Iteration& iteration) { log.coupling(iteration); });
    if (!report.remark.empty()) log.warn(report.remark);
    return app::summary_of(report, scheme->fields());
  };
  const auto make_step = [&] {
    app::StepSummary step = march.make_step(solve, log);
    const stepping::Clock& clock = march.clock();
    if (step.is_accepted) shear.accept(clock);
    const discretisation::Observables observed =
        app::joined({wall.observe(), fluid.observe(), shear.observe(),
                     domain.probes.observe(&fluid, &wall), surfaces.observe(&fluid, &wall)});
    log.step(clock, step, observed);
    watch.tell(log, clock, step, observed, &fluid.mesh(), motion.displacement(),
               [&] { return app::layer_volumes(wall); });
    return step;
  };
  const Outcome marched = checkpoints.march(make_step, [&] {
    if (fields.is_due(march.clock()))
      fields.write(march.clock(), both_fields(fluid, motion, shear, of_wall));
  });
  if (marched.is_failure()) return marched;

  // 5. Report.
  fields.finish();
  app::record_assembly(output.record, "fluid", fluid.jacobian_throughput(), *comm);
  app::record_assembly(output.record, "wall", wall.jacobian_throughput(), *comm);
  return Outcome::success();
}

}  // namespace

int main(int argc, char** argv) {
  return tunica::app::run_program(
      argc, argv,
      {"tunica-fsi", "Solves a fluid-structure interaction problem.", tunica::app::fsi_table()},
      march);
}
