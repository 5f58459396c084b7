#include <Teuchos_UnitTestHarness.hpp>
#include <array>
#include <cmath>

#include "tunica/base/trilinos.hpp"
#include "tunica/linear/direct/direct_factor.hpp"
#include "tunica/linear/direct/level_widths.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;

/// Points of a box with so many along each axis, each coupled to its neighbours along the axes.
Teuchos::RCP<CrsMatrix> grid(const std::array<int, 3>& size) {
  const GlobalOrdinal n = static_cast<GlobalOrdinal>(size[0]) * size[1] * size[2];
  const Teuchos::RCP<const Map> map = Teuchos::rcp(new Map(n, 0, test::world()));
  const auto A = Teuchos::rcp(new CrsMatrix(map, 7));
  for (const GlobalOrdinal row : global_numbers(*map)) {
    A->insertGlobalValues(row, Teuchos::tuple<GlobalOrdinal>(row), Teuchos::tuple(6.5));
    GlobalOrdinal stride = 1;
    for (const int along : size) {
      const auto place = row / stride % along;
      for (const int step : {-1, 1})
        if (place + step >= 0 && place + step < along)
          A->insertGlobalValues(row, Teuchos::tuple<GlobalOrdinal>(row + step * stride),
                                Teuchos::tuple(-1.0));
      stride *= along;
    }
  }
  A->fillComplete();
  return A;
}

/// |b − A x| / |b| for b = 1
double residual_of(const CrsMatrix& A, linear::DirectFactor& factor) {
  factor.refresh();
  Vector b(A.getRowMap()), x(A.getRowMap());
  b.putScalar(1.0);
  factor.apply(b, x);
  Vector r(b, Teuchos::Copy);
  A.apply(x, r, Teuchos::NO_TRANS, -1.0, 1.0);
  return r.norm2() / b.norm2();
}

TEUCHOS_UNIT_TEST(elimination, a_chain_has_factors_without_fill) {
  const auto A = grid({400, 1, 1});
  const double bytes = linear::DirectFactor(A).expected_bytes();
  // 3 n − 2 entries of factors without fill; fronts hold some zeros beside them.
  TEST_COMPARE(bytes, >=, 8.0 * (3 * 400 - 2));
  TEST_COMPARE(bytes, <, 8.0 * 20 * 400);
}

// Operations for n unknowns in the best order: some n^(3/2) in the plane, n² in space [Ge73]; here
// the constants are between 1 and 30.
TEUCHOS_UNIT_TEST(elimination, a_limit_tells_the_plane_from_space) {
  const auto plane = grid({45, 45, 1}), space = grid({12, 13, 13});  // 2025 and 2028 unknowns
  const double limit = 300.0;  // 30 n^(3/2) are 270 per entry in the plane; n² 300 in space
  linear::DirectFactor factor(plane, limit);
  TEST_COMPARE(residual_of(*plane, factor), <, 1e-12);
  TEST_THROW(linear::DirectFactor(space, limit), linear::SetupFailure);
  linear::DirectFactor at_any_cost(space);
  TEST_COMPARE(residual_of(*space, at_any_cost), <, 1e-12);
}

/// Operations for the factors of A, by both orders or by the first alone; solves with them.
double operations(const Teuchos::RCP<const CrsMatrix>& A, bool dissects, double& residual) {
  smoothers::SparseLu lu(
      A, [](const auto& alone) { return std::make_unique<linear::MultifrontalLu>(alone); });
  const double found = lu.told([dissects](smoothers::Factors& factors) {
    auto& mumps = dynamic_cast<linear::MultifrontalLu&>(factors);
    if (dissects) mumps.dissect();
    return mumps.expected_operations();
  });
  lu.refactor();
  Vector b(A->getRowMap()), x(A->getRowMap());
  b.putScalar(1.0);
  lu.solve(b, x);
  A->apply(x, b, Teuchos::NO_TRANS, -1.0, 1.0);
  residual = b.norm2() / std::sqrt(static_cast<double>(A->getGlobalNumRows()));
  return found;
}

