#include "tunica/linear/gcr.hpp"

#include <BelosLinearProblem.hpp>
#include <BelosTpetraAdapter.hpp>
#include <Teuchos_BLAS.hpp>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "tunica/base/reduce.hpp"
#include "tunica/base/stop_signals.hpp"
#include "tunica/io/progress.hpp"
#include "tunica/linear/solvers/stagnation.hpp"

namespace tunica::linear {

namespace {

double norm(const MultiVector& v) {
  double size = 0.0;
  v.norm2(Teuchos::ArrayView<double>(&size, 1));
  return size;
}

using Columns = std::vector<Teuchos::RCP<MultiVector>>;

/// Iterations for nothing, one after the other, before it is ended.
constexpr int most_standing = 3;

/// |r|² behind an iteration against that before, up to which it is foretold.
constexpr double least_foretold = 1e-10;

/// Entries that stay in the nearest cache while all columns pass over them.
constexpr int piece = 1024;

/// Qᵀ v of the columns, of the rows of this rank.
std::vector<double> local_products(const Columns& Q, const MultiVector& v) {
  const Teuchos::BLAS<int, double> blas;
  const int n = static_cast<int>(v.getLocalLength());
  const double* values = v.getLocalViewHost(read_only).data();
  std::vector<const double*> columns;
  for (const auto& q : Q) columns.push_back(q->getLocalViewHost(read_only).data());
  std::vector<double> products(columns.size(), 0.0);
  for (int a = 0; a < n; a += piece)
    for (std::size_t i = 0; i < columns.size(); ++i)
      products[i] += blas.DOT(std::min(piece, n - a), columns[i] + a, 1, values + a, 1);
  return products;
}

double local_product(const MultiVector& v, const MultiVector& w) {
  const Teuchos::BLAS<int, double> blas;
  return blas.DOT(static_cast<int>(v.getLocalLength()), v.getLocalViewHost(read_only).data(), 1,
                  w.getLocalViewHost(read_only).data(), 1);
}

/// v_k ← v_k + s Z c_k, by the columns. c_k may lack the last numbers, which are zero.
void add_columns(const Columns& Z, double s, const std::vector<std::vector<double>>& c,
                 const Columns& V) {
  const Teuchos::BLAS<int, double> blas;
  std::vector<const double*> from;
  std::vector<double*> to;
  for (const auto& z : Z) from.push_back(z->getLocalViewHost(read_only).data());
  for (const auto& v : V) to.push_back(v->getLocalViewHost(read_write).data());
  const int n = V.empty() ? 0 : static_cast<int>(V.front()->getLocalLength());
  for (int a = 0; a < n; a += piece)
    for (std::size_t k = 0; k < to.size(); ++k)
      for (std::size_t i = 0; i < c[k].size(); ++i)
        blas.AXPY(std::min(piece, n - a), s * c[k][i], from[i] + a, 1, to[k] + a, 1);
}

/// v ← v + s Z c.
void add_columns(const Columns& Z, double s, const std::vector<double>& c, MultiVector& v) {
  add_columns(Z, s, {c}, {Teuchos::rcpFromRef(v)});
}

}  // namespace

// A (Z₂ − Z₁ R₁₁⁻¹ R₁₂) = Q₂ R₂₂, of the last and the others
void Directions::keep_last(int number) {
  const int dropped = size() - number;
  if (dropped <= 0) return;
  std::vector<std::vector<double>> of_dropped;
  for (int k = dropped; k < size(); ++k) {
    of_dropped.push_back(solved({r_[k].begin(), r_[k].begin() + dropped}));
    r_[k].erase(r_[k].begin(), r_[k].begin() + dropped);
  }
  const Columns first(z_.begin(), z_.begin() + dropped);
  for (Columns* columns : {&z_, &q_}) columns->erase(columns->begin(), columns->begin() + dropped);
  r_.erase(r_.begin(), r_.begin() + dropped);
  add_columns(first, -1.0, of_dropped, z_);
}

void Directions::keep_first(int number) {
  if (size() <= number) return;
  for (Columns* columns : {&z_, &q_}) columns->resize(number);
  r_.resize(number);
}

// q ← q − Q Qᵀ q, and again where no more than half of |q|² is left: round-off then leaves a part
// of Q that counts [DGKS]. Each pass is one message, which takes along products with q as it is
// before; r is orthogonal to Q, so that qᵀ r stays.
Directions::Added Directions::add(const Teuchos::RCP<MultiVector>& z,
                                  const Teuchos::RCP<MultiVector>& q, const MultiVector& r,
                                  double vote) {
  Added added;
  double before = 0.0, square = 0.0;
  const std::size_t n = q_.size();
  std::vector<double> all(n, 0.0);
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<double> c = local_products(q_, *q);
    c.insert(c.end(), {local_product(*q, *q), local_product(*q, r), local_product(r, r), vote});
    c = global_sum(*r.getMap()->getComm(), c);  // c = Qᵀ q, qᵀ q, qᵀ r, rᵀ r
    const double present = c[n];
    added.product = c[n + 1];
    added.square_of_r = c[n + 2];
    added.votes = c[n + 3];
    c.resize(n);
    if (pass == 0) before = present;
    square = present;
    for (const double of_q : c) square -= of_q * of_q;
    for (std::size_t i = 0; i < n; ++i) all[i] += c[i];
    add_columns(q_, -1.0, c, *q);  // q ← q − Q c
    if (square > 0.5 * present) break;
  }
  // Nothing but round-off is left: q lies in the span of Q.
  added.is_new = square > 1e-20 * before;
  if (!added.is_new) return added;
  const double length = std::sqrt(square);
  added.product /= length;
  q->scale(1.0 / length);
  z_.push_back(z);
  q_.push_back(q);
  all.push_back(length);  // A z = Q c + |q| q
  r_.push_back(std::move(all));
  return added;
}

