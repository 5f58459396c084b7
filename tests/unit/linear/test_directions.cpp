#include <Teuchos_DefaultComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/base/trilinos.hpp"
#include "tunica/linear/gcr.hpp"

namespace {

using namespace tunica;
using Column = Teuchos::RCP<MultiVector>;

/// A = diag(1, 2, 1, 2, ...) on 40 unknowns of each rank.
class Example {
public:
  Example()
      : map_(Teuchos::rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), 40, 0,
                                  Teuchos::DefaultComm<int>::getComm()))) {}

  /// Without pattern, other numbers for each seed.
  Column vector(int seed) const {
    const auto v = Teuchos::rcp(new MultiVector(map_, 1));
    const auto values = v->getLocalViewHost(overwrite_all);
    for (int i = 0; i < 40; ++i)
      values(i, 0) = std::sin(1.0 + (12.9898 + 7.233 * seed) * global_numbers(*map_)[i]);
    return v;
  }
  Column image(const MultiVector& z) const {
    const auto q = Teuchos::rcp(new MultiVector(z, Teuchos::Copy));
    const auto values = q->getLocalViewHost(read_write);
    for (int i = 1; i < 40; i += 2) values(i, 0) *= 2.0;
    return q;
  }

private:
  Teuchos::RCP<const Map> map_;
};

double product(const MultiVector& v, const MultiVector& w) {
  double result = 0.0;
  v.dot(w, Teuchos::ArrayView<double>(&result, 1));
  return result;
}

/// Adds z and its image; returns the image as it was added.
Column add(linear::Directions& directions, const Example& example, const Column& z) {
  const Column q = example.image(*z);
  directions.add(z, q, MultiVector(z->getMap(), 1), 0.0);
  return q;
}

/// |A x + r − b| / |b|.
double error(const Example& example, const MultiVector& x, const MultiVector& r,
             const MultiVector& b) {
  const Column difference = example.image(x);
  difference->update(1.0, r, -1.0, b, 1.0);
  return std::sqrt(product(*difference, *difference) / product(b, b));
}

TEUCHOS_UNIT_TEST(directions, images_are_orthonormal_where_directions_nearly_depend) {
  const Example example;
  linear::Directions directions;
  std::vector<Column> images;
  for (int k = 0; k < 5; ++k) {
    const Column z = example.vector(0);
    z->update(1e-7, *example.vector(k), 1.0);
    images.push_back(add(directions, example, z));
  }
  TEST_EQUALITY(directions.size(), 5);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j <= i; ++j)
      TEST_COMPARE(std::abs(product(*images[i], *images[j]) - (i == j ? 1.0 : 0.0)), <, 1e-14);
  // in the span of the others there is nothing new
  add(directions, example, example.vector(0));
  TEST_EQUALITY(directions.size(), 5);
}

TEUCHOS_UNIT_TEST(directions, give_the_least_residual_also_of_those_that_are_kept) {
  const Example example;
  linear::Directions directions;
  std::vector<Column> images;
  for (int k = 0; k < 6; ++k) images.push_back(add(directions, example, example.vector(k)));
  for (const int kept : {6, 4, 2}) {
    directions.keep_last(kept);
    TEST_EQUALITY(directions.size(), kept);
    const Column b = example.vector(100 + kept);
    MultiVector r(*b, Teuchos::Copy), x(b->getMap(), 1);
    directions.minimise(r, x);
    TEST_COMPARE(error(example, x, r, *b), <, 1e-13);
    for (int k = 6 - kept; k < 6; ++k)
      TEST_COMPARE(std::abs(product(r, *images[k])), <, 1e-13 * std::sqrt(product(*b, *b)));
    // of those that were dropped something is left
    if (kept < 6) TEST_COMPARE(std::abs(product(r, *images[5 - kept])), >, 1e-6);
  }
}

}  // namespace
