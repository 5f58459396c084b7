#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"
#include "tunica/smoothers/braess_sarazin/braess_sarazin.hpp"
#include "tunica/smoothers/braess_sarazin/mixed_blocks.hpp"
#include "tunica/smoothers/braess_sarazin/ritz_values.hpp"
#include "unit/algebra/distance.hpp"
#include "unit/smoothers/wall_matrix.hpp"

namespace {

using namespace tunica;
using test::distance;
using test::WallMatrix;
using test::world;

/// |x| after so many sweeps for K x = 0 against |x| before.
double growth(const WallMatrix& wall, double scaling, int sweeps) {
  smoothers::BraessSarazinOptions options;
  options.scaling = scaling;
  options.sweeps = sweeps;
  options.schur = "direct";
  Vector x = wall.scattered(4), zero(x.getMap());
  const double before = x.norm2();
  smoothers::BraessSarazin(*wall.K(), {}, options).smooth(zero, x);
  return x.norm2() / before;
}

/// A copy whose first row, which is one of the first rank, has no entry but zeros.
CrsMatrix zero_on_one_rank(const WallMatrix& wall) {
  CrsMatrix K(*wall.K(), Teuchos::Copy);
  K.resumeFill();
  if (K.getRowMap()->getComm()->getRank() == 0) {
    auto row = K.getLocalMatrixHost().row(0);
    for (int k = 0; k < row.length; ++k) row.value(k) = 0.0;
  }
  K.fillComplete(K.getDomainMap(), K.getRangeMap());
  return K;
}

TEUCHOS_UNIT_TEST(mixed_blocks, are_those_that_were_merged) {
  const WallMatrix wall;
  const smoothers::MixedBlocks blocks(*wall.K(), {});
  const fields::BlockOperator& K = wall.jacobian.K;
  const auto x = test::scattered(wall.mesh(), 1);
  const auto product = [](const CrsMatrix& matrix, const Vector& v) {
    Vector result(matrix.getRangeMap());
    matrix.apply(v, result);
    return result;
  };
  TEST_COMPARE(distance(product(*blocks.B1T, x[1]), product(*K(0, 1), x[1])), <, 1e-14);
  TEST_COMPARE(distance(product(*blocks.B2, x[0]), product(*K(1, 0), x[0])), <, 1e-14);
  TEST_COMPARE(distance(product(*blocks.mC, x[1]), product(*K(1, 1), x[1])), <, 1e-14);
  Vector diagonal(K(0, 0)->getRowMap());
  K(0, 0)->getLocalDiagCopy(diagonal);
  TEST_EQUALITY(distance(*blocks.diagonal, diagonal), 0.0);
}

TEUCHOS_UNIT_TEST(braess_sarazin, a_zero_on_the_diagonal_of_one_rank_is_refused_by_all) {
  const WallMatrix wall;
  TEST_THROW(smoothers::BraessSarazin(zero_on_one_rank(wall), {}, {}), std::runtime_error);
}

TEUCHOS_UNIT_TEST(braess_sarazin, the_scaling_of_the_spectrum_converges_where_one_does_not) {
  const WallMatrix wall;
  TEST_COMPARE(growth(wall, 1.0, 40), >, 100.0);
  TEST_COMPARE(growth(wall, 0.0, 40), <, 1.0);
}

TEUCHOS_UNIT_TEST(ritz_values, are_exact_where_the_space_is_invariant) {
  // Turned by pairs: eigenvalues 1 ± 2i, and no other
  const auto map = Teuchos::rcp(new const Map(2 * 7 * world()->getSize(), 2 * 7, 0, world()));
  const auto values = smoothers::ritz_values(
      map,
      [](const Vector& x, Vector& y) {
        const auto from = x.getLocalViewHost(read_only);
        const auto to = y.getLocalViewHost(overwrite_all);
        for (std::size_t i = 0; i < from.extent(0); i += 2) {
          to(i, 0) = from(i, 0) - 2.0 * from(i + 1, 0);
          to(i + 1, 0) = 2.0 * from(i, 0) + from(i + 1, 0);
        }
      },
      5);
  TEST_EQUALITY(values.size(), 2);
  for (const std::complex<double>& value : values) {
    TEST_FLOATING_EQUALITY(value.real(), 1.0, 1e-12);
    TEST_FLOATING_EQUALITY(std::abs(value.imag()), 2.0, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(ritz_values, find_the_largest_of_many) {
  // A diagonal with 1 to 2 and a single 4
  const auto map = Teuchos::rcp(new const Map(100, 0, world()));
  const auto values = smoothers::ritz_values(
      map,
      [&](const Vector& x, Vector& y) {
        const auto from = x.getLocalViewHost(read_only);
        const auto to = y.getLocalViewHost(overwrite_all);
        for (std::size_t i = 0; i < from.extent(0); ++i) {
          const auto number = static_cast<double>(map->getGlobalElement(static_cast<int>(i)));
          to(i, 0) = (number == 70.0 ? 4.0 : 1.0 + 0.01 * number) * from(i, 0);
        }
      },
      10);
  double largest = 0.0;
  for (const std::complex<double>& value : values) largest = std::max(largest, std::abs(value));
  TEST_EQUALITY(values.size(), 10);
  TEST_FLOATING_EQUALITY(largest, 4.0, 1e-6);
}

TEUCHOS_UNIT_TEST(mixed_blocks, parts_of_vectors_come_apart_and_together) {
  const WallMatrix wall;
  const smoothers::MixedBlocks blocks(*wall.K(), {});
  const Vector all = wall.scattered(2);
  Vector u(blocks.diagonal->getMap()), p(blocks.mC->getRowMap());
  blocks.split(all, u, p);
  Vector again(all, Teuchos::Copy);
  blocks.add(-1.0, u, p, again);
  TEST_EQUALITY(again.norm2(), 0.0);
}

TEUCHOS_UNIT_TEST(braess_sarazin, an_exact_sweep_solves_with_the_diagonal_in_the_place_of_A) {
  const WallMatrix wall;
  smoothers::BraessSarazinOptions options;
  options.scaling = 2.0;
  options.schur = "direct";
  options.damping = 0.5;
  const smoothers::BraessSarazin smoother(*wall.K(), {}, options);
  const Vector b = wall.scattered(3);
  Vector x(b.getMap());
  smoother.smooth(b, x);
  x.scale(1.0 / options.damping);
  const smoothers::MixedBlocks blocks(*wall.K(), {});
  Vector u(blocks.diagonal->getMap()), p(blocks.mC->getRowMap()), b_u(u.getMap()), b_p(p.getMap());
  blocks.split(x, u, p);
  blocks.split(b, b_u, b_p);
  Vector r_u(u.getMap()), r_p(p.getMap());
  r_u.elementWiseMultiply(options.scaling, *blocks.diagonal, u, 0.0);
  for (std::size_t i = 0; i < blocks.is_uncovered.size(); ++i)  // fixed displacements
    if (blocks.is_uncovered[i])
      r_u.replaceLocalValue(i, blocks.diagonal->getData()[i] * u.getData()[i]);
  blocks.B1T->apply(p, r_u, Teuchos::NO_TRANS, 1.0, 1.0);
  blocks.B2->apply(u, r_p);
  blocks.mC->apply(p, r_p, Teuchos::NO_TRANS, 1.0, 1.0);
  TEST_COMPARE(distance(r_u, b_u), <, 1e-9);
  TEST_COMPARE(distance(r_p, b_p), <, 1e-9);
}

TEUCHOS_UNIT_TEST(braess_sarazin, a_solution_stays_and_rough_inverses_of_S_come_near_it) {
  const WallMatrix wall;
  const Vector x = wall.scattered(4);
  Vector b(x.getMap());
  wall.K()->apply(x, b);
  for (const std::string schur : {"gauss-seidel", "chebyshev", "multigrid", "direct"}) {
    smoothers::BraessSarazinOptions options;
    options.schur = schur;
    options.sweeps = 60;
    const smoothers::BraessSarazin smoother(*wall.K(), {}, options);
    Vector kept(x, Teuchos::Copy), found(x.getMap()), r(b, Teuchos::Copy);
    smoother.smooth(b, kept);
    TEST_COMPARE(distance(kept, x), <, 1e-10);
    smoother.smooth(b, found);
    wall.K()->apply(found, r, Teuchos::NO_TRANS, -1.0, 1.0);
    out << schur << ": " << r.norm2() / b.norm2() << "\n";
    TEST_COMPARE(r.norm2(), <, 0.3 * b.norm2());  // Chebyshev of degree 2 is the roughest
  }
}

TEUCHOS_UNIT_TEST(braess_sarazin, slips_in_its_list_are_refused) {
  const auto message_of = [](const std::string& key, const std::string& value) -> std::string {
    Teuchos::ParameterList list = multigrid::mixed_cycle_list(1);
    Teuchos::ParameterList& sweeps = list.sublist("Factories").sublist("Sweeps");
    sweeps = Teuchos::ParameterList();
    sweeps.set("factory", "NodalBraessSarazinSmoother").set(key, value);
    try {
      multigrid::check_cycle_list(list);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  TEST_EQUALITY(message_of("schur", "direct"), "");
  TEST_ASSERT(message_of("schur", "exact").find("\"gauss-seidel\"") != std::string::npos);
  TEST_ASSERT(message_of("shur", "direct").find("\"schur\"") != std::string::npos);
}

}  // namespace
