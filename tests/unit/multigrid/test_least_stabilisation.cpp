#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_Core.hpp>

#include "tunica/base/trilinos.hpp"
#include "tunica/multigrid/galerkin/least_stabilisation.hpp"

namespace {

using namespace tunica;

constexpr GlobalOrdinal n_of_ring =
    12;  // nodes of a ring, with a vector of one component and a scalar
constexpr double part_of_s = 0.4;

double edge(GlobalOrdinal node) { return node < n_of_ring / 2 ? 0.01 : 5.0; }

/// Of node i: 2 u_i − u_{i−1} − u_{i+1} + ½ (p_{i+1} − p_{i−1}), and ½ (u_{i−1} − u_{i+1}) − C p, C
/// a Laplacian with coefficients of the edges from a node to the next.
Teuchos::RCP<CrsMatrix> small_and_large_C() {
  const auto map = Teuchos::rcp(new Map(2 * n_of_ring, 0, Tpetra::getDefaultComm()));
  const auto K = Teuchos::rcp(new CrsMatrix(map, 6));
  for (const GlobalOrdinal row : global_numbers(*map)) {
    const GlobalOrdinal i = row / 2, next = (i + 1) % n_of_ring,
                        last = (i + n_of_ring - 1) % n_of_ring;
    const auto put = [&](GlobalOrdinal column, double value) {
      K->insertGlobalValues(row, Teuchos::tuple(column), Teuchos::tuple(value));
    };
    if (row % 2 == 0) {
      put(2 * i, 2.0), put(2 * last, -1.0), put(2 * next, -1.0);
      put(2 * last + 1, -0.5), put(2 * next + 1, 0.5);
    } else {
      put(2 * last, 0.5), put(2 * next, -0.5);
      put(2 * i + 1, -edge(i) - edge(last)), put(2 * last + 1, edge(last)),
          put(2 * next + 1, edge(i));
    }
  }
  K->fillComplete();
  return K;
}

double entry_at(const CrsMatrix& K, int row, GlobalOrdinal column) {
  const auto part = K.getLocalMatrixHost().rowConst(row);
  for (int k = 0; k < part.length; ++k)
    if (K.getColMap()->getGlobalElement(part.colidx(k)) == column) return part.value(k);
  return 0.0;
}

// s = 2 · ¼/2 at each node, f = 0.4 s / (c_i + c_{i−1}) = 5 where both are small, else 1
double growth_of(GlobalOrdinal node) {
  return std::max(1.0, part_of_s * 0.25 / (edge(node) + edge((node + n_of_ring - 1) % n_of_ring)));
}

TEUCHOS_UNIT_TEST(least_stabilisation, small_C_grows_and_rows_add_up_to_what_they_did) {
  const auto before = small_and_large_C(), after = small_and_large_C();
  multigrid::enlarge_stabilisation(*after, algebra::DofLayout({1, 1}), part_of_s);
  TEST_FLOATING_EQUALITY(growth_of(2), 5.0, 1e-14);
  for (int row = 0; row < static_cast<int>(n_local_rows(*after)); ++row) {
    const GlobalOrdinal number = after->getRowMap()->getGlobalElement(row), i = number / 2;
    const GlobalOrdinal next = (i + 1) % n_of_ring, last = (i + n_of_ring - 1) % n_of_ring;
    for (GlobalOrdinal column = 0; column < 2 * n_of_ring; ++column) {
      if (number % 2 == 1 && column % 2 == 1) continue;
      TEST_EQUALITY(entry_at(*after, row, column), entry_at(*before, row, column));
    }
    if (number % 2 == 0) continue;
    const double to_next = 0.5 * (growth_of(i) + growth_of(next)) * edge(i),
                 to_last = 0.5 * (growth_of(i) + growth_of(last)) * edge(last);
    TEST_FLOATING_EQUALITY(entry_at(*after, row, 2 * next + 1), to_next, 1e-13);
    TEST_FLOATING_EQUALITY(entry_at(*after, row, 2 * last + 1), to_last, 1e-13);
    TEST_FLOATING_EQUALITY(entry_at(*after, row, number), -to_next - to_last, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(least_stabilisation, the_rounding_of_a_zero_stays_small) {
  const auto K = small_and_large_C();
  multigrid::enlarge_stabilisation(*K, algebra::DofLayout({1, 1}), 1e12);
  for (int row = 0; row < static_cast<int>(n_local_rows(*K)); ++row) {
    const GlobalOrdinal number = K->getRowMap()->getGlobalElement(row), i = number / 2;
    if (number % 2 == 1)
      TEST_FLOATING_EQUALITY(entry_at(*K, row, number),
                             -16.0 * (edge(i) + edge((i + n_of_ring - 1) % n_of_ring)), 1e-13);
  }
}

}  // namespace
