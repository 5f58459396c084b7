#include <Teuchos_DefaultMpiComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/linear/linear_solver.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"
#include "tunica/smoothers/vanka/vanka.hpp"
#include "unit/multigrid/complaint.hpp"
#include "unit/smoothers/wall_matrix.hpp"

namespace {

using namespace tunica;
using test::complaint;
using test::WallMatrix;

/// Cycles on the levels of the nodal coarsening, smoothed by Vanka.
Teuchos::ParameterList vanka_list(double stabilisation_scaling = 1.0) {
  Teuchos::ParameterList list = multigrid::mixed_cycle_list(1);
  list.sublist("Factories").sublist("Galerkin").set("factory", "GalerkinFactory");
  list.sublist("Factories").sublist("Galerkin").set("stabilisation scaling", stabilisation_scaling);
  list.sublist("Factories").sublist("Sweeps") = Teuchos::ParameterList();
  list.sublist("Factories").sublist("Sweeps").set("factory", "VankaSmoother");
  list.sublist("Hierarchy").set("coarse: max size", 30);
  return list;
}

Teuchos::RCP<multigrid::Cycle> cycle(const WallMatrix& wall, const Teuchos::ParameterList& list) {
  return Teuchos::rcp(new multigrid::Cycle(
      wall.K(), Teuchos::rcp(new multigrid::MixedCoarsening(*wall.jacobian.K.space())), list));
}

/// The matrices of the levels of a cycle.
std::vector<Teuchos::RCP<const CrsMatrix>> matrices(const Teuchos::RCP<multigrid::Cycle>& cycle) {
  std::vector<Teuchos::RCP<const CrsMatrix>> all;
  for (std::size_t level = 0; level < cycle->levels().unknowns.size(); ++level)
    all.push_back(cycle->matrix(static_cast<int>(level)));
  return all;
}

/// Each rank on its own. MueLu asks every communicator for the one of MPI behind it.
CommPtr myself() { return Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)); }

linear::SolveReport solve(const CommPtr& comm, const Teuchos::ParameterList& muelu) {
  const test::SmallTube tube(comm);
  test::WallJacobian jacobian(tube);
  jacobian.set(0.005);
  Teuchos::ParameterList list;
  list.set("method", "gcr").set("preconditioner", "multigrid");
  list.sublist("MueLu") = muelu;
  linear::linear_solver_table().resolve(list, "Linear Solver", "");
  const auto solver = linear::make_linear_solver(list, jacobian.K);
  solver->matrix_changed();
  algebra::BlockVector x = fields::zero_vector(tube.wall);
  return solver->solve(test::scattered(tube.wall, 1), x, 1e-8);
}

TEUCHOS_UNIT_TEST(vanka_smoother, does_what_vanka_does) {
  const WallMatrix wall;
  auto list = vanka_list();
  list.sublist("Factories")
      .sublist("Sweeps")
      .set("sweeps", 2)
      .set("damping", 0.7)
      .set("order", "backward")
      .set("combine", "additive")
      .set("precision", "single")
      .set("patch", "diagonal");
  list.sublist("Hierarchy").set("max levels", 1).sublist("All").set("CoarseSolver", "Sweeps");
  const auto M = cycle(wall, list);
  smoothers::VankaOptions options{2, 0.7, "backward", true, true, "diagonal"};
  const auto vanka =
      smoothers::make_vanka(*wall.K(), smoothers::mixed_rows(*wall.K(), {}), options);
  vanka->refresh();
  const Vector b = wall.scattered(1);
  Vector x = wall.scattered(2), expected(b.getMap());
  M->apply(b, x);
  vanka->smooth(b, expected);
  x.update(-1.0, expected, 1.0);
  TEST_COMPARE(expected.normInf(), >, 0.0);
  TEST_COMPARE(x.normInf(), <, 1e-12 * expected.normInf());
}

/// On four ranks each has some twenty nodes, most of them at its edge, where patches are cut.
TEUCHOS_UNIT_TEST(vanka_smoother, cycles_solve_a_real_jacobian_on_any_ranks) {
  for (const auto& [combine, patch] :
       {std::pair{"multiplicative", "full"}, std::pair{"additive", "full"},
        std::pair{"multiplicative", "diagonal"}, std::pair{"multiplicative", "node pair"}}) {
    auto list = vanka_list();
    list.sublist("Factories")
        .sublist("Sweeps")
        .set<std::string>("combine", combine)
        .set<std::string>("patch", patch);
    const auto parallel = solve(test::world(), list), serial = solve(myself(), list);
    out << combine << ", " << patch << ": " << parallel.iterations << " iterations, alone "
        << serial.iterations << "\n";
    TEST_ASSERT(parallel.is_converged);
    TEST_ASSERT(serial.is_converged);
    // Alone, pairs need half the steps of the others; of pairs of two ranks each has one node.
    const double most = patch == std::string("node pair") ? 4.0 : 2.0;
    TEST_COMPARE(parallel.iterations, <=, most * serial.iterations);
  }
}

