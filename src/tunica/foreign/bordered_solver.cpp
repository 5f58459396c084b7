#include "tunica/foreign/bordered_solver.hpp"

#include <Teuchos_LAPACK.hpp>
#include <algorithm>
#include <cmath>

#include "tunica/base/trilinos.hpp"
#include "tunica/systems/right_side.hpp"

namespace tunica::foreign {

namespace {

/// Columns are needed to more digits than any solution made of them.
constexpr double of_columns = 0.1, most_digits = 1e-10;
/// Equations of the border that are worth less than others by this factor say nothing.
constexpr double rank_bound = 1e-12;

double dot(const algebra::BlockVector& x, const algebra::BlockVector& y) {
  double sum = 0.0;
  for (int i = 0; i < x.n_blocks(); ++i) sum += x[i].dot(y[i]);
  return sum;
}

/// x_e of what holds the constants of a mode.
double held_in(const systems::ConstantMode& mode, const algebra::BlockVector& x) {
  return systems::values_at({mode.held}, x[mode.field]).front();
}

void add(double factor, const algebra::BlockVector& x, algebra::BlockVector& y) {
  for (int i = 0; i < y.n_blocks(); ++i) y[i].update(factor, x[i], 1.0);
}

/// A small matrix by columns.
struct Small {
  int rows, columns;
  std::vector<double> values = std::vector<double>(static_cast<std::size_t>(rows) * columns, 0.0);
  double& operator()(int i, int j) { return values[i + static_cast<std::size_t>(rows) * j]; }
};

/// The shortest of the x of least |A x − b|, with rows and columns brought to a largest entry of 1.
std::vector<double> least_squares(Small A, std::vector<double> b) {
  std::vector<double> of_column(A.columns, 1.0);
  const auto factor = [](double largest) { return largest > 0.0 ? 1.0 / largest : 1.0; };
  for (int j = 0; j < A.columns; ++j) {
    double largest = 0.0;
    for (int i = 0; i < A.rows; ++i) largest = std::max(largest, std::abs(A(i, j)));
    of_column[j] = factor(largest);
    for (int i = 0; i < A.rows; ++i) A(i, j) *= of_column[j];
  }
  for (int i = 0; i < A.rows; ++i) {
    double largest = 0.0;
    for (int j = 0; j < A.columns; ++j) largest = std::max(largest, std::abs(A(i, j)));
    for (int j = 0; j < A.columns; ++j) A(i, j) *= factor(largest);
    b[i] *= factor(largest);
  }
  b.resize(std::max(A.rows, A.columns), 0.0);
  std::vector<double> singular(std::min(A.rows, A.columns)), work(20 * b.size() + 100),
      unused(5 * b.size());
  int rank = 0, info = 0;
  Teuchos::LAPACK<int, double>().GELSS(A.rows, A.columns, 1, A.values.data(), A.rows, b.data(),
                                       static_cast<int>(b.size()), singular.data(), rank_bound,
                                       &rank, work.data(), static_cast<int>(work.size()),
                                       unused.data(), &info);
  if (info != 0) throw std::runtime_error("the border of the system has no least-squares solution");
  for (int j = 0; j < A.columns; ++j) b[j] *= of_column[j];
  return b;
}

}  // namespace

BorderedSolver::BorderedSolver(const systems::System& system,
                               std::unique_ptr<LinearSolver> of_inside)
    : system_(&system), inside_(std::move(of_inside)) {
  look_at_border();
}

void BorderedSolver::matrix_changed() {
  inside_->matrix_changed();
  Z_.clear();
  look_at_border();
}

std::vector<double> BorderedSolver::border_of(const algebra::BlockVector& x) const {
  return systems::values_at(system_->border, x[1]);
}

void BorderedSolver::set_border(const std::vector<double>& values, algebra::BlockVector& x) const {
  const auto to = x[1].getLocalViewHost(read_write);
  for (std::size_t k = 0; k < values.size(); ++k)
    if (const GlobalOrdinal number = system_->border[k]; x[1].getMap()->isNodeGlobalElement(number))
      to(x[1].getMap()->getLocalElement(number), 0) = values[k];
}

// Of R K C, K as it is given: the columns K C e_k and the rows (R e_k)ᵀ K of the border.
void BorderedSolver::look_at_border() {
  const systems::System& s = *system_;
  const std::vector<double> none(s.border.size(), 0.0);
  B_.clear(), C_.clear(), D_.clear();
  for (std::size_t k = 0; k < s.border.size(); ++k) {
    std::vector<double> one = none;
    one[k] = 1.0;
    algebra::BlockVector e = s.K.zero(), column = s.K.zero(), row = s.K.zero(), part = s.K.zero();
    set_border(one, e);
    e[1].elementWiseMultiply(1.0, s.scale[1], e[1], 0.0);
    s.given.apply(e, column);
    systems::take_to_rows(s, column);
    D_.push_back(border_of(column));
    set_border(none, column);
    B_.push_back(column);
    e.set_zero();
    set_border(one, e);
    e[1].elementWiseMultiply(1.0, s.row_scale[1], e[1], 0.0);
    for (int j = 0; j < row.n_blocks(); ++j) {
      s.given(1, j)->apply(e[1], part[j], Teuchos::TRANS);
      row[j].elementWiseMultiply(1.0, s.scale[j], part[j], 0.0);
      const auto values = row[j].getLocalViewHost(read_write);
      const auto known_in = s.known_in[j].getLocalViewHost(read_only);
      for (std::size_t i = 0; i < values.extent(0); ++i)
        if (known_in(i, 0) != 0.0) values(i, 0) = 0.0;
    }
    C_.push_back(row);
  }
}

// b − L (Lᵀ b)/(Lᵀ L), without the border
algebra::BlockVector BorderedSolver::solvable(const algebra::BlockVector& b) const {
  algebra::BlockVector r = system_->K.zero();
  r.assign(b);
  set_border(std::vector<double>(system_->border.size(), 0.0), r);
  for (const systems::ConstantMode& mode : system_->constants) {
    if (mode.left.is_null()) continue;
    const double size = mode.left->norm2();
    r[mode.field].update(-mode.left->dot(r[mode.field]) / (size * size), *mode.left, 1.0);
  }
  return r;
}

void BorderedSolver::find_inverse_of_columns(double tolerance, linear::SolveReport& costs) {
  std::vector<algebra::BlockVector> found;
  for (const algebra::BlockVector& column : B_) {
    algebra::BlockVector& z = found.emplace_back(system_->K.space());
    const double goal = std::max(of_columns * tolerance, most_digits);
    linear::add_costs(inside_->solve(solvable(column), z, goal), costs);
  }
  Z_ = found;
}

// λ, then α.
std::vector<double> BorderedSolver::small_solution(const algebra::BlockVector& b,
                                                   const algebra::BlockVector& y) const {
  const auto& modes = system_->constants;
  const auto n = static_cast<int>(B_.size()), n_modes = static_cast<int>(modes.size());
  Small A{n + n_modes, n + n_modes};
  std::vector<double> right(n + n_modes, 0.0);
  for (int m = 0; m < n_modes; ++m) {  // Lᵀ B λ = Lᵀ b, or that of e
    const Vector* const left = modes[m].left.get();
    for (int k = 0; k < n; ++k)
      A(m, k) = left != nullptr ? modes[m].in_columns[k] : held_in(modes[m], Z_[k]);
    if (left == nullptr)
      right[m] = held_in(modes[m], y);
    else if (modes[m].is_taken_by_border())
      right[m] = left->dot(b[modes[m].field]);
  }
  const std::vector<double> c = border_of(b);
  for (int j = 0; j < n; ++j) {  // (D − C Z) λ + C N α = c − C y
    for (int k = 0; k < n; ++k) A(n_modes + j, k) = D_[k][j] - dot(C_[j], Z_[k]);
    for (int m = 0; m < n_modes; ++m) A(n_modes + j, n + m) = modes[m].in_rows[j];
    right[n_modes + j] = c[j] - dot(C_[j], y);
  }
  return least_squares(std::move(A), std::move(right));
}

linear::SolveReport BorderedSolver::solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                                          double tolerance) {
  linear::SolveReport report = inside_->solve(solvable(b), x, tolerance);
  if (Z_.empty()) find_inverse_of_columns(tolerance, report);
  // x = y − Z λ + N α
  std::vector<double> small = small_solution(b, x);
  for (std::size_t k = 0; k < Z_.size(); ++k) add(-small[k], Z_[k], x);
  for (std::size_t m = 0; m < system_->constants.size(); ++m) {
    const systems::ConstantMode& mode = system_->constants[m];
    x[mode.field].update(small[Z_.size() + m], *mode.right, 1.0);
  }
  small.resize(Z_.size());
  set_border(small, x);
  return report;
}

std::unique_ptr<linear::LinearSolver> with_border(const systems::System& system,
                                                  std::unique_ptr<linear::LinearSolver> of_inside) {
  if (system.border.empty()) return of_inside;
  return std::make_unique<BorderedSolver>(system, std::move(of_inside));
}

}  // namespace tunica::foreign
