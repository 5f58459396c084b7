#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"
#include "unit/algebra/distance.hpp"
#include "unit/smoothers/wall_matrix.hpp"

namespace {

using namespace tunica;
using test::WallMatrix;

using Sublist = std::function<void(Teuchos::ParameterList&)>;

Teuchos::ParameterList list_with(const Sublist& sweeps) {
  Teuchos::ParameterList list = multigrid::mixed_cycle_list(1);
  list.sublist("Hierarchy").set("coarse: max size", 40);
  Teuchos::ParameterList& smoother = list.sublist("Factories").sublist("Sweeps");
  smoother = Teuchos::ParameterList();
  sweeps(smoother);
  return list;
}

/// One of each kind that keeps its graphs.
std::vector<std::pair<std::string, Teuchos::ParameterList>> lists() {
  std::vector<std::pair<std::string, Teuchos::ParameterList>> all;
  const auto add = [&](const std::string& name, const Sublist& sweeps) {
    all.emplace_back(name, list_with(sweeps));
  };
  add("Vanka", [](auto& s) { s.set("factory", "VankaSmoother"); });
  for (const int fill : {0, 1})  // bounds are estimated from where the last estimate ended
    add("nodal ILU(" + std::to_string(fill) + ")", [&](auto& s) {
      s.set("factory", "NodalIluSmoother").set("fill", fill).set("spectral bound", 0.0);
    });
  for (const std::string schur : {"gauss-seidel", "chebyshev", "multigrid", "direct"})
    add("Braess-Sarazin, " + schur,
        [&](auto& s) { s.set("factory", "NodalBraessSarazinSmoother").set("schur", schur); });
  for (const int overlap : {0, 1})
    add("ILU(0), overlap " + std::to_string(overlap), [&](auto& s) {
      s.set("factory", "Ifpack2Smoother").set("type", "RILUK").set("overlap", overlap);
    });
  add("Gauss-Seidel", [](auto& s) {
    s.set("factory", "Ifpack2Smoother").set("type", "RELAXATION");
    s.sublist("ParameterList").set("relaxation: type", "Symmetric Gauss-Seidel");
  });
  all.emplace_back("scaled", all.front().second);
  all.back().second.sublist("Factories").sublist("Galerkin").set("stabilisation scaling", 2.0);
  return all;
}

double distance(const Operator& M, const Operator& N, const Vector& b) {
  Vector x(b.getMap()), y(b.getMap());
  M.apply(b, x);
  N.apply(b, y);
  return test::distance(x, y);
}

TEUCHOS_UNIT_TEST(cycle, after_a_refresh_it_is_what_a_new_one_is) {
  WallMatrix wall;
  const auto nodes = Teuchos::rcp(new multigrid::MixedCoarsening(*wall.jacobian.K.space()));
  const Vector b = wall.scattered(5);
  for (const auto& [name, list] : lists()) {
    wall.jacobian.set(0.005);
    multigrid::Cycle cycle(wall.K(), nodes, list);
    TEST_COMPARE(cycle.levels().unknowns.size(), >=, 2);
    TEST_ASSERT(cycle.keeps_graphs());
    const multigrid::Cycle before(Teuchos::rcp(new CrsMatrix(*wall.K(), Teuchos::Copy)), nodes,
                                  list);
    wall.jacobian.set(0.03);
    for (int again = 0; again < 2; ++again) cycle.refresh();
    const multigrid::Cycle fresh(wall.K(), nodes, list);
    out << name << ": " << distance(cycle, fresh, b) << ", " << distance(before, fresh, b) << "\n";
    // Chebyshev's bounds come from a start by chance, each time another.
    const bool is_by_chance = name.find("chebyshev") != std::string::npos;
    TEST_COMPARE(distance(cycle, fresh, b), <, is_by_chance ? 0.1 : 1e-9);
    TEST_COMPARE(distance(before, fresh, b), >, 1e-4);  // the matrix did change
  }
}

/// In the first state of a run many entries of the graph are zero.
TEUCHOS_UNIT_TEST(cycle, entries_that_were_zero_at_first_may_become_others) {
  WallMatrix wall;
  const auto nodes = Teuchos::rcp(new multigrid::MixedCoarsening(*wall.jacobian.K.space()));
  const auto K = Teuchos::rcp(new CrsMatrix(*wall.K(), Teuchos::Copy));
  const auto set = [&](bool is_sparse) {
    K->resumeFill();
    {
      const auto from = wall.K()->getLocalMatrixHost(), to = K->getLocalMatrixHost();
      for (int i = 0; i < from.numRows(); ++i) {
        const GlobalOrdinal own = K->getRowMap()->getGlobalElement(i);
        auto row = to.row(i);
        for (int k = 0; k < row.length; ++k) {
          const GlobalOrdinal column = K->getColMap()->getGlobalElement(row.colidx(k));
          const bool is_kept =
              !is_sparse || own % 4 == column % 4 || own % 4 == 3 || column % 4 == 3;
          row.value(k) = is_kept ? from.row(i).value(k) : 0.0;
        }
      }
    }
    K->fillComplete(wall.K()->getDomainMap(), wall.K()->getRangeMap());
  };
  for (const auto& [name, list] : lists()) {
    if (name.find("chebyshev") != std::string::npos) continue;  // bounds by chance
    set(true);
    multigrid::Cycle cycle(K, nodes, list);
    set(false);
    cycle.refresh();
    out << name << "\n";
    TEST_COMPARE(distance(cycle, multigrid::Cycle(K, nodes, list), wall.scattered(5)), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(cycle, fill_that_one_bad_matrix_asked_for_is_given_up_again) {
  const WallMatrix wall;
  const auto nodes = Teuchos::rcp(new multigrid::MixedCoarsening(*wall.jacobian.K.space()));
  const auto K = Teuchos::rcp(new CrsMatrix(*wall.K(), Teuchos::Copy));
  const auto stretch = [&](double factor) {  // of what is beside the diagonal
    K->resumeFill();
    {
      const auto from = wall.K()->getLocalMatrixHost(), to = K->getLocalMatrixHost();
      for (int i = 0; i < from.numRows(); ++i) {
        auto row = to.row(i);
        for (int k = 0; k < row.length; ++k)
          row.value(k) = (row.colidx(k) == i ? 1.0 : factor) * from.row(i).value(k);
      }
    }
    K->fillComplete(wall.K()->getDomainMap(), wall.K()->getRangeMap());
  };
  const auto list = list_with([](auto& s) {
    s.set("factory", "NodalIluSmoother").set("spectral bound", 3.0).set("precision", "single");
  });
  const Vector b = wall.scattered(5);
  multigrid::Cycle cycle(K, nodes, list);
  const auto distance_to_new = [&] { return distance(cycle, multigrid::Cycle(K, nodes, list), b); };
  stretch(2.0);
  cycle.refresh();
  stretch(1.0);
  cycle.refresh();
  TEST_COMPARE(distance_to_new(), >,
               1e-5);  // it has the shift or the fill that the other asked for
  // A new one that recalls what this one has learnt sets up as it does.
  const std::vector<double> learnt = cycle.memory();
  multigrid::Cycle later(K, nodes, list);
  TEST_EQUALITY(later.memory().size(), 0);  // nothing yet
  later.recall(learnt);
  later.refresh();
  cycle.refresh();
  TEST_EQUALITY(distance(cycle, later, b), 0.0);
  TEST_ASSERT(cycle.memory() == later.memory());
  for (int again = 0; again < 32; ++again) cycle.refresh();
  TEST_COMPARE(distance_to_new(), <, 1e-9);
}

TEUCHOS_UNIT_TEST(cycle, lists_with_parts_of_muelu_are_set_up_anew) {
  WallMatrix wall;
  const auto nodes = Teuchos::rcp(new multigrid::MixedCoarsening(*wall.jacobian.K.space()));
  Teuchos::ParameterList list = list_with([](auto& s) { s.set("factory", "VankaSmoother"); });
  list.sublist("Factories")
      .sublist("Galerkin")
      .set("factory", "RAPFactory")
      .set("transpose: use implicit", true);
  multigrid::Cycle cycle(wall.K(), nodes, list);
  TEST_ASSERT(!cycle.keeps_graphs());
  wall.jacobian.set(0.03);
  cycle.refresh();
  TEST_COMPARE(distance(cycle, multigrid::Cycle(wall.K(), nodes, list), wall.scattered(5)), <,
               1e-12);
}

/// The space of the wall's blocks with the places of its nodes.
algebra::BlockSpace with_places(const WallMatrix& wall) {
  const fields::FieldMesh& mesh = wall.mesh();
  const auto x = Teuchos::rcp(new MultiVector(mesh.node_map, 3));
  const auto in_solid = Teuchos::rcp(new Vector(mesh.node_map));
  {
    const auto place = x->getLocalViewHost(overwrite_all);
    for (int a = 0; a < mesh.n_owned; ++a)
      for (int i = 0; i < 3; ++i) place(a, i) = mesh.x[a][i];
  }
  in_solid->putScalar(1.0);
  std::vector<algebra::Block> blocks;
  for (int b = 0; b < wall.jacobian.K.space()->n_blocks(); ++b) {
    blocks.push_back((*wall.jacobian.K.space())[b]);
    blocks.back().nodes.places = {x, in_solid};
  }
  return algebra::BlockSpace(blocks);
}

TEUCHOS_UNIT_TEST(cycle, takes_rotations_where_it_contracts_badly_without) {
  const WallMatrix wall;
  const Teuchos::RCP<CrsMatrix> K = wall.K();
  const auto nodes = Teuchos::rcp(new multigrid::MixedCoarsening(with_places(wall)));
  const auto list = [](bool has_rotations, double from) {
    Teuchos::ParameterList made = multigrid::mixed_cycle_list(1);
    made.sublist("Hierarchy").set("coarse: max size", 40);
    made.sublist("Factories")
        .sublist("Nodes")
        .set("rotations", has_rotations)
        .set("rotations from", from);
    return made;
  };
  TEST_NOTHROW(multigrid::check_cycle_list(list(true, 0.3)));
  TEST_THROW(multigrid::check_cycle_list(list(true, 1.5)), Error);
  const multigrid::Cycle without(K, nodes, list(false, 0.0)), with(K, nodes, list(true, 0.0));
  const Vector b = wall.scattered(5);
  TEST_COMPARE(distance(with, without, b), >, 1e-3);
  multigrid::Cycle cycle(K, nodes, list(true, 0.3));
  // 0.2 an iteration is good enough, and few iterations tell nothing.
  for (int solve = 0; solve < 3; ++solve) {
    cycle.note(4, std::pow(0.2, 4));
    cycle.refresh();
    TEST_ASSERT(!cycle.note(7, 0.5));
    cycle.refresh();
  }
  TEST_EQUALITY(distance(cycle, without, b), 0.0);
  TEST_ASSERT(cycle.memory().empty());
  TEST_ASSERT(!cycle.note(4, std::pow(0.4, 4)));
  TEST_ASSERT(cycle.note(4, std::pow(0.4, 4)));
  TEST_EQUALITY(distance(cycle, without, b), 0.0);  // until it is set up again
  // Nor does one that goes on from its numbers lose what it has been told.
  multigrid::Cycle later(K, nodes, list(true, 0.3));
  later.recall(cycle.memory());
  for (multigrid::Cycle* const one : {&cycle, &later}) {
    one->refresh();
    TEST_EQUALITY(distance(*one, with, b), 0.0);
    TEST_EQUALITY(one->memory().size(), 1 + 3 * one->levels().smoothers.size());
  }
}

TEUCHOS_UNIT_TEST(cycle, honours_the_factors_of_apply) {
  const WallMatrix wall;
  const auto nodes = Teuchos::rcp(new multigrid::MixedCoarsening(*wall.jacobian.K.space()));
  const multigrid::Cycle cycle(wall.K(), nodes, multigrid::mixed_cycle_list(1));
  const Vector b = wall.scattered(1);
  Vector once(b.getMap()), y = wall.scattered(2), expected(y, Teuchos::Copy);
  cycle.apply(b, once);
  expected.update(-2.0, once, 3.0);
  cycle.apply(b, y, Teuchos::NO_TRANS, -2.0, 3.0);
  y.update(-1.0, expected, 1.0);
  TEST_COMPARE(y.norm2(), <, 1e-13 * expected.norm2());
}

}  // namespace
