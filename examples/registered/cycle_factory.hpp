#pragma once
#include <Thyra_DefaultPreconditioner.hpp>
#include <Thyra_PreconditionerFactoryBase.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>
#include <memory>

#include "tunica/multigrid/muelu/cycle.hpp"

/// Tunica's multigrid cycle as Stratimikos makes its preconditioners:
///
///   builder.setPreconditioningStrategyFactory(
///       Teuchos::abstractFactoryStd<Thyra::PreconditionerFactoryBase<double>, CycleFactory>(),
///       "Tunica Cycle");
///
/// Its list has "components" (of the vectors) and the sublist "MueLu", as for Cycle. A solver that
/// is initialised again with the same matrix refreshes the cycle: numeric work only.
class CycleFactory : public Thyra::PreconditionerFactoryBase<double> {
public:
  using Map = Tpetra::Map<int, long long>;
  using Matrix = Tpetra::CrsMatrix<double, int, long long>;
  using Extraction = Thyra::TpetraOperatorVectorExtraction<double, int, long long, Map::node_type>;

  bool isCompatible(const Thyra::LinearOpSourceBase<double>& source) const override {
    return !matrix_of(source).is_null();
  }

  Teuchos::RCP<Thyra::PreconditionerBase<double>> createPrec() const override {
    return Teuchos::rcp(new Thyra::DefaultPreconditioner<double>);
  }

  void initializePrec(const Teuchos::RCP<const Thyra::LinearOpSourceBase<double>>& source,
                      Thyra::PreconditionerBase<double>* preconditioner,
                      const Thyra::ESupportSolveUse) const override {
    auto& made = dynamic_cast<Thyra::DefaultPreconditioner<double>&>(*preconditioner);
    const Teuchos::RCP<Matrix> K = matrix_of(*source);
    if (!made.getUnspecifiedPrecOp().is_null()) {
      const auto before = Teuchos::rcp_dynamic_cast<tunica::multigrid::Cycle>(
          Extraction::getTpetraOperator(made.getNonconstUnspecifiedPrecOp()), true);
      if (before->matrix(0).get() == K.get()) return before->refresh();
    }
    const auto cycle = Teuchos::rcp(
        new tunica::multigrid::Cycle(K, list_->get<int>("components"), list_->sublist("MueLu")));
    const Teuchos::RCP<Tpetra::Operator<double, int, long long>> as_operator = cycle;
    made.initializeUnspecified(Thyra::createLinearOp(as_operator));
  }

  void uninitializePrec(Thyra::PreconditionerBase<double>* preconditioner,
                        Teuchos::RCP<const Thyra::LinearOpSourceBase<double>>*,
                        Thyra::ESupportSolveUse*) const override {
    dynamic_cast<Thyra::DefaultPreconditioner<double>&>(*preconditioner).uninitialize();
  }

  void setParameterList(const Teuchos::RCP<Teuchos::ParameterList>& list) override { list_ = list; }
  Teuchos::RCP<Teuchos::ParameterList> getNonconstParameterList() override { return list_; }
  Teuchos::RCP<const Teuchos::ParameterList> getParameterList() const override { return list_; }
  Teuchos::RCP<Teuchos::ParameterList> unsetParameterList() override {
    return std::exchange(list_, Teuchos::null);
  }
  Teuchos::RCP<const Teuchos::ParameterList> getValidParameters() const override {
    const auto list = Teuchos::rcp(new Teuchos::ParameterList);
    list->set("components", 3, "vector unknowns of a node");
    list->sublist("MueLu", false, "factories and hierarchy, as for MueLu")
        .disableRecursiveValidation();
    return list;
  }

private:
  static Teuchos::RCP<Matrix> matrix_of(const Thyra::LinearOpSourceBase<double>& source) {
    const auto K = Extraction::getConstTpetraOperator(source.getOp());
    return Teuchos::rcp_const_cast<Matrix>(Teuchos::rcp_dynamic_cast<const Matrix>(K));
  }

  Teuchos::RCP<Teuchos::ParameterList> list_;
};
