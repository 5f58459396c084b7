#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/algebra/sparse_product.hpp"
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
  if (test::world()->getSize() > 1) return;  // it is for one rank
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
