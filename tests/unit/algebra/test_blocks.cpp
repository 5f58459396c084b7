#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/algebra/concatenation.hpp"
#include "tunica/algebra/dof_layout.hpp"
#include "tunica/algebra/merged_matrix.hpp"
#include "tunica/base/trilinos.hpp"
#include "unit/fields/small_tube.hpp"
#include "unit/multigrid/grid.hpp"

namespace {

using namespace tunica;
using algebra::BlockMatrix;
using algebra::BlockVector;
using algebra::DofLayout;
using test::Grid;

/// Velocities and two pressures at each node of a grid. The pressures do not see each other, and
/// the second has no block on the diagonal:
///
///   K = [ L  M  M ]     L  Laplacians of each component, M  the same in its first component
///       [ 0  l  0 ]     l  a Laplacian
///       [ 0  0  0 ]
struct ThreeBlocks {
  Grid grid{4, 3, 2, true};
  Teuchos::RCP<CrsMatrix> L = grid.laplacian(test::world(), 3), l = grid.laplacian(test::world());
  Teuchos::RCP<CrsMatrix> M = Teuchos::rcp(new CrsMatrix(L->getRowMap(), 27));
  BlockMatrix K;

  ThreeBlocks() {
    for (const GlobalOrdinal node : global_numbers(*l->getRowMap())) {
      const std::vector<Scalar> ones(grid.neighbours(node).size(), 2.0);
      M->insertGlobalValues(3 * node, Teuchos::arrayViewFromVector(grid.neighbours(node)),
                            Teuchos::arrayViewFromVector(ones));
    }
    M->fillComplete(l->getRowMap(), L->getRowMap());
    K = BlockMatrix(std::make_shared<const algebra::BlockSpace>(
        std::vector<algebra::Block>{{"velocity", L->getRowMap(), 3},
                                    {"lumen pressure", l->getRowMap(), 1},
                                    {"wall pressure", l->getRowMap(), 1}}));
    K.set(0, 0, L);
    K.set(0, 1, M);
    K.set(0, 2, M);
    K.set(1, 1, l);
  }

  /// Different in every unknown, whatever the ranks.
  BlockVector vector() const {
    BlockVector x = K.zero();
    for (int b = 0; b < 3; ++b)
      for (const GlobalOrdinal number : global_numbers(*x[b].getMap()))
        x[b].replaceGlobalValue(number, 1.0 + 0.1 * static_cast<double>(number * number) + b);
    return x;
  }
};

double distance(const BlockVector& a, const BlockVector& b) {
  double sum = 0.0;
  for (int k = 0; k < a.n_blocks(); ++k) {
    Vector c(a[k], Teuchos::Copy);
    c.update(-1.0, b[k], 1.0);
    sum += c.norm1();
  }
  return sum;
}

TEUCHOS_UNIT_TEST(blocks, have_names_that_differ) {
  const ThreeBlocks three;
  TEST_EQUALITY(three.K.space()->index_of("wall pressure"), 2);
  TEST_THROW(three.K.space()->index_of("preassure"), std::invalid_argument);
  const algebra::Block block{"pressure", three.l->getRowMap(), 1};
  TEST_THROW(algebra::BlockSpace({block, block}), std::invalid_argument);
  TEST_THROW(algebra::BlockSpace({}), std::invalid_argument);
  TEST_EQUALITY(three.K.n_unknowns(), 5 * three.grid.n_nodes());
}

TEUCHOS_UNIT_TEST(blocks, a_matrix_of_other_rows_is_refused) {
  ThreeBlocks three;
  TEST_THROW(three.K.set(2, 2, three.L), std::invalid_argument);
  TEST_THROW(three.K.set(2, 0, three.M), std::invalid_argument);
}

TEUCHOS_UNIT_TEST(blocks, a_missing_block_is_zero) {
  const ThreeBlocks three;
  const BlockVector x = three.vector();
  BlockVector y = three.vector(), expected = three.K.zero();
  three.K.apply(x, y);
  three.L->apply(x[0], expected[0]);
  three.M->apply(x[1], expected[0], Teuchos::NO_TRANS, 1.0, 1.0);
  three.M->apply(x[2], expected[0], Teuchos::NO_TRANS, 1.0, 1.0);
  three.l->apply(x[1], expected[1]);
  TEST_EQUALITY(distance(y, expected), 0.0);
  TEST_EQUALITY(y[2].norm1(), 0.0);
}

TEUCHOS_UNIT_TEST(blocks, long_vectors_and_merged_ones_see_the_same_matrix) {
  const ThreeBlocks three;
  const BlockVector x = three.vector();
  BlockVector expected = three.K.zero(), by_long = three.K.zero(), by_merged = three.K.zero();
  three.K.apply(x, expected);

  const algebra::Concatenation blocks(three.K.space());
  const algebra::ConcatenatedOperator K(blocks, three.K);
  MultiVector long_x(blocks.map(), 1), long_y(blocks.map(), 1);
  blocks.gather(x, long_x);
  long_y.putScalar(1.0);
  K.apply(long_x, long_y, Teuchos::NO_TRANS, 2.0, -3.0);  // y = 2 K x − 3
  blocks.scatter(long_y, by_long);
  BlockVector scaled = three.K.zero();
  for (int b = 0; b < 3; ++b) {
    scaled[b].putScalar(-3.0);
    scaled[b].update(2.0, expected[b], 1.0);
  }
  TEST_COMPARE(distance(by_long, scaled), <, 1e-10);

  algebra::MergedMatrix merged(three.K);
  merged.refresh();
  Vector merged_x(merged.matrix()->getDomainMap()), merged_y(merged.matrix()->getRangeMap());
  merged.merge(x, merged_x);
  merged.matrix()->apply(merged_x, merged_y);
  merged.split(merged_y, by_merged);
  TEST_COMPARE(distance(by_merged, expected), <, 1e-10);
}

TEUCHOS_UNIT_TEST(dof_layout, unknowns_of_a_node_stand_block_by_block) {
  const DofLayout layout({3, 1, 2});
  TEST_EQUALITY(layout.dofs(), 6);
  const std::vector<int> blocks{0, 0, 0, 1, 2, 2};
  for (int k = 0; k < 12; ++k) {
    TEST_EQUALITY(layout.block_of(k), blocks[k % 6]);
    TEST_EQUALITY(layout.is_scalar(k), k % 6 >= 3);
    TEST_EQUALITY(layout.merged(layout.block_of(k), layout.in_block(k)), k);
  }
  TEST_EQUALITY(layout.in_block(6 + 2), 3 + 2);  // component 2 of the vector at node 1
  TEST_EQUALITY(layout.in_block(6 + 3), 1);
  TEST_EQUALITY(layout.in_block(6 + 5), 2 + 1);
}

TEUCHOS_UNIT_TEST(dof_layout, maps_of_blocks_make_the_merged_one_and_come_back) {
  const ThreeBlocks three;
  const DofLayout layout(*three.K.space());
  const auto merged = layout.merged_map(*three.K.space());
  TEST_EQUALITY(static_cast<long long>(merged->getGlobalNumElements()), 5 * three.grid.n_nodes());
  for (int b = 0; b < 3; ++b)
    TEST_ASSERT(layout.block_map(*merged, b)->isSameAs(*(*three.K.space())[b].map));
}

}  // namespace
