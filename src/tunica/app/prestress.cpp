#include "tunica/app/prestress.hpp"

#include <cstdio>

#include "tunica/base/timer.hpp"
#include "tunica/problems/prestress.hpp"

namespace tunica::app {

Outcome take_prestress(const Teuchos::ParameterList& list, RunOutput& output,
                       problems::SolidProblem& wall, problems::FluidProblem* fluid) {
  if (!problems::wants_prestress(list) || output.restart) return Outcome::success();
  const Stopwatch watch;
  const bool is_root = wall.mesh().comm->getRank() == 0;
  int iterations = 0;
  problems::PrestressIteration last{};
  const auto report = [&](const problems::PrestressIteration& now) {
    ++iterations;
    last = now;
    if (is_root)
      std::printf("prestress: load %.4f, iteration %d: %.2e mm from the mesh\n", now.load,
                  now.iteration, now.moved);
    std::fflush(stdout);
  };
  const auto found = problems::find_prestress(list, wall, report);
  output.record.add_time("prestress", watch.seconds());
  if (found.is_failure()) return found.outcome();
  const Outcome shaped = wall.set_stress_free(found.value().from_stress_free);
  if (shaped.is_failure()) return shaped;
  wall.take(found.value().state);
  if (fluid != nullptr)
    fluid->set_initial_pressure(list.sublist("Prestress").get<double>("pressure"));
  output.record.set("prestress", "iterations", iterations);
  output.record.set("prestress", "mm from the mesh", last.moved);
  output.record.set("prestress", "largest displacement mm", last.largest);
  return Outcome::success();
}

}  // namespace tunica::app
