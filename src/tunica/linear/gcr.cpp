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

/// v ← v + s Z c, by the columns.
void add_columns(const Columns& Z, double s, const std::vector<double>& c, MultiVector& v) {
  const Teuchos::BLAS<int, double> blas;
  const int n = static_cast<int>(v.getLocalLength());
  double* values = v.getLocalViewHost(read_write).data();
  std::vector<const double*> columns;
  for (const auto& z : Z) columns.push_back(z->getLocalViewHost(read_only).data());
  for (int a = 0; a < n; a += piece)
    for (std::size_t i = 0; i < columns.size(); ++i)
      blas.AXPY(std::min(piece, n - a), s * c[i], columns[i] + a, 1, values + a, 1);
}

}  // namespace

void Directions::keep_last(int number) {
  for (Columns* columns : {&z_, &q_})
    if (static_cast<int>(columns->size()) > number)
      columns->erase(columns->begin(), columns->end() - number);
}

void Directions::keep_first(int number) {
  for (Columns* columns : {&z_, &q_})
    if (static_cast<int>(columns->size()) > number) columns->resize(number);
}

// q ← q − Q Qᵀ q in two passes: the second takes out what round-off has left of the first. Each is
// one message, which takes along products with q as it is before the pass. What the second pass
// takes out is round-off: for |q| behind it and qᵀ r products from before serve.
Directions::Added Directions::add(const Teuchos::RCP<MultiVector>& z,
                                  const Teuchos::RCP<MultiVector>& q, const MultiVector& r,
                                  double vote) {
  Added added;
  double before = 0.0, square = 0.0;
  std::vector<double> all(q_.size(), 0.0);
  const int last = q_.empty() ? 0 : 1;
  for (int pass = 0; pass <= last; ++pass) {
    std::vector<double> c = local_products(q_, *q);
    c.push_back(local_product(*q, *q));
    if (pass == last) c.insert(c.end(), {local_product(*q, r), local_product(r, r), vote});
    c = global_sum(*r.getMap()->getComm(), c);  // c = Qᵀ q, qᵀ q, and at last qᵀ r, rᵀ r
    square = c[all.size()];
    if (pass == last) {
      added.product = c[all.size() + 1];
      added.square_of_r = c[all.size() + 2];
      added.votes = c[all.size() + 3];
    }
    c.resize(all.size());
    if (pass == 0) before = square;
    for (std::size_t i = 0; i < c.size(); ++i) all[i] += c[i];
    for (const double of_q : c) square -= of_q * of_q;
    add_columns(q_, -1.0, c, *q);  // q ← q − Q c
  }
  // z gets the same combination as q, so that q = A z stays true.
  add_columns(z_, -1.0, all, *z);
  // Nothing but round-off is left: q lies in the span of Q.
  added.is_new = square > 1e-20 * before;
  if (!added.is_new) return added;
  const double length = std::sqrt(square);
  added.product /= length;
  q->scale(1.0 / length);
  z->scale(1.0 / length);
  z_.push_back(z);
  q_.push_back(q);
  return added;
}

void Directions::minimise(MultiVector& r, MultiVector& x) const {
  const std::vector<double> c = global_sum(*r.getMap()->getComm(), local_products(q_, r));
  add_columns(z_, 1.0, c, x);   // x ← x + Z c
  add_columns(q_, -1.0, c, r);  // r ← r − Q c
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

// r = b − A x, and x ← x + Z Qᵀ r of the recycled directions.
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
  std::vector<double> history{relative_residual_};
  int standing = 0;
  for (iterations_ = 0; relative_residual_ > tolerance && iterations_ < cap;) {
    if (basis.size() >= kept) basis.clear();
    const bool stands = standing > 0 && basis.size() > 0;
    const MultiVector& source = stands ? basis.last_image() : r;
    standing = iterate(source, basis, r, x) ? 0 : standing + 1;
    if (standing > most_standing || !std::isfinite(relative_residual_)) break;
    history.push_back(relative_residual_);
    has_stagnated_ = !stagnation.is_null() && relative_residual_ > tolerance &&
                     stagnation->gives_up(history, tolerance);
    if (has_stagnated_) break;
  }
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

bool Gcr::iterate(const MultiVector& source, Directions& basis, MultiVector& r, MultiVector& x) {
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
  x.update(alpha, *z, 1.0);   // x ← x + (qᵀr) z
  r.update(-alpha, *q, 1.0);  // r ← r − (qᵀr) q
  // |r − (qᵀr) q|² = |r|² − (qᵀr)², where round-off leaves six digits of it.
  const double before = added.square_of_r, after = before - alpha * alpha;
  relative_residual_ = (after > least_foretold * before ? std::sqrt(after) : norm(r)) / scale_;
  io::report_progress([this] { return how_far(); });
  // Else stagnation, or not a number.
  return relative_residual_ < std::sqrt(before) / scale_ * (1.0 - 1e-12);
}

}  // namespace tunica::linear
