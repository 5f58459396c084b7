#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/algebra/products/grouped_matrix.hpp"
#include "tunica/algebra/products/sparse_product.hpp"
#include "tunica/algebra/products/triple_product.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/trilinos.hpp"
#include "unit/fields/small_tube.hpp"
#include "unit/multigrid/grid.hpp"

namespace {

using namespace tunica;
using test::Grid;

/// Every third node of a grid is coarse; the others take half of both neighbours among these.
struct Line {
  Teuchos::RCP<CrsMatrix> A = Grid{31, 1, 1, false}.laplacian(test::world());
  Teuchos::RCP<CrsMatrix> P;

  Line() {
    std::vector<GlobalOrdinal> coarse;
    for (const GlobalOrdinal i : global_numbers(*A->getRowMap()))
      if (i % 3 == 0) coarse.push_back(i / 3);
    P = Teuchos::rcp(new CrsMatrix(A->getRowMap(), 2));
    for (const GlobalOrdinal i : global_numbers(*A->getRowMap())) {
      const std::vector<GlobalOrdinal> parents = i % 3 == 0
                                                     ? std::vector<GlobalOrdinal>{i / 3}
                                                     : std::vector<GlobalOrdinal>{i / 3, i / 3 + 1};
      const std::vector<Scalar> weights(parents.size(), 1.0 / static_cast<double>(parents.size()));
      P->insertGlobalValues(i, Teuchos::arrayViewFromVector(parents),
                            Teuchos::arrayViewFromVector(weights));
    }
    P->fillComplete(map_of(coarse, test::world()), A->getRowMap());
  }

