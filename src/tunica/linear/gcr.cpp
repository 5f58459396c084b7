#include "tunica/linear/gcr.hpp"

#include <BelosLinearProblem.hpp>
#include <BelosTpetraAdapter.hpp>
#include <cmath>

namespace tunica::linear {

namespace {

double norm(const MultiVector& v) {
  double size = 0.0;
  v.norm2(Teuchos::ArrayView<double>(&size, 1));
  return size;
}

double dot(const MultiVector& a, const MultiVector& b) {
  double product = 0.0;
  a.dot(b, Teuchos::ArrayView<double>(&product, 1));
  return product;
}

/// The directions kept and their images under A, orthonormal.
struct Basis {
  std::vector<Teuchos::RCP<MultiVector>> z, q;

  /// Orthonormalises the images; false where q depends on them already.
  bool add(const Teuchos::RCP<MultiVector>& new_z, const Teuchos::RCP<MultiVector>& new_q) {
    const double before = norm(*new_q);
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t i = 0; i < q.size(); ++i) {
        const double c = dot(*new_q, *q[i]);
        new_q->update(-c, *q[i], 1.0);
        new_z->update(-c, *z[i], 1.0);
      }
    const double after = norm(*new_q);
    if (!(after > 1e-10 * before)) return false;
    new_q->scale(1.0 / after);
    new_z->scale(1.0 / after);
    z.push_back(new_z);
    q.push_back(new_q);
    return true;
  }
};

}  // namespace

Gcr::Gcr(const Teuchos::RCP<Teuchos::ParameterList>& list) { setParameters(list); }

Teuchos::RCP<Belos::SolverManager<Scalar, MultiVector, Operator>> Gcr::clone() const {
  return Teuchos::rcp(new Gcr(Teuchos::rcp(new Teuchos::ParameterList(*list_))));
}

Teuchos::RCP<const Teuchos::ParameterList> Gcr::getValidParameters() const {
  const auto valid = Teuchos::rcp(new Teuchos::ParameterList("GCR"));
  valid->set("Convergence Tolerance", 1e-8, "|r| / |b| to be reached");
  valid->set("Maximum Iterations", 1000, "cap on the iterations");
  valid->set("Num Blocks", 200, "directions kept between restarts");
  valid->set("Maximum Restarts", 1000, "not used: the cap on the iterations ends the method");
  return valid;
}

void Gcr::setParameters(const Teuchos::RCP<Teuchos::ParameterList>& list) {
  list_ = list.is_null() ? Teuchos::rcp(new Teuchos::ParameterList("GCR")) : list;
  list_->validateParametersAndSetDefaults(*getValidParameters());
}

Belos::ReturnType Gcr::solve() {
  const double tolerance = list_->get<double>("Convergence Tolerance");
  const int cap = list_->get<int>("Maximum Iterations");
  const auto kept = static_cast<std::size_t>(list_->get<int>("Num Blocks"));
  MultiVector& x = *problem_->getLHS();
  const MultiVector& b = *problem_->getRHS();
  MultiVector r(b.getMap(), 1);
  problem_->applyOp(x, r);
  r.update(1.0, b, -1.0);  // r = b − A x
  const double scale = norm(b);
  relative_residual_ = scale == 0.0 ? 0.0 : norm(r) / scale;
  Basis basis;
  for (iterations_ = 0; relative_residual_ > tolerance && iterations_ < cap; ++iterations_) {
    if (basis.z.size() == kept) basis = Basis();
    const auto z = Teuchos::rcp(new MultiVector(b.getMap(), 1));
    const auto q = Teuchos::rcp(new MultiVector(b.getMap(), 1));
    if (problem_->getRightPrec().is_null())
      z->assign(r);
    else
      problem_->getRightPrec()->apply(r, *z);  // z = P⁻¹ r
    problem_->applyOp(*z, *q);                 // q = A z
    if (!basis.add(z, q)) break;
    const double step = dot(*basis.q.back(), r);
    x.update(step, *basis.z.back(), 1.0);   // x ← x + (qᵀr) z
    r.update(-step, *basis.q.back(), 1.0);  // r ← r − (qᵀr) q
    const double before = relative_residual_;
    relative_residual_ = norm(r) / scale;
    if (!(relative_residual_ < before * (1.0 - 1e-12))) {  // stagnation, or not a number
      ++iterations_;
      break;
    }
  }
  return relative_residual_ <= tolerance ? Belos::Converged : Belos::Unconverged;
}

Teuchos::RCP<Belos::SolverManager<Scalar, MultiVector, Operator>> GcrFactory::getSolver(
    const std::string& name, const Teuchos::RCP<Teuchos::ParameterList>& list) {
  if (!isSupported(name)) return Teuchos::null;
  return Teuchos::rcp(new Gcr(list));
}

}  // namespace tunica::linear