std::vector<double> Directions::solved(std::vector<double> c) const {
  for (std::size_t k = c.size(); k-- > 0;) {
    c[k] /= r_[k][k];
    for (std::size_t i = 0; i < k; ++i) c[i] -= r_[k][i] * c[k];
  }
  return c;
}

void Directions::add_to(MultiVector& x, const std::vector<double>& c) const {
  add_columns(z_, 1.0, solved(c), x);
}

void Directions::minimise(MultiVector& r, MultiVector& x) const {
  const std::vector<double> c = global_sum(*r.getMap()->getComm(), local_products(q_, r));
  add_to(x, c);
  add_columns(q_, -1.0, c, r);
}

Gcr::Gcr(const Teuchos::RCP<Teuchos::ParameterList>& list) { setParameters(list); }

Teuchos::RCP<Belos::SolverManager<Scalar, MultiVector, Operator>> Gcr::clone() const {
  return Teuchos::rcp(new Gcr(Teuchos::rcp(new Teuchos::ParameterList(*list_))));
}

Teuchos::RCP<const Teuchos::ParameterList> Gcr::getValidParameters() const {
  const auto valid = Teuchos::rcp(new Teuchos::ParameterList("GCR"));
  valid->set("Convergence Tolerance", 1e-8, "|r| / |b| to be reached");
  valid->set("Maximum Iterations", 1000, "cap on the iterations");
  valid->set("Num Blocks", 200, "directions kept between restarts");
  valid->set("Recycled Directions", Teuchos::RCP<Directions>(), "of this matrix; null: none");
  valid->set("Num Recycled Blocks", 0, "directions left there");
  valid->set("Stagnation", Teuchos::RCP<StagnationRule>(), "when it is given up; null: never");
  valid->set("Maximum Restarts", 1000, "not used: the cap on the iterations ends the method");
  return valid;
}

void Gcr::setParameters(const Teuchos::RCP<Teuchos::ParameterList>& list) {
  list_ = list.is_null() ? Teuchos::rcp(new Teuchos::ParameterList("GCR")) : list;
  list_->validateParametersAndSetDefaults(*getValidParameters());
}

