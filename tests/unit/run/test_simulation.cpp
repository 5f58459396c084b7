#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "unit/run/whole_run.hpp"

namespace {

using namespace tunica;
using test::Quiet;
using test::steps_of;
using test::Whole;

const std::vector<std::string> monolithic{"Time/steps=2", "Coupling/scheme=monolithic"};
const std::vector<std::string> partitioned{"Time/steps=2", "Fluid/viscosity=0.008"};

/// Two coupled problems that differ in scheme and viscosity.
Whole first(const std::string& folder, const CommPtr& comm) {
  return Whole("pulse-tiny.xml", monolithic, output::test::scratch(folder), comm);
}
Whole second(const std::string& folder, const CommPtr& comm) {
  return Whole("pulse-tiny.xml", partitioned, output::test::scratch(folder), comm);
}

std::string alone(Whole run) {
  const Outcome outcome = run.simulation.march();
  return outcome.is_failure() ? outcome.reason() : steps_of(run);
}

/// The columns of both in turns, a step of each.
std::pair<std::string, std::string> side_by_side(Whole a, Whole b) {
  Outcome outcome = a.simulation.begin();
  if (outcome.is_success()) outcome = b.simulation.begin();
  while (outcome.is_success() && !(a.simulation.is_done() && b.simulation.is_done()))
    for (Whole* run : {&a, &b})
      if (outcome.is_success() && !run->simulation.is_done()) outcome = run->simulation.step();
  if (outcome.is_failure()) return {outcome.reason(), outcome.reason()};
  return {steps_of(a), steps_of(b)};
}

TEUCHOS_UNIT_TEST(simulation, two_side_by_side_are_each_as_it_is_alone) {
  const Quiet quiet;
  const CommPtr comm = output::test::world();
  const std::string of_first = alone(first("alone-first", comm));
  const std::string of_second = alone(second("alone-second", comm));
  const auto both = side_by_side(first("beside-first", comm), second("beside-second", comm));
  TEST_INEQUALITY(of_first, of_second);
  TEST_EQUALITY(both.first, of_first);
  TEST_EQUALITY(both.second, of_second);
  if (comm->getRank() == 0) TEST_ASSERT(of_first.find("\n2,") != std::string::npos);
}

TEUCHOS_UNIT_TEST(simulation, one_runs_on_the_ranks_that_it_is_given) {
  const Quiet quiet;
  const CommPtr comm = output::test::world();
  const int rank = comm->getRank();
  const std::string folder = output::test::scratch("own") + "/" + std::to_string(rank);
  Whole run("pulse-tiny.xml", rank % 2 == 0 ? monolithic : partitioned, folder,
            comm->split(rank, 0));
  TEST_ASSERT(run.simulation.march().is_success());
  TEST_ASSERT(steps_of(run).find("\n2,") != std::string::npos);
}

TEUCHOS_UNIT_TEST(simulation, fields_are_known_by_name) {
  const Quiet quiet;
  Whole run = first("fields", output::test::world());
  TEST_ASSERT(run.simulation.begin().is_success());
  TEST_EQUALITY(run.simulation.field("fluid").mesh().n_owned, run.domain.mesh("fluid").n_owned);
  TEST_EQUALITY(run.simulation.field("wall").mesh().n_owned, run.domain.mesh("wall").n_owned);
  try {
    run.simulation.field("blood");
    TEST_ASSERT(false);
  } catch (const Error& error) {
    TEST_ASSERT(std::string(error.what()).find("wall, fluid") != std::string::npos);
  }
}

TEUCHOS_UNIT_TEST(simulation, its_lines_go_where_the_caller_wants_them) {
  const Quiet quiet;
  Whole run = first("lines", output::test::world());
  TEST_EQUALITY(run.simulation.steps_made(), 0);
  TEST_ASSERT(run.simulation.march().is_success());
  TEST_EQUALITY(run.simulation.steps_made(), 2);
  TEST_FLOATING_EQUALITY(run.simulation.time(),
                         2.0 * run.list.sublist("Time").get<double>("step size"), 1e-12);
  if (output::test::world()->getRank() == 0)
    TEST_ASSERT(quiet.said.find("step 2/2") != std::string::npos);
}

}  // namespace
