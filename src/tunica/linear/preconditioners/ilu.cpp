#include "tunica/linear/preconditioners/ilu.hpp"

#include <Ifpack2_Factory.hpp>

#include "tunica/base/fault_point.hpp"
#include "tunica/linear/merged_system.hpp"
#include "tunica/linear/setup_failure.hpp"

namespace tunica::linear {

namespace {

class IluPreconditioner final : public MatrixPreconditioner {
public:
  IluPreconditioner(const Teuchos::RCP<const RowMatrix>& rows, int fill_level, int overlap)
      : rows_(rows), has_overlap_(overlap > 0) {
    set_up(*rows_->getComm(), "the incomplete factors", [&] { initialize(fill_level, overlap); });
  }

  void refresh() override {
    set_up(*rows_->getComm(), "the incomplete factors", [this] {
      fault_point("ilu set-up");
      // Ifpack2 fetches the values of overlapping rows in initialize() only.
      if (has_overlap_) factors_->initialize();
      factors_->compute();
    });
  }
  Teuchos::RCP<const Operator> as_operator() const override { return factors_; }

private:
  void initialize(int fill_level, int overlap) {
    // P⁻¹ = Σ_r R̃_rᵀ (L U)_r⁻¹ R_r, restricted additive Schwarz: R_r has the rows of rank r and of
    // its overlap, R̃_r those of the rank alone
    factors_ = Ifpack2::Factory::create<RowMatrix>("SCHWARZ", rows_);
    Teuchos::ParameterList list;
    list.set("schwarz: inner preconditioner name", "RILUK");
    list.set("schwarz: overlap level", overlap);
    list.set("schwarz: combine mode", "ZERO");  // restricted: each rank gives its own rows
    list.sublist("schwarz: inner preconditioner parameters")
        .set("fact: iluk level-of-fill", fill_level);
    factors_->setParameters(list);
    factors_->initialize();
  }

  Teuchos::RCP<const RowMatrix> rows_;
  bool has_overlap_;
  Teuchos::RCP<Ifpack2::Preconditioner<Scalar, LocalOrdinal, GlobalOrdinal, Node>> factors_;
};

params::Table ilu_table(const SolverDefaults&) {
  params::Table table;
  table.integer("fill level", 0, params::between(0, 20), "levels of fill k of ILU(k)")
      .integer("overlap", 0, params::between(0, 20), "overlap between ranks, in graph layers");
  return table;
}

}  // namespace

PreconditionerEntry ilu_preconditioner() {
  return {
      "ilu", 20.0, ilu_table,
      [](const Teuchos::ParameterList& list, const algebra::BlockMatrix& K, const NamedOperators&) {
        return std::make_unique<MergedSystem>(K, [&](const Teuchos::RCP<CrsMatrix>& A) {
          return std::make_unique<IluPreconditioner>(A, list.get<int>("fill level"),
                                                     list.get<int>("overlap"));
        });
      }};
}

}  // namespace tunica::linear
