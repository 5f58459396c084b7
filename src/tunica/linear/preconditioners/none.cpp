#include "tunica/linear/preconditioners/none.hpp"

#include "tunica/linear/merged_system.hpp"

namespace tunica::linear {

namespace {

class NoPreconditioner final : public MatrixPreconditioner {
public:
  void refresh() override {}
  Teuchos::RCP<const Operator> as_operator() const override { return Teuchos::null; }
};

}  // namespace

PreconditionerEntry no_preconditioner() {
  return {"none", 0.0, [](const SolverDefaults&) { return params::Table(); },
          [](const Teuchos::ParameterList&, const algebra::BlockMatrix& K, const NamedOperators&) {
            return std::make_unique<MergedSystem>(K, [](const Teuchos::RCP<CrsMatrix>&) {
              return std::make_unique<NoPreconditioner>();
            });
          }};
}

}  // namespace tunica::linear