  /// Row i of A times factor(i).
  template <class Factor>
  void scale(const Factor& factor) const {
    A->resumeFill();
    const auto local = A->getLocalMatrixHost();
    for (int i = 0; i < local.numRows(); ++i) {
      auto row = local.row(i);
      for (int k = 0; k < row.length; ++k)
        row.value(k) *= factor(A->getRowMap()->getGlobalElement(i));
    }
    A->fillComplete();
  }
};

/// y = Pᵀ A P x by products with vectors.
Vector galerkin(const Line& line, const Vector& x) {
  Vector Px(line.A->getRowMap()), APx(Px.getMap()), y(x.getMap());
  line.P->apply(x, Px);
  line.A->apply(Px, APx);
  line.P->apply(APx, y, Teuchos::TRANS);
  return y;
}

double error_of(const CrsMatrix& K, const Line& line) {
  Vector x(line.P->getDomainMap()), y(x.getMap());
  for (const GlobalOrdinal i : global_numbers(*x.getMap()))
    x.replaceGlobalValue(i, 1.0 + 0.3 * static_cast<double>(i * i));
  K.apply(x, y);
  const Vector expected = galerkin(line, x);
  y.update(-1.0, expected, 1.0);
  return y.norm2() / expected.norm2();
}

TEUCHOS_UNIT_TEST(triple_product, follows_the_values_whatever_was_zero_when_it_was_made) {
  const Line line;
  const auto number = [](GlobalOrdinal i) { return 1.0 + 0.5 * static_cast<double>(i % 7); };
  line.scale([](GlobalOrdinal i) { return i % 2 == 0 ? 1.0 : 0.0; });
  algebra::TripleProduct product(*line.A, *line.P);
  for (const GlobalOrdinal i : global_numbers(*line.A->getRowMap()))
    if (i % 2 == 1)  // rows of zeros are zeros again
      for (const auto& [column, value] : test::row_of(*line.A, i)) TEST_EQUALITY(value, 0.0);
  product.refresh();
  TEST_COMPARE(error_of(*product.matrix(), line), <, 1e-14);
  line.A->resumeFill();
  line.A->setAllToScalar(1.0);
  line.A->fillComplete();
  line.scale(number);
  product.refresh();
  TEST_COMPARE(error_of(*product.matrix(), line), <, 1e-14);
}

/// Unknowns of node n: three or five, not in the order of nodes alone; so are its rows' columns.
struct Nodes {
  std::vector<int> start{0};
  explicit Nodes(int n) {
    for (int a = 0; a < n; ++a)
      start.push_back(start.back() + (a % 4 == 1 ? 5 : a % 4 == 3 ? 1 : 3));
  }
};

double number(GlobalOrdinal i, GlobalOrdinal j) {
  return std::sin(1.0 + 3.7 * static_cast<double>(i) + 0.9 * static_cast<double>(j));
}

/// Blocks of all unknowns of two nodes where they couple. Ranks meet within nodes, too.
template <class Couple>
Teuchos::RCP<CrsMatrix> blocks(const Nodes& rows, const Nodes& columns, const Couple& couple) {
  const auto map = [](int n) { return Teuchos::rcp(new Map(n, 0, test::world())); };
  const auto own = map(rows.start.back());
  const auto A = Teuchos::rcp(new CrsMatrix(own, columns.start.back()));
  for (std::size_t a = 0; a + 1 < rows.start.size(); ++a)
    for (std::size_t b = 0; b + 1 < columns.start.size(); ++b)
      if (couple(static_cast<int>(a), static_cast<int>(b)))
        for (int i = rows.start[a]; i < rows.start[a + 1]; ++i)
          for (int j = columns.start[b]; j < columns.start[b + 1]; ++j)
            // the first unknown of a node is interpolated from all, others from one each
            if (own->isNodeGlobalElement(i) &&
                (&rows == &columns || i == rows.start[a] || (i + j) % 2 == 0))
              A->insertGlobalValues(i, Teuchos::tuple<GlobalOrdinal>(j),
                                    Teuchos::tuple(number(i, j)));
  A->fillComplete(map(columns.start.back()), own);
  return A;
}

TEUCHOS_UNIT_TEST(triple_product, serves_nodes_with_any_number_of_unknowns_on_any_ranks) {
  const Nodes fine(301), coarse(101);
  const auto A =
      blocks(fine, fine, [](int a, int b) { return std::abs(a - b) < 3 || a + b == 300; });
  const auto P = blocks(fine, coarse, [](int a, int b) { return a / 3 == b || (a + 2) / 3 == b; });
  algebra::TripleProduct product(*A, *P);
  for (int again = 0; again < 2; ++again) product.refresh();
  Vector x(P->getDomainMap()), y(x.getMap()), Px(A->getRowMap()), APx(Px.getMap()),
      expected(x.getMap());
  for (const GlobalOrdinal i : global_numbers(*x.getMap()))
    x.replaceGlobalValue(i, std::cos(static_cast<double>(i * i)));
  P->apply(x, Px);
  A->apply(Px, APx);
  P->apply(APx, expected, Teuchos::TRANS);
  product.matrix()->apply(x, y);
  y.update(-1.0, expected, 1.0);
  TEST_COMPARE(y.norm2(), <, 1e-13 * expected.norm2());
}

TEUCHOS_UNIT_TEST(grouped_matrix, multiplies_as_the_matrix_does) {
  const Nodes nodes(301);
  const auto A =
      blocks(nodes, nodes, [](int a, int b) { return std::abs(a - b) < 3 || a + b == 300; });
  const algebra::GroupedMatrix grouped(A);
  MultiVector x(A->getDomainMap(), 2), y(A->getRangeMap(), 2), expected(y.getMap(), 2);
  for (const GlobalOrdinal i : global_numbers(*x.getMap()))
    for (int c = 0; c < 2; ++c)
      x.replaceGlobalValue(i, c, std::cos(static_cast<double>(i * i + c)));
  const auto check = [&](const MultiVector& from, MultiVector& to, MultiVector& reference,
                         Teuchos::ETransp mode, double alpha, double beta) {
    to.putScalar(3.0);
    reference.putScalar(3.0);
    grouped.apply(from, to, mode, alpha, beta);
    A->apply(from, reference, mode, alpha, beta);
    to.update(-1.0, reference, 1.0);
    for (std::size_t c = 0; c < to.getNumVectors(); ++c)
      TEST_COMPARE(to.getVector(c)->norm2(), <, 1e-14 * reference.getVector(c)->norm2());
  };
  check(x, y, expected, Teuchos::NO_TRANS, 1.0, 0.0);
  check(x, y, expected, Teuchos::TRANS, 1.0, 0.0);
  Vector y_1(y.getMap()), expected_1(y.getMap());
  check(*x.getVector(0), y_1, expected_1, Teuchos::NO_TRANS, 1.0, 0.0);
  check(*x.getVector(1), y_1, expected_1, Teuchos::NO_TRANS, -2.0, 0.5);
}

TEUCHOS_UNIT_TEST(sparse_product, follows_the_values_whatever_was_zero_when_it_was_made) {
  const Line line;
  line.scale([](GlobalOrdinal i) { return i % 2 == 0 ? 1.0 : 0.0; });
  algebra::SparseProduct AP(*line.A, *line.P);
  for (const double value : {0.0, 2.0}) {
    if (value > 0.0) {
      line.A->resumeFill();
      line.A->setAllToScalar(value);
      line.A->fillComplete();
    }
    AP.refresh();
    Vector x(line.P->getDomainMap()), Px(line.A->getRowMap()), y(Px.getMap()),
        expected(Px.getMap());
    for (const GlobalOrdinal i : global_numbers(*x.getMap()))
      x.replaceGlobalValue(i, 2.0 + static_cast<double>(i));
    line.P->apply(x, Px);
    line.A->apply(Px, expected);
    AP.matrix()->apply(x, y);
    y.update(-1.0, expected, 1.0);
    TEST_COMPARE(y.norm2(), <=, 1e-13 * expected.norm2());
  }
}

}  // namespace
