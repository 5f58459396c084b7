#include <Teuchos_Array.hpp>
#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/algebra/sub_system.hpp"
#include "tunica/base/error.hpp"
#include "tunica/linear/linear_solver.hpp"
#include "unit/algebra/by_blocks.hpp"
#include "unit/coupling/coupled_tube.hpp"

namespace {

using namespace tunica;
using test::blocks_of;
using test::CoupledTube;
using test::product_of_blocks;
using Names = std::vector<std::string>;

const Names wall{"wall", "interface"}, lumen{"lumen"}, lumen_and_interface{"lumen", "interface"};

/// The coupled tube's Jacobian at a point, on a domain that stands.
struct Coupled : CoupledTube {
  Coupled() : CoupledTube("extrapolated") {
    if (problem.begin_step(stepping::Clock(0.125, 1)).is_failure())
      throw std::runtime_error("the step does not begin");
    const auto x = point(1);
    algebra::BlockVector F(problem.space());
    if (problem.residual(x, F).is_failure())
      throw std::runtime_error("the point is not admissible");
    problem.jacobian(x);
  }
  const algebra::BlockMatrix& K() const { return problem.last_jacobian(); }
};

/// Numbers everywhere, also at the ends.
algebra::BlockVector numbers(const algebra::BlockSpacePtr& space) {
  algebra::BlockVector x(space);
  for (int b = 0; b < x.n_blocks(); ++b) {
    const auto view = x[b].getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < view.extent(0); ++i)
      view(i, 0) = test::scatter(
          71.3 * b + static_cast<double>(x[b].getMap()->getGlobalElement(static_cast<int>(i))));
  }
  return x;
}

double distance(const algebra::BlockVector& x, const algebra::BlockVector& y) {
  algebra::BlockVector d(x.space());
  d.assign(x);
  for (int b = 0; b < d.n_blocks(); ++b) d[b].update(-1.0, y[b], 1.0);
  return norm(d);
}

Teuchos::ParameterList field(const Names& parts, const std::string& own = "") {
  Teuchos::ParameterList list;
  list.set("parts", Teuchos::Array<std::string>(parts));
  list.set("method", std::string("direct"));
  if (!own.empty()) list.set("own block of", own);
  return list;
}

/// One application of the preconditioner as a solver: "fixed point" from zero.
Teuchos::ParameterList sweeps(const std::vector<Teuchos::ParameterList>& fields,
                              int applications = 1) {
  Teuchos::ParameterList list;
  list.set("method", std::string("fixed point"));
  list.set("preconditioner", std::string("field by field"));
  list.set("max iterations", applications);
  for (std::size_t f = 0; f < fields.size(); ++f)
    list.sublist("Fields").sublist(std::string(1, static_cast<char>('a' + f))) = fields[f];
  return list;
}

std::unique_ptr<linear::LinearSolver> made(Teuchos::ParameterList list, const Coupled& tube,
                                           const algebra::BlockMatrix& K) {
  linear::SolverDefaults defaults;
  defaults.has_fields = true;
  auto resolved = test::resolved(list, linear::linear_solver_table(defaults));
  return linear::make_linear_solver(resolved, K, tube.problem.operators());
}

algebra::BlockVector solved(const Teuchos::ParameterList& list, const Coupled& tube,
                            const algebra::BlockMatrix& K, const algebra::BlockVector& b) {
  algebra::BlockVector x(b.space());
  const auto solver = made(list, tube, K);
  solver->matrix_changed();
  solver->solve(b, x, 1e-9);
  return x;
}

TEUCHOS_UNIT_TEST(sub_system, is_the_whole_without_other_unknowns) {
  const Coupled tube;
  for (const Names& parts : {wall, lumen, lumen_and_interface}) {
    const algebra::SubSystem part(tube.K(), parts);
    // R K Rᵀ R x against the product of K with a vector that is zero elsewhere
    const auto x = numbers(tube.K().space());
    algebra::BlockVector x_s(part.matrix().space()), expected(x_s.space()), only(x.space());
    part.restrict(x, x_s);
    part.add(1.0, x_s, only);
    part.restrict(product_of_blocks(tube.K(), only), expected);
    TEST_COMPARE(norm(expected), >, 0.0);
    TEST_COMPARE(distance(product_of_blocks(part.matrix(), x_s), expected), <,
                 1e-13 * norm(expected));
  }
}

TEUCHOS_UNIT_TEST(sub_system, parts_have_every_unknown_once) {
  const Coupled tube;
  long long sum = 0;
  for (const Names& parts : {Names{"wall"}, Names{"lumen"}, Names{"interface"}})
    sum += algebra::SubSystem(tube.K(), parts).matrix().n_unknowns();
  TEST_EQUALITY(sum, tube.K().n_unknowns());
  // On the interface there are velocities alone: its pressures are those of wall and lumen.
  const algebra::SubSystem interface(tube.K(), {"interface"});
  TEST_EQUALITY((*interface.matrix().space())[1].map->getGlobalNumElements(), 0u);
  TEST_COMPARE((*interface.matrix().space())[0].map->getGlobalNumElements(), >, 0u);
}