// r = b − A x, and x ← x + Z R⁻¹ Qᵀ r of the recycled directions.
void Gcr::begin(const Directions& basis, MultiVector& r, MultiVector& x) {
  if (!(norm(x) == 0.0)) {
    problem_->getOperator()->apply(x, r);
    r.update(1.0, *problem_->getRHS(), -1.0);
  }
  scale_ = norm(*problem_->getRHS());
  relative_residual_ = scale_ == 0.0 ? 0.0 : norm(r) / scale_;
  if (basis.size() > 0 && relative_residual_ > list_->get<double>("Convergence Tolerance")) {
    basis.minimise(r, x);
    relative_residual_ = norm(r) / scale_;
  }
}

// From recycled directions on, new ones until |r| is small. After "Num Blocks" of them the basis is
// dropped. A solve of one or two iterations leaves no new directions: there P is good enough by
// itself.
Belos::ReturnType Gcr::solve() {
  const double tolerance = list_->get<double>("Convergence Tolerance");
  const int cap = list_->get<int>("Maximum Iterations");
  const int kept = list_->get<int>("Num Blocks");
  MultiVector& x = *problem_->getLHS();
  MultiVector r(*problem_->getRHS(), Teuchos::Copy);
  const auto recycled = list_->get<Teuchos::RCP<Directions>>("Recycled Directions");
  Directions basis;
  if (!recycled.is_null()) std::swap(basis, *recycled);
  const int n_recycled = basis.size();
  begin(basis, r, x);
  const auto stagnation = list_->get<Teuchos::RCP<StagnationRule>>("Stagnation");
  std::vector<double> history{relative_residual_}, products;
  int standing = 0;
  for (iterations_ = 0; relative_residual_ > tolerance && iterations_ < cap;) {
    if (basis.size() >= kept) {
      basis.add_to(x, products);
      basis.clear();
      products.clear();
    }
    const bool stands = standing > 0 && basis.size() > 0;
    const MultiVector& source = stands ? basis.last_image() : r;
    standing = iterate(source, basis, r, products) ? 0 : standing + 1;
    if (standing > most_standing || !std::isfinite(relative_residual_)) break;
    history.push_back(relative_residual_);
    has_stagnated_ = !stagnation.is_null() && relative_residual_ > tolerance &&
                     stagnation->gives_up(history, tolerance);
    if (has_stagnated_) break;
  }
  basis.add_to(x, products);
  if (!recycled.is_null()) {
    if (iterations_ < 3) basis.keep_first(n_recycled);
    basis.keep_last(list_->get<int>("Num Recycled Blocks"));
    std::swap(basis, *recycled);
  }
  return relative_residual_ <= tolerance ? Belos::Converged : Belos::Unconverged;
}

std::string Gcr::how_far() const {
  std::ostringstream text;
  text.precision(2);
  text << "GCR iteration " << iterations_ << ", relative residual " << relative_residual_;
  return text.str();
}

bool Gcr::iterate(const MultiVector& source, Directions& basis, MultiVector& r,
                  std::vector<double>& products) {
  ++iterations_;
  const auto z = Teuchos::rcp(new MultiVector(r.getMap(), 1));
  const auto q = Teuchos::rcp(new MultiVector(r.getMap(), 1));
  {
    const io::ProgressScope scope(how_far());  // of solves within P and A
    if (problem_->getRightPrec().is_null())
      z->assign(source);
    else
      problem_->getRightPrec()->apply(source, *z);  // z = P⁻¹ r
    problem_->getOperator()->apply(*z, *q);         // q = A z
  }
  const auto added = basis.add(z, q, r, is_stop_urgent() ? 1.0 : 0.0);
  if (added.votes > 0.0) stop_if_urgent(*r.getMap()->getComm());
  if (!added.is_new) return false;
  const double alpha = added.product;
  products.resize(basis.size() - 1, 0.0);  // x has what the recycled ones give
  products.push_back(alpha);
  r.update(-alpha, *q, 1.0);  // r ← r − (qᵀr) q
  // |r − (qᵀr) q|² = |r|² − (qᵀr)², where round-off leaves six digits of it.
  const double before = added.square_of_r, after = before - alpha * alpha;
  relative_residual_ = (after > least_foretold * before ? std::sqrt(after) : norm(r)) / scale_;
  io::report_progress([this] { return how_far(); });
  // Else stagnation, or not a number.
  return relative_residual_ < std::sqrt(before) / scale_ * (1.0 - 1e-12);
}

}  // namespace tunica::linear
