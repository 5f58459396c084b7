#include "tunica/linear/preconditioners/cycle.hpp"

#include "tunica/base/error.hpp"
#include "tunica/base/fault_point.hpp"
#include "tunica/linear/merged_system.hpp"
#include "tunica/linear/setup_failure.hpp"
#include "tunica/multigrid/muelu/factory_registry.hpp"

namespace tunica::linear {

namespace {

class CyclePreconditioner final : public MatrixPreconditioner {
public:
  CyclePreconditioner(const Teuchos::ParameterList& list, const algebra::BlockMatrix& K,
                      const Teuchos::RCP<CrsMatrix>& A)
      : A_(A), muelu_(list.sublist("MueLu")),
        is_blocked_(list.get<std::string>("matrix") == "blocked"),
        nodes_(Teuchos::rcp(new multigrid::MixedCoarsening(*K.space()))) {}

  void refresh() override {
    // The first set-up finds nodes and graphs, later ones follow new values.
    Teuchos::RCP<multigrid::Cycle> cycle = cycle_;
    cycle_ = Teuchos::null;  // nothing to keep on any rank should the set-up fail on one
    set_up(*A_->getComm(), "the multigrid cycle", [&] {
      fault_point("multigrid set-up");
      const bool is_new = cycle.is_null();
      if (is_new) cycle = Teuchos::rcp(new multigrid::Cycle(A_, nodes_, muelu_, is_blocked_));
      cycle->recall(memory_);
      if (!is_new || !memory_.empty()) cycle->refresh();
    });
    memory_.clear();
    cycle_ = cycle;
  }
  Teuchos::RCP<const Operator> as_operator() const override { return cycle_; }
  multigrid::Levels levels() const override {
    return cycle_.is_null() ? multigrid::Levels() : cycle_->levels();
  }
  bool note(int iterations, double reduction) override {
    return !cycle_.is_null() && cycle_->note(iterations, reduction);
  }
  bool may_improve() const override { return !cycle_.is_null() && cycle_->may_take_rotations(); }
  std::vector<double> save() const override {
    return cycle_.is_null() ? memory_ : cycle_->memory();
  }
  void restore(const std::vector<double>& numbers) override { memory_ = numbers; }

private:
  Teuchos::RCP<CrsMatrix> A_;
  Teuchos::ParameterList muelu_;
  bool is_blocked_;  ///< what the cycle works on
  Teuchos::RCP<multigrid::MixedCoarsening> nodes_;
  Teuchos::RCP<multigrid::Cycle> cycle_;
  std::vector<double> memory_;  ///< that the next set-up goes on from
};

void check_cycle_list(const Teuchos::ParameterList& list, const std::string& path) {
  if (!list.isSublist("MueLu")) return;  // another preconditioner
  try {
    multigrid::check_cycle_list(list.sublist("MueLu"),
                                list.get<std::string>("matrix") == "blocked");
  } catch (const Error& error) {
    throw Error(path + " / MueLu: " + error.what());
  }
}

params::Table cycle_table(const SolverDefaults& defaults) {
  params::Table table;
  table
      .choice("matrix", "merged", {"merged", "blocked"},
              "matrix that the MueLu list works on: one matrix with the unknowns of a node side by "
              "side, or MueLu's 2×2 matrix of blocks, as its own block smoothers require")
      .foreign("MueLu", defaults.cycle, Teuchos::ParameterList(),
               "a MueLu list of factories for the whole system, the unknowns of a node side by "
               "side; additional factories of Tunica are " +
                   multigrid::our_factories_text())
      .check(check_cycle_list);
  return table;
}

}  // namespace

PreconditionerEntry cycle_preconditioner() {
  return {
      "multigrid", 4.0, cycle_table,
      [](const Teuchos::ParameterList& list, const algebra::BlockMatrix& K, const NamedOperators&) {
        return std::make_unique<MergedSystem>(K, [&](const Teuchos::RCP<CrsMatrix>& A) {
          return std::make_unique<CyclePreconditioner>(list, K, A);
        });
      }};
}

}  // namespace tunica::linear