TEUCHOS_UNIT_TEST(vanka_smoother, a_wrong_word_is_refused_with_those_that_it_knows) {
  const WallMatrix wall;
  for (const auto& [key, word, known] : {std::tuple{"order", "foward", "\"forward\""},
                                         std::tuple{"combine", "added", "\"additive\""},
                                         std::tuple{"precision", "half", "\"single\""},
                                         std::tuple{"patch", "edge", "\"node pair\""}}) {
    auto list = vanka_list();
    list.sublist("Factories").sublist("Sweeps").set<std::string>(key, word);
    const std::string text = complaint([&] { cycle(wall, list); });
    out << text << "\n";
    TEST_INEQUALITY(text.find('"' + std::string(key) + "\" is \"" + word + '"'), std::string::npos);
    TEST_INEQUALITY(text.find(known), std::string::npos);
  }
}

TEUCHOS_UNIT_TEST(cycle_list, an_unknown_factory_is_named_with_those_that_are_ours) {
  TEST_NOTHROW(multigrid::check_cycle_list(vanka_list()));
  auto list = vanka_list();
  list.sublist("Factories").sublist("Sweeps").set("factory", "VankaSmother");
  const std::string text = complaint([&] { multigrid::check_cycle_list(list); });
  for (const std::string part : {"unknown factory name : VankaSmother", "\"VankaSmoother\"",
                                 "\"NodalPFactory\"", "\"GalerkinFactory\""})
    TEST_INEQUALITY(text.find(part), std::string::npos);
}

TEUCHOS_UNIT_TEST(cycle_list, slips_in_our_factories_are_refused_before_anything_is_set_up) {
  auto list = vanka_list();
  list.sublist("Factories").sublist("Sweeps").set("swept", 2);
  TEST_INEQUALITY(complaint([&] { multigrid::check_cycle_list(list); }).find("\"swept\""),
                  std::string::npos);
  for (const char* key : {"stabilisation scaling", "schur stabilisation", "least stabilisation"}) {
    list = vanka_list();
    list.sublist("Factories").sublist("Galerkin").set(key, -0.1);
    const std::string text = complaint([&] { multigrid::check_cycle_list(list); });
    TEST_INEQUALITY(text.find("\"" + std::string(key) + "\" is -0.1"), std::string::npos);
  }
  list = vanka_list();
  list.sublist("Factories").sublist("Sweeps").set("order", "foward");
  TEST_INEQUALITY(complaint([&] { multigrid::check_cycle_list(list); }).find("\"foward\""),
                  std::string::npos);
}

TEUCHOS_UNIT_TEST(cycle_list, without_factories_it_is_refused) {
  TEST_THROW(multigrid::check_cycle_list(Teuchos::ParameterList()), Error);
}

TEUCHOS_UNIT_TEST(galerkin_factory, scales_the_stabilisation_and_nothing_else) {
  const WallMatrix wall;
  const auto plain = matrices(cycle(wall, vanka_list()));
  const auto scaled = matrices(cycle(wall, vanka_list(4.0)));
  TEST_COMPARE(plain.size(), >, 1);
  TEST_EQUALITY(plain.size(), scaled.size());
  double factor = 1.0;  // powers of two: exact
  for (std::size_t level = 0; level < plain.size(); ++level, factor *= 4.0) {
    const auto before = plain[level]->getLocalMatrixHost();
    const auto after = scaled[level]->getLocalMatrixHost();
    bool is_as_defined = before.nnz() == after.nnz();
    for (int i = 0; i < before.numRows(); ++i) {
      const auto row = before.rowConst(i), scaled_row = after.rowConst(i);
      for (int k = 0; k < row.length; ++k) {
        const bool is_pressure =
            plain[level]->getRowMap()->getGlobalElement(i) % 4 == 3 &&
            plain[level]->getColMap()->getGlobalElement(row.colidx(k)) % 4 == 3;
        is_as_defined &= scaled_row.value(k) == (is_pressure ? factor : 1.0) * row.value(k);
      }
    }
    TEST_ASSERT(all_agree(*test::world(), is_as_defined));
  }
}

}  // namespace
