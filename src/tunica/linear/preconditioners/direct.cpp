#include "tunica/linear/preconditioners/direct.hpp"

#include "tunica/linear/direct/direct_factor.hpp"
#include "tunica/linear/merged_system.hpp"

namespace tunica::linear {

namespace {

class DirectPreconditioner final : public MatrixPreconditioner {
public:
  explicit DirectPreconditioner(const Teuchos::RCP<CrsMatrix>& A)
      : factor_(Teuchos::rcp(new DirectFactor(A))) {}

  void refresh() override { factor_->refresh(); }
  Teuchos::RCP<const Operator> as_operator() const override { return factor_; }
  double expected_bytes() const override { return factor_->expected_bytes(); }

private:
  Teuchos::RCP<DirectFactor> factor_;
};

}  // namespace

PreconditionerEntry direct_preconditioner() {
  return {"direct", 100.0, [](const SolverDefaults&) { return params::Table(); },
          [](const Teuchos::ParameterList&, const algebra::BlockMatrix& K, const NamedOperators&) {
            return std::make_unique<MergedSystem>(K, [](const Teuchos::RCP<CrsMatrix>& A) {
              return std::make_unique<DirectPreconditioner>(A);
            });
          }};
}

}  // namespace tunica::linear
