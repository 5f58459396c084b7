#include "multigrid/cycle.hpp"

#include <MueLu_Hierarchy.hpp>
#include <MueLu_ParameterListInterpreter.hpp>
#include <MueLu_TpetraOperator.hpp>
#include <Teuchos_DefaultSerialComm.hpp>
#include <algorithm>
#include <stdexcept>

#include "base/error.hpp"
#include "multigrid/factory_factory.hpp"
#include "multigrid/galerkin_factory.hpp"
#include "multigrid/xpetra.hpp"
#include "params/nearest.hpp"

namespace tunica::multigrid {

namespace {

using Interpreter = MueLu::ParameterListInterpreter<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
using Hierarchy = MueLu::Hierarchy<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
using Smoother = MueLu::SmootherBase<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

/// What must follow new values, in this order; empty where a part cannot.
std::vector<Refreshable*> parts_to_refresh(Hierarchy& hierarchy) {
  std::vector<Refreshable*> parts;
  for (int l = 1; l < hierarchy.GetNumLevels(); ++l) {
    parts.push_back(galerkin_product(*hierarchy.GetLevel(l)).get());
    if (parts.back() == nullptr) return {};
  }
  for (int l = 0; l < hierarchy.GetNumLevels(); ++l)
    for (const char* name : {"PreSmoother", "PostSmoother"}) {
      MueLu::Level& level = *hierarchy.GetLevel(l);
      if (!level.IsAvailable(name)) continue;
      const auto smoother = level.Get<Teuchos::RCP<Smoother>>(name);
      if (smoother.is_null()) continue;
      auto* const part = dynamic_cast<Refreshable*>(smoother.get());
      if (part == nullptr) return {};
      if (std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(part);
    }
  return parts;
}

}  // namespace

struct Cycle::Parts {
  Teuchos::RCP<Hierarchy> hierarchy;
  Teuchos::RCP<Operator> as_operator;
  std::vector<Refreshable*> refreshable;
};

Cycle::Cycle(const Teuchos::RCP<CrsMatrix>& A, const Teuchos::RCP<MixedCoarsening>& coarsening,
             const Teuchos::ParameterList& muelu)
    : A_(A), coarsening_(coarsening), muelu_(muelu) {
  set_up();
}

Cycle::~Cycle() = default;

void Cycle::set_up() {
  parts_ = std::make_unique<Parts>();
  Teuchos::ParameterList list(muelu_);
  Interpreter interpreter(list, A_->getComm(), make_factory_factory(coarsening_));
  const auto hierarchy = interpreter.CreateHierarchy();
  hierarchy->setlib(Xpetra::UseTpetra);
  hierarchy->GetLevel(0)->Set("A", wrapped(A_));
  interpreter.SetupHierarchy(*hierarchy);
  hierarchy->IsPreconditioner(true);
  parts_->hierarchy = hierarchy;
  parts_->as_operator =
      Teuchos::rcp(new MueLu::TpetraOperator<Scalar, LocalOrdinal, GlobalOrdinal, Node>(hierarchy));
  parts_->refreshable = parts_to_refresh(*hierarchy);
  try_once();
}

void Cycle::try_once() const {
  const MultiVector zero(A_->getRangeMap(), 1);
  MultiVector nothing(A_->getDomainMap(), 1);
  parts_->as_operator->apply(zero, nothing);
}

void Cycle::refresh() {
  if (!keeps_graphs()) return set_up();
  for (Refreshable* part : parts_->refreshable) part->refresh();
}

bool Cycle::keeps_graphs() const { return !parts_->refreshable.empty(); }

void Cycle::apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode, Scalar alpha,
                  Scalar beta) const {
  if (mode != Teuchos::NO_TRANS) throw std::logic_error("Cycle: no transpose");
  if (alpha == 1.0 && beta == 0.0) return parts_->as_operator->apply(X, Y);
  MultiVector result(Y.getMap(), Y.getNumVectors());
  parts_->as_operator->apply(X, result);
  Y.update(alpha, result, beta);
}

Teuchos::RCP<const CrsMatrix> Cycle::matrix(int level) const {
  return unwrapped(parts_->hierarchy->GetLevel(level)->Get<Teuchos::RCP<XMatrix>>("A"));
}

Levels Cycle::levels() const {
  Levels levels;
  double finest = 0.0, all = 0.0;
  for (int l = 0; l < parts_->hierarchy->GetNumLevels(); ++l) {
    const auto A = matrix(l);
    levels.unknowns.push_back(static_cast<long long>(A->getGlobalNumRows()));
    all += static_cast<double>(A->getGlobalNumEntries());
    if (l == 0) finest = all;
  }
  levels.operator_complexity = all / finest;
  return levels;
}

void check_cycle_list(const Teuchos::ParameterList& muelu) {
  Teuchos::ParameterList list(muelu);
  TUNICA_CHECK(list.isSublist("Hierarchy") && list.isSublist("Factories"),
               "the list lacks \"Factories\" or \"Hierarchy\"; a mixed matrix needs a MueLu list "
               "in the form of factories.");
  std::string cause;
  try {
    const Interpreter interpreter(list, Teuchos::rcp(new Teuchos::SerialComm<int>),
                                  make_factory_factory(Teuchos::null));
  } catch (const std::exception& error) {
    cause = error.what();
  }
  const auto found = cause.find("unknown factory name : ");
  if (found != std::string::npos)
    cause = cause.substr(found, cause.find('\n', found) - found) + ". Ours are " +
            params::quoted(our_factories()) + ", the others are those of MueLu's user's guide.";
  TUNICA_CHECK(cause.empty(), cause);
}

namespace {

/// The levels of the nodal coarsening with a smoother named "Sweeps".
Teuchos::ParameterList nodal_levels(const Teuchos::ParameterList& sweeps, int coarse_size) {
  Teuchos::ParameterList list("MueLu");
  Teuchos::ParameterList& factories = list.sublist("Factories");
  factories.sublist("Nodes").set("factory", "NodalPFactory");
  factories.sublist("Transpose").set("factory", "TransPFactory").set("P", "Nodes");
  factories.sublist("Galerkin")
      .set("factory", "GalerkinFactory")
      .set("P", "Nodes")
      .set("R", "Transpose");
  factories.sublist("Sweeps") = sweeps;
  factories.sublist("Coarsest").set("factory", "SparseLUSolver");
  Teuchos::ParameterList& hierarchy = list.sublist("Hierarchy");
  hierarchy.set("max levels", 10).set("coarse: max size", coarse_size).set("verbosity", "None");
  hierarchy.sublist("All")
      .set("P", "Nodes")
      .set("R", "Transpose")
      .set("A", "Galerkin")
      .set("Smoother", "Sweeps")
      .set("CoarseSolver", "Coarsest");
  return list;
}

}  // namespace

Teuchos::ParameterList nodal_cycle_list(int sweeps, int coarse_size) {
  Teuchos::ParameterList smoother;
  smoother.set("factory", "Ifpack2Smoother").set("type", "RELAXATION");
  smoother.sublist("ParameterList")
      .set("relaxation: type", "Symmetric Gauss-Seidel")
      .set("relaxation: sweeps", sweeps);
  return nodal_levels(smoother, coarse_size);
}

Teuchos::ParameterList mixed_cycle_list() {
  Teuchos::ParameterList smoother;
  smoother.set("factory", "Ifpack2Smoother").set("type", "RILUK");
  smoother.sublist("ParameterList").set("fact: iluk level-of-fill", 0);
  return nodal_levels(smoother, 1500);
}

}  // namespace tunica::multigrid