TEUCHOS_UNIT_TEST(sub_system, follows_new_values) {
  Coupled tube;
  algebra::SubSystem part(tube.K(), wall);
  const auto x = tube.point(3);
  algebra::BlockVector F(tube.problem.space());
  TEST_ASSERT(tube.problem.residual(x, F).is_success());
  tube.problem.jacobian(x);
  part.refresh();
  const auto x_s = numbers(part.matrix().space());
  const auto expected = product_of_blocks(algebra::SubSystem(tube.K(), wall).matrix(), x_s);
  TEST_COMPARE(distance(product_of_blocks(part.matrix(), x_s), expected), <=, 0.0);
}

TEUCHOS_UNIT_TEST(field_by_field, one_field_of_all_parts_is_the_inverse) {
  const Coupled tube;
  const auto x = numbers(tube.K().space());
  algebra::BlockVector b(x.space());
  tube.K().apply(x, b);  // with the windkessel
  const auto found = solved(sweeps({field({"wall", "lumen", "interface"})}, 5), tube, tube.K(), b);
  TEST_COMPARE(distance(found, x), <, 1e-8 * norm(x));
}

// A sweep over the blocks K = [K_ww K_wl; K_lw K_ll] is (D + L)⁻¹: what is left of b is −K_wl y_l
// in the first field and nothing in the last.
TEUCHOS_UNIT_TEST(field_by_field, a_sweep_leaves_nothing_in_the_last_field) {
  const Coupled tube;
  const auto b = numbers(tube.K().space());
  const auto y = solved(sweeps({field(wall), field(lumen)}), tube, blocks_of(tube.K()), b);
  auto rest = product_of_blocks(tube.K(), y);
  for (int k = 0; k < rest.n_blocks(); ++k) rest[k].update(1.0, b[k], -1.0);  // b − K y
  const algebra::SubSystem first(tube.K(), wall), last(tube.K(), lumen);
  algebra::BlockVector in_first(first.matrix().space()), in_last(last.matrix().space());
  first.restrict(rest, in_first);
  last.restrict(rest, in_last);
  TEST_COMPARE(norm(in_last), <, 1e-9 * norm(b));
  algebra::BlockVector y_last(in_last.space()), only(b.space()), of_last(in_first.space());
  last.restrict(y, y_last);
  last.add(-1.0, y_last, only);
  first.restrict(product_of_blocks(tube.K(), only), of_last);
  TEST_COMPARE(norm(of_last), >, 1e-3 * norm(b));
  TEST_COMPARE(distance(in_first, of_last), <, 1e-9 * norm(b));
}

// The share of the wall on the interface is K_ww less that of the fluid, which has inertia there.
// Those of the present Jacobian, wherever a residual has been evaluated since.
TEUCHOS_UNIT_TEST(field_by_field, own_blocks_add_up) {
  Coupled tube;
  algebra::BlockVector elsewhere(tube.K().space());
  TEST_ASSERT(tube.problem.residual(tube.point(7), elsewhere).is_success());
  const auto& A = *tube.K()(0, 0);
  const auto x = numbers(tube.K().space());
  Vector sum(A.getRowMap()), y(A.getRowMap());
  for (const std::string part : {"wall", "lumen"}) {
    tube.problem.operators().assemble_operator(linear::own_block_of(part))->apply(x[0], y);
    TEST_COMPARE(y.norm2(), >, 0.0);
    sum.update(1.0, y, 1.0);
  }
  A.apply(x[0], y);
  const double size = y.norm2();
  y.update(1.0, sum, -1.0);
  TEST_COMPARE(y.norm2(), <, 1e-13 * size);
}

TEUCHOS_UNIT_TEST(field_by_field, solves_with_each_order_and_share) {
  const Coupled tube;
  const auto x = numbers(tube.K().space());
  const algebra::BlockMatrix K = blocks_of(tube.K());
  const auto b = product_of_blocks(K, x);
  const std::vector<std::vector<Teuchos::ParameterList>> ways{
      {field(wall), field(lumen)},
      {field(wall, "wall"), field(lumen)},
      {field(wall), field(lumen_and_interface)}};
  for (const auto& fields : ways) {
    auto list = sweeps(fields, 200);
    list.set("method", std::string("gcr"));
    TEST_COMPARE(distance(solved(list, tube, K, b), x), <, 1e-7 * norm(x));
  }
}

TEUCHOS_UNIT_TEST(field_by_field, refuses_parts_that_are_unknown_or_left_out) {
  const Coupled tube;
  const auto message = [&](const Teuchos::ParameterList& list) -> std::string {
    try {
      made(list, tube, tube.K());
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  TEST_ASSERT(message(sweeps({field({"lumen", "walls"})})).find("no part \"walls\"; it has") !=
              std::string::npos);
  TEST_ASSERT(
      message(sweeps({field(wall)})).find("no entry of \"Fields\" has the part \"lumen\"") !=
      std::string::npos);
  TEST_ASSERT(message(sweeps({field(wall, "interface"), field(lumen)}))
                  .find("no own block of \"interface\"") != std::string::npos);
  auto gmres = sweeps({field(wall), field(lumen)});
  gmres.set("method", std::string("gmres"));
  TEST_ASSERT(message(gmres).find("field by field") != std::string::npos);
  TEST_ASSERT(message(sweeps({})).find("at least one entry") != std::string::npos);
}

}  // namespace
