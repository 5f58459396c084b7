#include "tunica/systems/null_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/systems/entry_sums.hpp"
#include "tunica/systems/right_side.hpp"

namespace tunica::systems {

namespace {

constexpr double nothing = 1e-8;  ///< files of eight digits leave 1e-9

/// Of the free unknowns of a mode, 1 in the unit of the files; scale: diagonal of C or R.
Teuchos::RCP<Vector> constant(const ConstantMode& mode, const System& system,
                              const algebra::BlockVector& scale) {
  const auto n = Teuchos::rcp(new Vector(scale[mode.field].getMap()));
  const auto numbers = global_numbers(*n->getMap());
  const int components = (*system.K.space())[mode.field].components;
  const auto known_in = system.known_in[mode.field].getLocalViewHost(read_only);
  const auto factor = scale[mode.field].getLocalViewHost(read_only);
  const auto values = n->getLocalViewHost(read_write);
  for (std::size_t k = 0; k < values.extent(0); ++k)
    if (known_in(k, 0) == 0.0 && numbers[k] % components == mode.component)
      values(k, 0) = 1.0 / factor(k, 0);
  return n;
}

/// |K n| / ||K||n||, the larger one of both fields, so that a small C is not taken for none; 1
/// where K has no entries for n.
double right_share(const algebra::BlockMatrix& K, int field, const Vector& n) {
  double largest = -1.0;
  for (int i = 0; i < K.n_blocks(); ++i) {
    Vector product(K(i, field)->getRangeMap()), size(product.getMap());
    K(i, field)->apply(n, product);
    add_magnitudes(*K(i, field), n, size);
    if (const double all = size.norm2(); all > 0.0)
      largest = std::max(largest, product.norm2() / all);
  }
  return largest < 0.0 ? 1.0 : largest;
}

/// The same of nᵀ K.
double left_share(const algebra::BlockMatrix& K, int field, const Vector& n) {
  double largest = -1.0;
  for (int j = 0; j < K.n_blocks(); ++j) {
    Vector product(K(field, j)->getDomainMap()), size(product.getMap());
    K(field, j)->apply(n, product, Teuchos::TRANS);
    add_column_magnitudes(*K(field, j), n, size);
    if (const double all = size.norm2(); all > 0.0)
      largest = std::max(largest, product.norm2() / all);
  }
  return largest < 0.0 ? 1.0 : largest;
}

/// The smallest number of an unknown of the mode.
GlobalOrdinal first_of(const Vector& n) {
  const auto values = n.getLocalViewHost(read_only);
  const auto numbers = global_numbers(*n.getMap());
  GlobalOrdinal mine = std::numeric_limits<GlobalOrdinal>::max(), first = mine;
  for (std::size_t k = 0; k < values.extent(0); ++k)
    if (values(k, 0) != 0.0) mine = std::min(mine, numbers[k]);
  Teuchos::reduceAll(*n.getMap()->getComm(), Teuchos::REDUCE_MIN, 1, &mine, &first);
  return first;
}

/// σ at one unknown, on the rank that has it.
void hold(const System& system, const ConstantMode& mode) {
  const CrsMatrix& A = *system.K(mode.field, mode.field);
  if (!A.getRowMap()->isNodeGlobalElement(mode.held)) return;
  const auto row = A.getLocalMatrixHost().row(A.getRowMap()->getLocalElement(mode.held));
  const LocalOrdinal column = A.getColMap()->getLocalElement(mode.held);
  for (int k = 0; k < row.length; ++k)
    if (row.colidx(k) == column) row.value(k) += mode.field == 1 ? -1.0 : row.value(k);
}

std::string name_of(const ConstantMode& mode, int components) {
  if (mode.field == 1) return "constant scalars";
  return components == 1 ? "constants"
                         : formatted("constant vectors of component %d", mode.component);
}

/// Numbers of the border's scalars, zero where they are rounding beside sums.
std::vector<double> at_border(const System& system, const Vector& y, const Vector& sums) {
  std::vector<double> values = values_at(system.border, y);
  const std::vector<double> sizes = values_at(system.border, sums);
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!(std::abs(values[k]) > nothing * sizes[k])) values[k] = 0.0;
  return values;
}

// Of R K C, K as it is given: C n and nᵀ B.
void look_at_border(const System& system, ConstantMode& mode) {
  if (system.border.empty()) return;
  const int f = mode.field;
  Vector n(mode.right->getMap()), y(system.K(1, 1)->getRowMap()), sums(y.getMap());
  n.elementWiseMultiply(1.0, system.scale[f], *mode.right, 0.0);
  system.given(1, f)->apply(n, y);
  add_magnitudes(*system.given(1, f), n, sums);
  y.elementWiseMultiply(1.0, system.row_scale[1], y, 0.0);
  sums.elementWiseMultiply(1.0, system.row_scale[1], sums, 0.0);
  mode.in_rows = at_border(system, y, sums);
  if (mode.left.is_null()) return;
  n.elementWiseMultiply(1.0, system.row_scale[f], *mode.left, 0.0);
  system.given(f, 1)->apply(n, y, Teuchos::TRANS);
  sums.putScalar(0.0);
  add_column_magnitudes(*system.given(f, 1), n, sums);
  y.elementWiseMultiply(1.0, system.scale[1], y, 0.0);
  sums.elementWiseMultiply(1.0, system.scale[1], sums, 0.0);
  mode.in_columns = at_border(system, y, sums);
}

int components_of(const System& system) { return (*system.K.space())[0].components; }

}  // namespace

std::vector<ConstantMode> find_constants(const System& system) {
  std::vector<ConstantMode> modes;
  if (system.K.n_blocks() > 1) modes.push_back({1, 0});
  for (int c = 0; c < components_of(system); ++c) modes.push_back({0, c});
  std::vector<ConstantMode> found;
  for (ConstantMode& mode : modes) {
    const Teuchos::RCP<Vector> right = constant(mode, system, system.scale);
    const double share = right_share(system.K, mode.field, *right);
    if (share > nothing) continue;
    mode.right = right;
    mode.held = first_of(*right);
    const Teuchos::RCP<Vector> left = constant(mode, system, system.row_scale);
    if (left_share(system.K, mode.field, *left) <= nothing) mode.left = left;
    look_at_border(system, mode);
    mode.note = "K has " + name_of(mode, components_of(system)) + " in its null space " +
                formatted("(|K 1| = %.0e): ", share) +
                (mode.is_given_by_border() ? "its border gives them"
                                           : "the solution of zero mean is taken");
    found.push_back(mode);
  }
  return found;
}

void hold_constants(System& system) {
  for (const ConstantMode& mode : system.constants) hold(system, mode);
}

std::vector<std::string> leave_out_constants(const System& system, algebra::BlockVector& b) {
  std::vector<std::string> remarks;
  const double size_of_b = norm(b);
  for (const ConstantMode& mode : system.constants) {
    if (mode.left.is_null() || mode.is_taken_by_border()) continue;
    const double nb = mode.left->dot(b[mode.field]), size = mode.left->norm2();
    b[mode.field].update(-nb / (size * size), *mode.left, 1.0);
    const double part = size_of_b > 0.0 ? std::abs(nb) / (size * size_of_b) : 0.0;
    if (part > nothing)
      remarks.push_back(
          formatted(
              "a part of %.1e of what remains of the right-hand side lies in the null space of ",
              part) +
          name_of(mode, components_of(system)) + ": no solution gives it, and it is left out");
  }
  return remarks;
}

}  // namespace tunica::systems
