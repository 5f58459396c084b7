// Marches a fluid-structure interaction problem in time.
//
//   tunica-fsi xml/pulse.xml --output results/pulse
//   mpirun -n 2 tunica-fsi xml/pulse-tiny.xml --steps 2 --set "Coupling/accelerator=aitken"

#include "tunica/app/checkpoints.hpp"
#include "tunica/app/field_output.hpp"
#include "tunica/app/run.hpp"
#include "tunica/app/run_log.hpp"
#include "tunica/app/schema.hpp"
#include "tunica/app/surface_report.hpp"
#include "tunica/coupling/dirichlet_neumann.hpp"

namespace {

using namespace tunica;

std::vector<app::GridFields> both_fields(const problems::FluidProblem& fluid,
                                         const problems::MeshMotion& motion,
                                         const problems::SolidProblem& wall) {
  return {{"fluid", app::fluid_arrays(fluid, motion.displacement()), {}},
          {"wall", app::wall_arrays(wall), app::wall_cell_arrays(wall)}};
}

Outcome march(const Teuchos::ParameterList& list, const app::Domain& domain,
              app::RunOutput& output) {
  // 1. Three fields, each with its kernels, blocks and solver.
  problems::FluidProblem fluid(list.sublist("Fluid"), *domain.fluid);
  problems::SolidProblem wall(list.sublist("Wall"), *domain.wall);
  problems::MeshMotion motion(list.sublist("Mesh Motion"), *domain.fluid, domain.interface_surfaces,
                              fluid.time_scheme());

  // 2. Couple them.
  stepping::Clock clock(list.sublist("Time"));
  coupling::DirichletNeumann scheme(list.sublist("Coupling"), *domain.interface, fluid, wall,
                                    motion);

  // 3. From where it goes on after a restart; what is written, and when.
  const CommPtr comm = domain.fluid->comm;
  const app::SurfaceReport surfaces(list.sublist("Output"), &*domain.fluid, &*domain.wall);
  const app::Checkpoints checkpoints(
      output, {{"fluid", &fluid}, {"wall", &wall}, {"mesh motion", &motion}, {"coupling", &scheme}},
      comm);
  checkpoints.begin(clock);
  app::RunLog log(output, comm->getRank() == 0, clock.steps(), scheme.fields(), scheme.stages());
  app::FieldSeries fields(
      output, {app::grid_of(*domain.fluid, "fluid"), app::grid_of(*domain.wall, "wall")}, comm);

  // 4. March.
  for (; !clock.is_done(); clock.advance()) {
    if (const Outcome prepared = scheme.prepare(clock); prepared.is_failure()) return prepared;
    const coupling::Report report =
        scheme.solve_step(clock, [&](int k, const coupling::Iteration& iteration) {
          log.coupling({clock.step(), clock.time(), k}, iteration);
        });
    log.step({clock.step(), clock.time(), 0}, app::summary_of(report, scheme.fields()),
             app::joined({wall.observe(), fluid.observe(), domain.probes.observe(&fluid, &wall),
                          surfaces.observe(&fluid, &wall)}));
    if (!report.is_accepted) return Outcome::failure(report.reason);
    if (!report.is_converged) log.warn(report.reason);
    if (fields.is_due(clock)) fields.write(clock, both_fields(fluid, motion, wall));
    checkpoints.write_if_due(clock);
  }

  // 5. Report.
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
