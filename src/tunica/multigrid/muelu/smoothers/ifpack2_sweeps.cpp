#include "tunica/multigrid/muelu/smoothers/ifpack2_sweeps.hpp"

#include <Ifpack2_Factory.hpp>
#include <stdexcept>

namespace tunica::multigrid {

namespace {

bool is_factorisation(const std::string& type) {
  return type == "RILUK" || type == "ILUT" || type == "ILU" || type == "RILU";
}

}  // namespace

void Ifpack2Sweeps::declare(Teuchos::ParameterList& list) {
  list.set<std::string>("type", "RELAXATION");
  list.set("overlap", 0);
  list.sublist("ParameterList").disableRecursiveValidation();
}

void Ifpack2Sweeps::check(const Teuchos::ParameterList& list) {
  const auto& type = list.get<std::string>("type");
  const int overlap = list.get<int>("overlap");
  if (overlap < 0) throw std::invalid_argument("Ifpack2Smoother: \"overlap\" is negative.");
  if (overlap > 0 && !is_factorisation(type))
    throw std::invalid_argument("Ifpack2Smoother: \"" + type + "\" takes no \"overlap\".");
}

Ifpack2Sweeps::Ifpack2Sweeps(const Teuchos::ParameterList& list, const Teuchos::RCP<CrsMatrix>& K)
    : K_(K), has_overlap_(list.get<int>("overlap") > 0) {
  const auto& type = list.get<std::string>("type");
  const Teuchos::RCP<const RowMatrix> rows = K;
  // Between ranks M⁻¹ = Σ_r R̃_rᵀ M_r⁻¹ R_r, as these methods look at the rows of one rank
  if (is_factorisation(type)) {
    Teuchos::ParameterList schwarz;
    schwarz.set("schwarz: inner preconditioner name", type);
    schwarz.set("schwarz: overlap level", list.get<int>("overlap"));
    schwarz.set("schwarz: combine mode", "ZERO");  // restricted: each rank gives its own rows
    schwarz.sublist("schwarz: inner preconditioner parameters") = list.sublist("ParameterList");
    method_ = Ifpack2::Factory::create<RowMatrix>("SCHWARZ", rows);
    method_->setParameters(schwarz);
  } else {
    method_ = Ifpack2::Factory::create<RowMatrix>(type, rows);
    method_->setParameters(list.sublist("ParameterList"));
  }
  method_->initialize();
  method_->compute();
}

void Ifpack2Sweeps::refresh() {
  // Ifpack2 fetches the values of overlapping rows in initialize() only.
  if (has_overlap_) method_->initialize();
  method_->compute();
}

// x ← x + M⁻¹ (b − K x). Relaxations sweep from the x that they find; factorisations see only a
// right side, which is then the residual.
void Ifpack2Sweeps::smooth(const MultiVector& b, MultiVector& x) const {
  if (method_->supportsZeroStartingSolution()) {
    method_->setZeroStartingSolution(false);
    return method_->apply(b, x);
  }
  MultiVector r(b.getMap(), b.getNumVectors()), correction(x.getMap(), x.getNumVectors());
  K_->apply(x, r);
  r.update(1.0, b, -1.0);  // r = b − K x
  method_->apply(r, correction);
  x.update(1.0, correction, 1.0);
}

}  // namespace tunica::multigrid
