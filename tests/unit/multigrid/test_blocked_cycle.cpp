#include <Teuchos_UnitTestHarness.hpp>
#include <Teuchos_XMLParameterListHelpers.hpp>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/linear/direct/direct_factor.hpp"
#include "tunica/linear/linear_solver.hpp"
#include "tunica/multigrid/muelu/blocked_matrix.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"
#include "unit/algebra/distance.hpp"
#include "unit/multigrid/complaint.hpp"
#include "unit/smoothers/dense_sweep.hpp"
#include "unit/smoothers/wall_matrix.hpp"

namespace {

using namespace tunica;
using test::complaint;
using test::distance;
using test::WallMatrix;

/// Three levels or more of the nodal coarsening for a matrix of blocks, with this smoother.
Teuchos::ParameterList blocked_list(const std::string& smoother = "BraessSarazinSmoother") {
  Teuchos::ParameterList list = multigrid::mixed_cycle_list(1);
  Teuchos::ParameterList& factories = list.sublist("Factories");
  factories = Teuchos::ParameterList();  // later factories use those before them
  factories.sublist("Nodes").set("factory", "NodalBlockedPFactory");
  factories.sublist("Galerkin")
      .set("factory", "BlockedRAPFactory")
      .set("P", "Nodes")
      .set("R", "Nodes");
  factories.sublist("Schur").set("factory", "SchurComplementFactory").set("omega", 2.0);
  factories.sublist("Exact").set("factory", "DirectSolver").set("type", "Klu");
  auto& sweeps = factories.sublist("Sweeps");
  sweeps.set("factory", smoother).set("Sweeps", 2).set("Damping factor", 2.0);
  sweeps.sublist("block1").set("A", "Schur").set("Smoother", "Exact");
  factories.sublist("Coarsest").set("factory", "BlockedDirectSolver");
  list.sublist("Hierarchy").set("coarse: max size", 30).sublist("All").set("R", "Nodes");
  return list;
}

/// The same on one matrix, with our smoother.
Teuchos::ParameterList merged_list() {
  Teuchos::ParameterList list = multigrid::mixed_cycle_list(1);
  auto& sweeps = list.sublist("Factories").sublist("Sweeps");
  sweeps = Teuchos::ParameterList();
  sweeps.set("factory", "NodalBraessSarazinSmoother")
      .set("sweeps", 2)
      .set("scaling", 2.0)
      .set("schur", "direct");
  list.sublist("Hierarchy").set("coarse: max size", 30);
  return list;
}

/// The smoother alone.
Teuchos::ParameterList without_coarse_levels(Teuchos::ParameterList list) {
  list.sublist("Hierarchy").set("max levels", 1).sublist("All").set("CoarseSolver", "Sweeps");
  return list;
}

/// Schwarz with one patch per pressure alone, without coarse levels.
Teuchos::ParameterList schwarz_list() {
  Teuchos::ParameterList list = blocked_list();
  auto& sweeps = list.sublist("Factories").sublist("Sweeps");
  sweeps = Teuchos::ParameterList();
  sweeps.set("factory", "TrilinosSmoother").set("type", "SCHWARZ");
  sweeps.sublist("ParameterList")
      .set("subdomain solver name", "BLOCK_RELAXATION")
      .sublist("subdomain solver parameters")
      .set("partitioner: type", "user")
      .set("partitioner: overlap", 1)
      .set("relaxation: container", "Dense")
      .set("relaxation: type", "Gauss-Seidel");
  return without_coarse_levels(list);
}

Teuchos::RCP<multigrid::MixedCoarsening> nodes_of(const WallMatrix& wall) {
  return Teuchos::rcp(new multigrid::MixedCoarsening(*wall.jacobian.K.space()));
}

Teuchos::RCP<multigrid::Cycle> make_cycle(const WallMatrix& wall,
                                          const Teuchos::ParameterList& list, bool is_blocked) {
  return Teuchos::rcp(new multigrid::Cycle(wall.K(), nodes_of(wall), list, is_blocked));
}

Teuchos::RCP<multigrid::Cycle> blocked_cycle(const WallMatrix& wall,
                                             const Teuchos::ParameterList& list) {
  return make_cycle(wall, list, true);
}

Vector product(const Operator& A, const Vector& x) {
  Vector y(A.getRangeMap());
  A.apply(x, y);
  return y;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Whether a row has nothing but its diagonal.
bool is_fixed(const CrsMatrix& K, GlobalOrdinal number) {
  const auto row = K.getLocalMatrixHost().rowConst(K.getRowMap()->getLocalElement(number));
  for (int k = 0; k < row.length; ++k)
    if (row.value(k) != 0.0 && K.getColMap()->getGlobalElement(row.colidx(k)) != number)
      return false;
  return true;
}

TEUCHOS_UNIT_TEST(blocked_cycle, treats_each_of_several_columns_as_if_it_were_alone) {
  const WallMatrix wall;
  for (const auto& list : {blocked_list(), schwarz_list()}) {
    const auto cycle = blocked_cycle(wall, list);
    MultiVector b(wall.K()->getRowMap(), 2), x(b.getMap(), 2);
    for (int c = 0; c < 2; ++c) b.getVectorNonConst(c)->assign(wall.scattered(c));
    cycle->apply(b, x);
    for (int c = 0; c < 2; ++c)
      TEST_COMPARE(distance(*x.getVector(c), product(*cycle, *b.getVector(c))), <, 1e-11);
  }
}

TEUCHOS_UNIT_TEST(blocked_matrix, is_the_merged_one_in_other_clothes) {
  const WallMatrix wall;
  const auto blocks = multigrid::blocked(*wall.K(), {});
  const auto n = 4 * wall.mesh().node_map->getGlobalNumElements();
  TEST_EQUALITY(blocks->getMatrix(0, 0)->getGlobalNumRows(), n / 4 * 3);
  TEST_EQUALITY(blocks->getMatrix(1, 0)->getGlobalNumRows(), n / 4);
  const Vector x = wall.scattered(1);
  const auto merged = multigrid::unwrapped(blocks->Merge());
  TEST_ASSERT(merged->getRowMap()->isSameAs(*wall.K()->getRowMap()));
  TEST_COMPARE(distance(product(*merged, x), product(*wall.K(), x)), <, 1e-14);
}

TEUCHOS_UNIT_TEST(blocked_matrix, its_constants_are_one_in_one_component_each) {
  const WallMatrix wall;
  const auto blocks = multigrid::blocked(*wall.K(), {});
  for (const auto& [block, components] : {std::pair{0, 3}, std::pair{1, 1}}) {
    const auto vectors = multigrid::unwrapped(*multigrid::constants(*blocks, block, components));
    const auto values = vectors->getLocalViewHost(read_only);
    bool is_as_defined = static_cast<int>(values.extent(1)) == components;
    for (std::size_t row = 0; row < values.extent(0); ++row) {
      const GlobalOrdinal number = vectors->getMap()->getGlobalElement(static_cast<int>(row));
      for (int i = 0; i < components; ++i)
        is_as_defined &= values(row, i) == (number % 4 == 3 * block + i ? 1.0 : 0.0);
    }
    TEST_ASSERT(all_agree(*test::world(), is_as_defined));
  }
}

TEUCHOS_UNIT_TEST(blocked_cycle, has_the_coarse_matrices_of_the_merged_one) {
  const WallMatrix wall;
  const auto M = blocked_cycle(wall, blocked_list());
  const auto merged = make_cycle(wall, merged_list(), false);
  const auto levels = M->levels(), expected = merged->levels();
  TEST_COMPARE(levels.unknowns.size(), >=, 3);
  TEST_ASSERT(levels.unknowns == expected.unknowns);
  TEST_COMPARE(levels.operator_complexity, >, 1.0);
  for (int level = 1; level < static_cast<int>(levels.unknowns.size()); ++level) {
    const auto A = merged->matrix(level);
    Vector x(A->getDomainMap());
    for (const GlobalOrdinal g : global_numbers(*x.getMap()))
      x.replaceGlobalValue(g, test::scatter(static_cast<double>(g)));
    TEST_COMPARE(distance(product(*M->matrix(level), x), product(*A, x)), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(blocked_cycle, muelus_braess_sarazin_is_ours_on_rows_that_are_not_fixed) {
  const WallMatrix wall;
  const auto M = blocked_cycle(wall, without_coarse_levels(blocked_list()));
  const auto merged = make_cycle(wall, without_coarse_levels(merged_list()), false);
  Vector b = wall.scattered(2);
  for (const GlobalOrdinal row : global_numbers(*b.getMap()))  // ours solves these rows
    if (is_fixed(*wall.K(), row)) b.replaceGlobalValue(row, 0.0);
  TEST_COMPARE(distance(product(*M, b), product(*merged, b)), <, 1e-8);
}

TEUCHOS_UNIT_TEST(blocked_cycle, is_one_linear_operator_whatever_it_did_before) {
  const WallMatrix wall;
  auto list = blocked_list();
  for (const std::string type : {"V", "W"}) {
    list.sublist("Hierarchy").set("cycle type", type);
    const auto M = blocked_cycle(wall, list);
    const Vector b = wall.scattered(3), c = wall.scattered(4);
    const Vector Mb = product(*M, b), Mc = product(*M, c);
    Vector again = wall.scattered(5), sum(b, Teuchos::Copy);
    M->apply(b, again);
    TEST_COMPARE(distance(again, Mb), <, 1e-14);
    sum.update(2.0, c, 1.0);
    Vector expected(Mb, Teuchos::Copy);
    expected.update(2.0, Mc, 1.0);
    TEST_COMPARE(distance(product(*M, sum), expected), <, 1e-9);
    Vector y = wall.scattered(6);
    expected.update(-0.5, Mb, 3.0, y, 0.0);  // −M b / 2 + 3 y
    M->apply(b, y, Teuchos::NO_TRANS, -0.5, 3.0);
    TEST_COMPARE(distance(y, expected), <, 1e-14);
  }
}

/// Rows that are coupled to nothing but themselves are one more patch, the last.
TEUCHOS_UNIT_TEST(blocked_cycle, schwarz_relaxes_a_patch_around_each_pressure) {
  const WallMatrix wall;
  const auto M = blocked_cycle(wall, schwarz_list());
  const Vector b = wall.scattered(7);
  const auto K = multigrid::unwrapped(multigrid::blocked(*wall.K(), {})->Merge());
  const int n = static_cast<int>(n_local_rows(*K));
  std::vector<double> full(static_cast<std::size_t>(n) * n, 0.0);  // without ghosts
  std::vector<std::vector<int>> neighbours(n);
  for (int i = 0; i < n; ++i) {
    const auto row = K->getLocalMatrixHost().rowConst(i);
    for (int k = 0; k < row.length; ++k) {
      const auto number = K->getColMap()->getGlobalElement(row.colidx(k));
      const int j = K->getRowMap()->getLocalElement(number);
      if (j < 0) continue;
      full[static_cast<std::size_t>(i) * n + j] = row.value(k);
      neighbours[i].push_back(j);
    }
  }
  std::vector<double> x(n, 0.0);
  const auto rhs = b.getData();
  const auto relax = [&](const std::vector<int>& patch) {
    std::vector<double> A, r;
    for (const int i : patch) {
      r.push_back(rhs[i]);
      for (int j = 0; j < n; ++j) r.back() -= full[static_cast<std::size_t>(i) * n + j] * x[j];
      for (const int j : patch) A.push_back(full[static_cast<std::size_t>(i) * n + j]);
    }
    const auto moves = test::solve_dense(A, r);
    for (std::size_t a = 0; a < patch.size(); ++a) x[patch[a]] += moves[a];
  };
  for (int i = 3; i < n; i += 4) relax(neighbours[i]);
  for (int i = 0; i < n; ++i)
    if (neighbours[i].size() == 1 && K->getNumEntriesInLocalRow(i) == 1) relax(neighbours[i]);
  Vector expected(b.getMap());
  for (int i = 0; i < n; ++i) expected.replaceLocalValue(i, x[i]);
  TEST_COMPARE(distance(product(*M, b), expected), <, 1e-9);
}

/// Those of the shipped cases for the wall, on coarser levels that suit so small a tube.
TEUCHOS_UNIT_TEST(blocked_cycle, the_lists_of_the_shipped_case_solve_a_real_jacobian) {
  const test::SmallTube tube;
  test::WallJacobian jacobian(tube);
  jacobian.set(0.005);
  const auto b = test::scattered(tube.wall, 1);
  algebra::BlockVector exact = fields::zero_vector(tube.wall);
  Teuchos::ParameterList direct;
  direct.set("method", "direct");
  linear::linear_solver_table().resolve(direct, "Linear Solver", "");
  linear::make_linear_solver(direct, jacobian.K)->solve(b, exact, 1e-10);
  const auto file =
      Teuchos::getParametersFromXmlFile(TUNICA_MESHES "/../xml/paper/muelu-mooney-rivlin.xml");
  const Teuchos::ParameterList& settings = file->sublist("Solvers").sublist("Wall");
  const std::map<std::string, int> most_iterations{{"MueLu Braess-Sarazin 2+2", 22},
                                                   {"MueLu SIMPLE 2+2", 8},
                                                   {"MueLu Uzawa 2+2", 9},
                                                   {"MueLu indefinite diagonal 2+2", 24},
                                                   {"MueLu block Gauss-Seidel 2+2", 27},
                                                   {"MueLu block Jacobi 2+2", 42},
                                                   {"MueLu Schwarz 1+1", 22},
                                                   {"aggregates, Braess-Sarazin", 23},
                                                   {"smoothed aggr., Braess-Sarazin", 23},
                                                   {"smoothed aggregates, SIMPLE", 9}};
  for (const auto& item : settings) {
    auto list = settings.sublist(item.first);
    if (!list.isParameter("matrix")) continue;
    list.sublist("MueLu").sublist("Hierarchy").set("coarse: max size", 30);
    linear::linear_solver_table().resolve(list, item.first, "");
    const auto solver = linear::make_linear_solver(list, jacobian.K);
    solver->matrix_changed();
    algebra::BlockVector x = fields::zero_vector(tube.wall);
    const auto report = solver->solve(b, x, 1e-8);
    out << item.first << ": " << report.iterations << " iterations, " << report.true_residual
        << ", levels";
    for (const long long n : report.levels.unknowns) out << " " << n;
    out << "\n";
    TEST_COMPARE(report.iterations, <=, most_iterations.at(item.first));
    TEST_COMPARE(report.true_residual, <, 2e-8);
    TEST_COMPARE(test::relative_difference(x, exact), <, 1e-7);
    TEST_COMPARE(report.levels.unknowns.size(), >=, 3);
    for (const long long n : report.levels.unknowns) TEST_EQUALITY(n % 4, 0);
  }
}

TEUCHOS_UNIT_TEST(cycle_list, factories_for_the_other_kind_of_matrix_are_refused) {
  const auto check = [](const Teuchos::ParameterList& list, bool is_blocked) {
    return complaint([&] { multigrid::check_cycle_list(list, is_blocked); });
  };
  TEST_EQUALITY(check(blocked_list(), true), "");
  TEST_EQUALITY(check(schwarz_list(), true), "");
  TEST_EQUALITY(check(merged_list(), false), "");
  TEST_ASSERT(has(check(blocked_list(), false), "\"matrix\" = \"blocked\""));
  TEST_ASSERT(has(check(merged_list(), true), "NodalPFactory needs \"matrix\" = \"merged\""));
  auto schwarz = merged_list();
  schwarz.sublist("Factories").sublist("Sweeps") =
      schwarz_list().sublist("Factories").sublist("Sweeps");
  TEST_ASSERT(has(check(schwarz, false), "SCHWARZ"));
  auto coarsest = blocked_list();
  coarsest.sublist("Factories").sublist("Coarsest").set("factory", "DirectSolver");
  TEST_ASSERT(has(check(coarsest, true), "BlockedDirectSolver"));
  auto lone = schwarz_list();
  lone.sublist("Factories")
      .sublist("Sweeps")
      .sublist("ParameterList")
      .sublist("subdomain solver parameters")
      .set("partitioner: overlap", 0);
  TEST_ASSERT(has(check(lone, true), "\"partitioner: overlap\""));
  auto by_default = blocked_list();
  by_default.sublist("Hierarchy").sublist("All").remove("CoarseSolver");
  TEST_ASSERT(has(check(by_default, true), "BlockedDirectSolver"));
  auto unknown = blocked_list("BraessSarasinSmoother");
  TEST_ASSERT(has(check(unknown, true), "unknown factory name : BraessSarasinSmoother. Ours are"));
}

TEUCHOS_UNIT_TEST(blocked_cycle, a_list_for_the_other_kind_of_matrix_fails_as_a_set_up) {
  const WallMatrix wall;
  TEST_THROW(blocked_cycle(wall, merged_list()), Error);
  TEST_THROW(make_cycle(wall, blocked_list(), false), Error);
  auto list = blocked_list();  // a smoother for one matrix that no name gives away
  auto& sweeps = list.sublist("Factories").sublist("Sweeps");
  sweeps = multigrid::nodal_cycle_list(1, 1).sublist("Factories").sublist("Sweeps");
  TEST_ASSERT(has(complaint([&] { blocked_cycle(wall, list); }), "cannot work on a matrix"));
}

}  // namespace