TEUCHOS_UNIT_TEST(elimination, nested_dissection_is_taken_where_it_is_better) {
  const auto A = grid({17, 17, 17});
  double of_first = 1.0, of_both = 1.0;
  TEST_COMPARE(operations(A, true, of_both), <, operations(A, false, of_first));
  TEST_COMPARE(of_first, <, 1e-12);
  TEST_COMPARE(of_both, <, 1e-12);
}

/// The entries of grid() on one rank, behind so many rows that hold only their diagonal.
linear::Entries entries_of_grid(const std::array<int, 3>& size, int lone) {
  linear::Entries entries;
  const auto add = [&](int i, int j) {
    entries.rows.push_back(i + 1);
    entries.columns.push_back(j + 1);
  };
  for (int i = 0; i < lone; ++i) add(i, i);
  for (int i = 0; i < size[0] * size[1] * size[2]; ++i) {
    add(lone + i, lone + i);
    int stride = 1;
    for (const int along : size) {
      const int place = i / stride % along;
      if (place > 0) add(lone + i, lone + i - stride);
      if (place + 1 < along) add(lone + i, lone + i + stride);
      stride *= along;
    }
  }
  return entries;
}

// Points at the same distance from a corner, i + j + k, are as many in the middle of a long box as
// in a section across it.
TEUCHOS_UNIT_TEST(elimination, a_long_box_is_as_wide_as_its_section) {
  for (const int lone : {0, 7})
    TEST_EQUALITY(linear::narrowest_level(lone + 40 * 9 * 8, entries_of_grid({40, 9, 8}, lone)),
                  72.0);
  TEST_EQUALITY(linear::narrowest_level(5, entries_of_grid({1, 1, 1}, 4)), 0.0);
}

TEUCHOS_UNIT_TEST(elimination, what_no_order_makes_small_is_not_ordered) {
  std::string reason;
  try {
    linear::DirectFactor(grid({24, 24, 24}), 100.0);
  } catch (const linear::SetupFailure& failure) {
    reason = failure.what();
  }
  TEST_ASSERT(reason.find("operations per entry or more, and 100 are permitted") !=
              std::string::npos);
  const auto space = grid({24, 24, 24});
  smoothers::SparseLu lu(space, [](const auto& alone) {
    return std::make_unique<linear::MultifrontalLu>(
        alone, 100.0 * static_cast<double>(alone->getGlobalNumEntries()));
  });
  const auto answer = [&](const auto& question) {
    return lu.told([&](smoothers::Factors& factors) {
      return question(dynamic_cast<linear::MultifrontalLu&>(factors));
    });
  };
  TEST_EQUALITY(answer([](auto& mumps) { return mumps.is_ordered() ? 1.0 : 0.0; }), 0.0);
  // No more than there are.
  const double least = answer([](auto& mumps) { return mumps.expected_operations(); });
  double unused = 1.0;
  TEST_COMPARE(least, <, operations(space, true, unused));
}

// K = [0 I; I 0]: a diagonal of zeros alone
TEUCHOS_UNIT_TEST(elimination, pivots_stand_beside_a_diagonal_of_zeros) {
  const GlobalOrdinal n = 40;
  const Teuchos::RCP<const Map> map = Teuchos::rcp(new Map(n, 0, test::world()));
  const auto K = Teuchos::rcp(new CrsMatrix(map, 2));
  for (const GlobalOrdinal row : global_numbers(*map))
    K->insertGlobalValues(row, Teuchos::tuple<GlobalOrdinal>(row, (row + n / 2) % n),
                          Teuchos::tuple(0.0, 1.0));
  K->fillComplete();
  linear::DirectFactor factor(K);
  TEST_COMPARE(residual_of(*K, factor), <, 1e-14);
}

TEUCHOS_UNIT_TEST(elimination, a_singular_matrix_is_a_failed_set_up) {
  const auto A = grid({5, 5, 1});
  A->resumeFill();
  A->setAllToScalar(0.0);
  A->fillComplete();
  linear::DirectFactor factor(A);
  TEST_THROW(factor.refresh(), linear::SetupFailure);
}

}  // namespace
