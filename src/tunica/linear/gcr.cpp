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

/// Entries that stay in the nearest cache while all columns pass over them.
constexpr int piece = 1024;

/// Qᵀ v of the columns from the first on, with one message. It takes the votes of all ranks along,
/// and makes their sum of this one's.
std::vector<double> products(const Columns& Q, int first, const MultiVector& v,
                             double* vote = nullptr) {
  if (first == static_cast<int>(Q.size())) return {};
  const Teuchos::BLAS<int, double> blas;
  const int n = static_cast<int>(v.getLocalLength());
  const double* values = v.getLocalViewHost(read_only).data();
  std::vector<const double*> columns;
  for (std::size_t i = first; i < Q.size(); ++i)
    columns.push_back(Q[i]->getLocalViewHost(read_only).data());
  std::vector<double> mine(columns.size(), 0.0);
  for (int a = 0; a < n; a += piece)
    for (std::size_t i = 0; i < columns.size(); ++i)
      mine[i] += blas.DOT(std::min(piece, n - a), columns[i] + a, 1, values + a, 1);
  if (vote == nullptr) return global_sum(*v.getMap()->getComm(), mine);
  mine.push_back(*vote);
  std::vector<double> sums = global_sum(*v.getMap()->getComm(), mine);
  *vote = sums.back();
  sums.pop_back();
  return sums;
}

/// v ← v + s Z c, by the columns from the first on.
void add_columns(const Columns& Z, int first, double s, const std::vector<double>& c,
                 MultiVector& v) {
  const Teuchos::BLAS<int, double> blas;
  const int n = static_cast<int>(v.getLocalLength());
  double* values = v.getLocalViewHost(read_write).data();
  std::vector<const double*> columns;
  for (std::size_t i = first; i < Z.size(); ++i)
    columns.push_back(Z[i]->getLocalViewHost(read_only).data());
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

bool Directions::add(const Teuchos::RCP<MultiVector>& z, const Teuchos::RCP<MultiVector>& q) {
  // Two passes: the second takes out what round-off has left of the first. z gets the same
  // combination as q, so that q = A z stays true.
  const double before = norm(*q);
  std::vector<double> all(q_.size(), 0.0);
  for (int pass = 0; pass < 2; ++pass) {
    const std::vector<double> c = products(q_, 0, *q);  // c = Qᵀ q
    add_columns(q_, 0, -1.0, c, *q);                    // q ← q − Q c
    for (std::size_t i = 0; i < c.size(); ++i) all[i] += c[i];
  }
  add_columns(z_, 0, -1.0, all, *z);
  const double after = norm(*q);
  // Nothing but round-off is left: q lies in the span of Q.
  if (!(after > 1e-10 * before)) return false;
  q->scale(1.0 / after);
  z->scale(1.0 / after);
  z_.push_back(z);
  q_.push_back(q);
  return true;
}

double Directions::minimise_from(int first, MultiVector& r, MultiVector& x, double vote) const {
  const std::vector<double> c = products(q_, first, r, &vote);  // c = Qᵀ r
  add_columns(z_, first, 1.0, c, x);                            // x ← x + Z c
  add_columns(q_, first, -1.0, c, r);                           // r ← r − Q c
  return vote;
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

// x ← x + Z Qᵀ r of recycled directions, then new ones until |r| is small. After "Num Blocks" of
// them the basis is dropped. A solve of one or two iterations leaves no new directions: there P is
// good enough by itself.
Belos::ReturnType Gcr::solve() {
  const double tolerance = list_->get<double>("Convergence Tolerance");
  const int cap = list_->get<int>("Maximum Iterations");
  const int kept = list_->get<int>("Num Blocks");
  MultiVector& x = *problem_->getLHS();
  const MultiVector& b = *problem_->getRHS();
  MultiVector r(b, Teuchos::Copy);
  if (!(norm(x) == 0.0)) {
    problem_->getOperator()->apply(x, r);
    r.update(1.0, b, -1.0);  // r = b − A x
  }
  const double scale = norm(b);
  relative_residual_ = scale == 0.0 ? 0.0 : norm(r) / scale;
  const auto recycled = list_->get<Teuchos::RCP<Directions>>("Recycled Directions");
  Directions basis;
  if (!recycled.is_null()) std::swap(basis, *recycled);
  const int n_recycled = basis.size();
  if (n_recycled > 0 && relative_residual_ > tolerance) {
    basis.minimise(r, x);
    relative_residual_ = norm(r) / scale;
  }
  const auto stagnation = list_->get<Teuchos::RCP<StagnationRule>>("Stagnation");
  std::vector<double> history{relative_residual_};
  int standing = 0;
  for (iterations_ = 0; relative_residual_ > tolerance && iterations_ < cap;) {
    if (basis.size() >= kept) basis.clear();
    const bool stands = standing > 0 && basis.size() > 0;
    const MultiVector& source = stands ? basis.last_image() : r;
    standing = iterate(source, basis, r, x, scale) ? 0 : standing + 1;
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

bool Gcr::iterate(const MultiVector& source, Directions& basis, MultiVector& r, MultiVector& x,
                  double scale) {
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
  if (!basis.add(z, q)) return false;
  // x ← x + (qᵀr) z, r ← r − (qᵀr) q
  const double wishes = basis.minimise_by_last(r, x, is_stop_urgent() ? 1.0 : 0.0);
  if (wishes > 0.0) stop_if_urgent(*r.getMap()->getComm());
  const double before = relative_residual_;
  relative_residual_ = norm(r) / scale;
  io::report_progress([this] { return how_far(); });
  return relative_residual_ < before * (1.0 - 1e-12);  // else stagnation, or not a number
}

}  // namespace tunica::linear
