#include <Teuchos_UnitTestHarness.hpp>

#include "helpers.hpp"
#include "tunica/systems/node_graph.hpp"

namespace {

using namespace tunica;
using namespace tunica::systems_tests;

/// Linear elements on a grid of 5 × 4 × 3 vertices with a pressure at each, whose velocities at
/// x = 0 and at the last vertex are left out.
struct Channel {
  static constexpr int nx = 5, ny = 4, nz = 3, n = nx * ny * nz;
  std::vector<long long> vertices;  ///< of the velocities

  Channel() {
    for (int a = 0; a + 1 < n; ++a)
      if (a % nx != 0) vertices.push_back(a);
  }
  static bool are_neighbours(long long a, long long b) {
    const auto is_near = [](long long i, long long j) { return std::abs(i - j) <= 1; };
    return is_near(a % nx, b % nx) && is_near(a / nx % ny, b / nx % ny) &&
           is_near(a / nx / ny, b / nx / ny);
  }
  long long n_vectors() const { return 3 * static_cast<long long>(vertices.size()); }
  /// Of the velocity with this number.
  long long vertex(long long unknown, bool is_by_node) const {
    const auto count = static_cast<long long>(vertices.size());
    return vertices[is_by_node ? unknown / 3 : unknown % count];
  }

  // By symmetry ∫ p ∂v vanishes at the vertex itself.
  systems::Blocks blocks(bool is_by_node, bool has_c = true) const {
    const bool has_entries = world()->getRank() == 0;
    systems::RowCollector A(n_vectors(), n_vectors(), world()), B(n_vectors(), n, world()),
        C(n, n, world());
    std::vector<systems::Entry> of_a, of_b, of_c;
    for (long long u = 0; has_entries && u < n_vectors(); ++u) {
      of_a.push_back({u, u, 1.0});
      const long long a = vertex(u, is_by_node);
      for (long long b = 0; b < n; ++b)
        if (b != a && are_neighbours(a, b)) of_b.push_back({u, b, 1.0});
    }
    for (long long a = 0; has_entries && a < n; ++a)
      for (long long b = 0; b < n; ++b)
        if (a == b || (has_c && are_neighbours(a, b))) of_c.push_back({a, b, -1.0});
    A.add(of_a);
    B.add(of_b);
    C.add(of_c);
    systems::Blocks all;
    all.A = A.take();
    all.B1T = B.take();
    all.B2 = systems::transposed(all.B1T);
    all.mC = C.take();
    return all;
  }
};

TEUCHOS_UNIT_TEST(scalars_beside, are_found_where_vectors_are_left_out) {
  const Channel channel;
  const auto count = static_cast<long long>(channel.vertices.size());
  for (const bool is_by_node : {true, false}) {
    const auto beside = systems::scalars_beside(channel.blocks(is_by_node), 3, is_by_node);
    TEST_ASSERT(beside.are_known);
    const Portion mine = portion_of(count, *world());
    const std::vector<long long> expected(channel.vertices.begin() + mine.first,
                                          channel.vertices.begin() + mine.first + mine.count);
    TEST_COMPARE_ARRAYS(beside.of_node, expected);
  }
}

TEUCHOS_UNIT_TEST(scalars_beside, are_not_known_where_c_says_nothing) {
  TEST_ASSERT(!systems::scalars_beside(Channel().blocks(true, false), 3, true).are_known);
}

// Taylor and Hood's vectors stand where there are no scalars, too.
TEUCHOS_UNIT_TEST(scalars_beside, are_not_sought_where_scalars_are_fewer) {
  systems::Blocks blocks = Channel().blocks(true);
  std::swap(blocks.A, blocks.mC);
  blocks.B1T = systems::transposed(blocks.B1T);
  blocks.B2 = systems::transposed(blocks.B2);
  TEST_ASSERT(!systems::scalars_beside(blocks, 3, true).are_known);
}

}  // namespace
