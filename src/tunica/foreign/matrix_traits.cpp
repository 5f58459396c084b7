#include "tunica/foreign/matrix_traits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tunica/algebra/independent_set.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/linear/solvers/conjugate_gradients.hpp"

namespace tunica::foreign {

namespace {

/// Part of the pivot B2 diag(A)⁻¹ B2ᵀ of a scalar that has to come from the vectors of its own node
/// for incomplete factors of nodes. Of flows it is nothing inside the domain, of optimal control
/// 0.8.
constexpr double enough_of_own = 0.3;

/// Conjugate gradients with the diagonal gain this factor in so many iterations where A is no
/// further from it than a mass matrix, κ(D⁻¹A) < 20 or so, on any mesh.
constexpr int few_iterations = 10;
constexpr double near_gain = 0.01;

/// Sum of a row's entries in its own component over the diagonal, from which on A is next to a
/// mass: it is 2.5 of that of linear tetrahedra and 3.4 of bricks, 0 of what is a derivative.
/// At 1.9 the fields take a third of the time away, but grow from 7 to 11 iterations where
/// multigrid takes 6.
constexpr double next_to_mass = 2.2;

/// |A y − Aᵀ y| over |A y|.
constexpr double little_convection = 0.01;

/// Largest entry on the diagonal against the smallest, up to which a coefficient is mild.
constexpr double mild = 1000.0;

/// Nodes of vectors for each scalar, beyond which scalars stand on a boundary alone.
constexpr int many_nodes = 10;

/// Values between -1 and 1 by the numbers of the rows, the same on any number of ranks.
Vector scattered_values(const Teuchos::RCP<const Map>& map) {
  Vector values(map);
  const auto view = values.getLocalViewHost(overwrite_all);
  const auto numbers = global_numbers(*map);
  for (int i = 0; i < static_cast<int>(numbers.size()); ++i)
    view(i, 0) = 2.0 * std::fmod(0.6180339887498949 * double(numbers[i] + 1), 1.0) - 1.0;
  return values;
}

}  // namespace

// b_i of all vectors and of those of the node
Pivots find_pivots(const algebra::BlockMatrix& K) {
  const auto B2 = K(1, 0)->getLocalMatrixHost(), mC = K(1, 1)->getLocalMatrixHost();
  const Map &rows = *K(1, 1)->getRowMap(), &columns = *K(1, 1)->getColMap(),
            &vectors = *K(1, 0)->getColMap();
  const int components = (*K.space())[0].components;
  Vector D(K(0, 0)->getRowMap());
  K(0, 0)->getLocalDiagCopy(D);
  const Vector on_columns = algebra::on_columns(*K(1, 0), D);
  const auto diagonal = on_columns.getLocalViewHost(read_only);
  double coupled = 0.0, with_c = 0.0, with_own = 0.0;
  for (int i = 0; i < mC.numRows(); ++i) {
    const GlobalOrdinal own = rows.getGlobalElement(i);
    double pivot = 0.0, of_own = 0.0;
    const auto b = B2.rowConst(i);
    for (int k = 0; k < b.length; ++k) {
      if (b.value(k) == 0.0) continue;  // also where A has no diagonal
      const double part = b.value(k) * b.value(k) / std::abs(diagonal(b.colidx(k), 0));
      pivot += part;
      if (vectors.getGlobalElement(b.colidx(k)) / components == own) of_own += part;
    }
    const auto c = mC.rowConst(i);
    bool has_diagonal = false;
    for (int k = 0; k < c.length; ++k)
      has_diagonal =
          has_diagonal || (columns.getGlobalElement(c.colidx(k)) == own && c.value(k) != 0.0);
    const bool is_coupled = pivot > 0.0;
    coupled += is_coupled;
    with_c += is_coupled && has_diagonal;
    with_own += is_coupled && of_own > enough_of_own * pivot;
  }
  const std::vector<double> all =
      global_sum(*K.comm(), std::vector<double>{coupled, with_c, with_own});
  return all[0] > 0.0 ? Pivots{all[1] / all[0], all[2] / all[0]} : Pivots{};
}

// A x = b with b of any kind, preconditioned by D
bool is_near_its_diagonal(const CrsMatrix& A) {
  Vector D(A.getRowMap());
  A.getLocalDiagCopy(D);
  CrsMatrix inverse(A.getRowMap(), A.getRowMap(), 1);
  const auto diagonal = D.getLocalViewHost(read_only);
  for (int i = 0; i < static_cast<int>(diagonal.extent(0)); ++i) {
    const double value = 1.0 / diagonal(i, 0);  // no number where D is zero, which ends the solve
    inverse.insertLocalValues(i, 1, &value, &i);
  }
  inverse.fillComplete();
  Vector r = scattered_values(A.getRowMap()), x(A.getRowMap());
  const double goal = near_gain * r.norm2();
  linear::conjugate_gradients(A, inverse, {goal}, few_iterations, r, x);
  return r.norm2() <= goal;
}

// Σ_j A_rj ≥ 2.2 A_rr over the unknowns j of the component of r, in most of the rows that are not
// those of known values
bool is_mostly_mass(const CrsMatrix& A, int components) {
  const auto local = A.getLocalMatrixHost();
  const Map &rows = *A.getRowMap(), &columns = *A.getColMap();
  std::vector<double> counts(2, 0.0);
  for (int r = 0; r < local.numRows(); ++r) {
    const GlobalOrdinal own = rows.getGlobalElement(r);
    const auto row = local.rowConst(r);
    double sum = 0.0, diagonal = 0.0;
    for (int k = 0; k < row.length; ++k) {
      const GlobalOrdinal other = columns.getGlobalElement(row.colidx(k));
      if (other % components == own % components) sum += row.value(k);
      if (other == own) diagonal = row.value(k);
    }
    const bool is_coupled = sum != diagonal;
    counts[0] += is_coupled;
    counts[1] += is_coupled && std::abs(sum) >= next_to_mass * std::abs(diagonal);
  }
  const std::vector<double> all = global_sum(*rows.getComm(), counts);
  return 2.0 * all[1] > all[0];
}

bool is_nearly_symmetric(const CrsMatrix& A) {
  const Vector y = scattered_values(A.getDomainMap());
  Vector Ay(A.getRangeMap()), difference(A.getDomainMap());
  A.apply(y, Ay);
  A.apply(y, difference, Teuchos::TRANS);
  difference.update(-1.0, Ay, 1.0);
  return difference.norm2() <= little_convection * Ay.norm2();
}

bool is_plain(const algebra::BlockMatrix& K) {
  const int components = (*K.space())[0].components;
  if (many_nodes * components * K(1, 1)->getGlobalNumRows() < K(0, 0)->getGlobalNumRows())
    return false;
  const auto A = K(0, 0)->getLocalMatrixHost();
  const Map &rows = *K(0, 0)->getRowMap(), &columns = *K(0, 0)->getColMap();
  double across = 0.0, within = 0.0, largest = 0.0, smallest = std::numeric_limits<double>::max();
  for (int i = 0; i < A.numRows(); ++i) {
    const GlobalOrdinal number = rows.getGlobalElement(i);
    const auto row = A.rowConst(i);
    for (int k = 0; k < row.length; ++k) {
      const GlobalOrdinal other = columns.getGlobalElement(row.colidx(k));
      (other % components == number % components ? within : across) += row.value(k) * row.value(k);
      if (other != number) continue;
      largest = std::max(largest, std::abs(row.value(k)));
      smallest = std::min(smallest, std::abs(row.value(k)));
    }
  }
  const Comm& comm = *K.comm();
  return global_sum(comm, across) < 1e-12 * global_sum(comm, within) &&
         global_max(comm, largest) < mild * global_min(comm, smallest);
}

bool are_scalars_few(const algebra::BlockMatrix& K) {
  const int components = (*K.space())[0].components;
  return 2 * components * K(1, 1)->getGlobalNumRows() < K(0, 0)->getGlobalNumRows();
}

}  // namespace tunica::foreign
