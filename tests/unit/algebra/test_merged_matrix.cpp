#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/algebra/merged_matrix.hpp"
#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/trilinos.hpp"
#include "unit/algebra/by_blocks.hpp"
#include "unit/linear/mixed_operator.hpp"
#include "unit/multigrid/grid.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

TEUCHOS_UNIT_TEST(merged_matrix, merge_and_split_are_inverse) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  const algebra::MergedMatrix merged(jacobian.K);
  const auto x = test::scattered(tube.wall, 1);
  auto back = test::scattered(tube.wall, 2);
  Vector all(merged.matrix()->getDomainMap());
  merged.merge(x, all);
  merged.split(all, back);
  TEST_EQUALITY(test::relative_difference(back, x), 0.0);
}

TEUCHOS_UNIT_TEST(merged_matrix, unknowns_of_a_node_stand_side_by_side) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  const algebra::MergedMatrix merged(jacobian.K);
  Vector all(merged.matrix()->getDomainMap());
  merged.merge(test::block_vector(tube.wall, [](int v, int i) { return 10.0 * v + i; }), all);
  const auto values = all.getData();
  for (int a = 0; a < tube.wall.n_owned; ++a)
    for (int i = 0; i < 4; ++i) TEST_EQUALITY(values[4 * a + i], 10.0 * tube.wall.vertex[a] + i);
}

TEUCHOS_UNIT_TEST(merged_matrix, of_blocks_follows_them_with_a_refresh) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  const algebra::BlockMatrix blocks = test::blocks_of(jacobian.K);
  algebra::MergedMatrix merged(blocks);
  TEST_ASSERT(merged.matrix() != jacobian.K.merged());
  for (const double size : {0.0, 0.005}) {
    jacobian.set(size);
    merged.refresh();
    const auto x = test::scattered(tube.wall, 1);
    algebra::BlockVector y = fields::zero_vector(tube.wall),
                         by_blocks = fields::zero_vector(tube.wall),
                         by_one = fields::zero_vector(tube.wall);
    blocks.apply(x, by_blocks);
    jacobian.K.apply(x, by_one);
    Vector all_x(merged.matrix()->getDomainMap()), all_y(merged.matrix()->getRangeMap());
    merged.merge(x, all_x);
    merged.matrix()->apply(all_x, all_y);
    merged.split(all_y, y);
    TEST_COMPARE(test::relative_difference(y, by_blocks), <, 1e-14);
    TEST_COMPARE(test::relative_difference(by_one, by_blocks), <, 1e-14);
  }
}

TEUCHOS_UNIT_TEST(merged_matrix, of_one_matrix_is_that_one) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  TEST_ASSERT(algebra::MergedMatrix(jacobian.K).matrix() == jacobian.K.merged());
  algebra::BlockMatrix K = jacobian.K;
  TEST_THROW(K.set(0, 0, K(0, 0)), std::logic_error);
}

// Rows of a grid from the last column to the first, with room to spare, are those that Tpetra
// makes.
TEUCHOS_UNIT_TEST(entry_rows, are_those_that_are_inserted_one_by_one) {
  const auto A = test::Grid{5, 4, 6, false}.laplacian(test::world());
  algebra::EntryRows entries(std::vector<std::size_t>(n_local_rows(*A), 9));
  for (std::size_t i = 0; i < n_local_rows(*A); ++i) {
    const auto row = A->getLocalMatrixHost().rowConst(static_cast<int>(i));
    for (int k = row.length - 1; k >= 0; --k)
      entries.add(i, A->getColMap()->getGlobalElement(row.colidx(k)), row.value(k));
  }
  const auto B = entries.take(A->getRowMap(), A->getDomainMap());
  TEST_EQUALITY(B->getGlobalNumEntries(), A->getGlobalNumEntries());
  bool is_same = B->getDomainMap()->isSameAs(*A->getDomainMap());
  for (const GlobalOrdinal row : global_numbers(*A->getRowMap()))
    is_same = is_same && test::row_of(*B, row) == test::row_of(*A, row);
  TEST_ASSERT(is_same);
  Vector x(A->getDomainMap()), y(A->getRangeMap()), z(y.getMap());
  x.randomize();
  A->apply(x, y);
  B->apply(x, z);
  z.update(-1.0, y, 1.0);
  TEST_COMPARE(z.normInf(), <, 1e-14 * y.normInf());
}

}  // namespace
