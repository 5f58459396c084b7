#include "tunica/multigrid/muelu/ifpack2_smoother.hpp"

#include <Ifpack2_Factory.hpp>
#include <stdexcept>

namespace tunica::multigrid {

namespace {

/// Methods that look at the rows of their rank only; those of others come by additive Schwarz.
bool is_factorisation(const std::string& type) {
  return type == "RILUK" || type == "ILUT" || type == "ILU" || type == "RILU";
}

}  // namespace

Teuchos::RCP<const Teuchos::ParameterList> Ifpack2Smoother::GetValidParameterList() const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set<Teuchos::RCP<const MueLu::FactoryBase>>("A", Teuchos::null, "the matrix");
  list->set<std::string>("type", "RELAXATION");
  list->set("overlap", 0);
  list->sublist("ParameterList").disableRecursiveValidation();
  return list;
}

void Ifpack2Smoother::check(const Teuchos::ParameterList& list) const {
  const auto& type = list.get<std::string>("type");
  const int overlap = list.get<int>("overlap");
  if (overlap < 0) throw std::invalid_argument("Ifpack2Smoother: \"overlap\" is negative.");
  if (overlap > 0 && !is_factorisation(type))
    throw std::invalid_argument("Ifpack2Smoother: \"" + type + "\" takes no \"overlap\".");
}

void Ifpack2Smoother::set_up(int, const Teuchos::RCP<::tunica::CrsMatrix>& K) {
  const Teuchos::ParameterList& list = GetParameterList();
  const auto& type = list.get<std::string>("type");
  matrix_ = K;
  const Teuchos::RCP<const ::tunica::RowMatrix> rows = K;
  if (is_factorisation(type)) {
    Teuchos::ParameterList schwarz;
    schwarz.set("schwarz: inner preconditioner name", type);
    schwarz.set("schwarz: overlap level", list.get<int>("overlap"));
    schwarz.set("schwarz: combine mode", "ZERO");  // restricted: each rank gives its own rows
    schwarz.sublist("schwarz: inner preconditioner parameters") = list.sublist("ParameterList");
    inner_ = Ifpack2::Factory::create<::tunica::RowMatrix>("SCHWARZ", rows);
    inner_->setParameters(schwarz);
  } else {
    inner_ = Ifpack2::Factory::create<::tunica::RowMatrix>(type, rows);
    inner_->setParameters(list.sublist("ParameterList"));
  }
  inner_->initialize();
  inner_->compute();
}

void Ifpack2Smoother::refresh() {
  // Ifpack2 fetches the values of overlapping rows in initialize() only.
  if (GetParameterList().get<int>("overlap") > 0) inner_->initialize();
  inner_->compute();
}

void Ifpack2Smoother::smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const {
  if (inner_->supportsZeroStartingSolution()) {
    inner_->setZeroStartingSolution(false);
    return inner_->apply(b, x);
  }
  ::tunica::MultiVector r(b.getMap(), b.getNumVectors()), correction(x.getMap(), x.getNumVectors());
  matrix_->apply(x, r);
  r.update(1.0, b, -1.0);
  inner_->apply(r, correction);
  x.update(1.0, correction, 1.0);
}

Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>>
Ifpack2Smoother::Copy() const {
  return Teuchos::rcp(new Ifpack2Smoother(*this));
}

}  // namespace tunica::multigrid
