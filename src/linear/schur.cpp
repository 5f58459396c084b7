#include "linear/schur.hpp"

#include <Teko_InverseLibrary.hpp>
#include <Teko_RequestHandler.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>
#include <TpetraExt_MatrixMatrix.hpp>
#include <stdexcept>

#include "linear/thyra_operator.hpp"

namespace tunica::linear {

namespace {

Teuchos::RCP<const CrsMatrix> matrix_of(const Teko::LinearOp& op) {
  using Extract = Thyra::TpetraOperatorVectorExtraction<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  return Teuchos::rcp_dynamic_cast<const CrsMatrix>(Extract::getConstTpetraOperator(op), true);
}

/// a A + b B.
Teuchos::RCP<CrsMatrix> sum(double a, const CrsMatrix& A, double b, const CrsMatrix& B) {
  return Tpetra::MatrixMatrix::add(a, false, A, b, false, B, A.getDomainMap(), A.getRangeMap());
}

/// Inverts an assembled operator by a member of the library, again with each new set-up.
Teko::LinearOp invert(const Teko::InverseFactory& factory, const Teko::LinearOp& op,
                      const std::string& key, Teko::BlockPreconditionerState& state) {
  // The graph of an assembled sum may differ from the last one: build anew.
  Teko::ModifiableLinearOp& inverse = state.getModifiableOp(key);
  inverse = Teko::buildInverse(factory, op);
  return inverse;
}

class Algebraic final : public SchurInverse {
public:
  explicit Algebraic(const Teuchos::RCP<const Teko::InverseFactory>& inverse) : inverse_(inverse) {}

  Teko::LinearOp build(const Teko::BlockedLinearOp& K,
                       Teko::BlockPreconditionerState& state) const override {
    const auto A = matrix_of(Teko::getBlock(0, 0, K)), mC = matrix_of(Teko::getBlock(1, 1, K));
    const auto B2 = matrix_of(Teko::getBlock(1, 0, K));
    CrsMatrix scaled(*matrix_of(Teko::getBlock(0, 1, K)), Teuchos::Copy);
    Vector diagonal(A->getRowMap());
    A->getLocalDiagCopy(diagonal);
    diagonal.reciprocal(diagonal);
    scaled.leftScale(diagonal);  // diag(A)⁻¹ B1ᵀ
    CrsMatrix product(B2->getRowMap(), 0);
    Tpetra::MatrixMatrix::Multiply(*B2, false, scaled, false, product);
    return invert(*inverse_, thyra_operator(sum(1.0, product, -1.0, *mC)), "inverse S", state);
  }

private:
  Teuchos::RCP<const Teko::InverseFactory> inverse_;
};

Teko::LinearOp ask(Teko::RequestHandler& handler, const std::string& name) {
  return handler.request<Teko::LinearOp>(Teko::RequestMesg(name));
}

class OperatorSplitting final : public SchurInverse {
public:
  OperatorSplitting(const Teuchos::RCP<const Teko::InverseFactory>& inverse,
                    const Teuchos::RCP<Teko::RequestHandler>& handler, bool has_stabilisation,
                    bool has_convection)
      : inverse_(inverse), handler_(handler), has_stabilisation_(has_stabilisation),
        has_convection_(has_convection) {}

  Teko::LinearOp build(const Teko::BlockedLinearOp& K,
                       Teko::BlockPreconditionerState& state) const override {
    Teko::LinearOp L = ask(*handler_, "Schur Laplacian");
    if (has_stabilisation_)
      L = thyra_operator(sum(1.0, *matrix_of(L), -1.0, *matrix_of(Teko::getBlock(1, 1, K))));
    const Teko::LinearOp inverse_L = invert(*inverse_, L, "inverse L", state);
    const Teko::LinearOp inverse_M = Teko::getInvDiagonalOp(ask(*handler_, "Schur Mass"));
    const Teko::LinearOp S = Teko::add(inverse_L, inverse_M);
    if (!has_convection_) return S;
    return Teko::add(S, Teko::multiply(inverse_M, ask(*handler_, "Schur Convection"), inverse_L));
  }

private:
  Teuchos::RCP<const Teko::InverseFactory> inverse_;
  Teuchos::RCP<Teko::RequestHandler> handler_;
  bool has_stabilisation_, has_convection_;
};

class ScaledMass final : public SchurInverse {
public:
  ScaledMass(const Teuchos::RCP<Teko::RequestHandler>& handler, double theta_factor)
      : handler_(handler), theta_factor_(theta_factor) {}

  Teko::LinearOp build(const Teko::BlockedLinearOp&,
                       Teko::BlockPreconditionerState&) const override {
    const auto shear = matrix_of(ask(*handler_, "Schur Shear Mass"));
    const auto bulk = matrix_of(ask(*handler_, "Schur Bulk Mass"));
    return Teko::getInvDiagonalOp(thyra_operator(sum(1.0 / theta_factor_, *shear, 1.0, *bulk)));
  }

private:
  Teuchos::RCP<Teko::RequestHandler> handler_;
  double theta_factor_;
};

}  // namespace

std::unique_ptr<SchurInverse> make_schur_inverse(
    Teuchos::ParameterList& list, const Teko::InverseLibrary& library,
    const Teuchos::RCP<Teko::RequestHandler>& handler) {
  const auto kind = list.get<std::string>("Schur Complement", "Algebraic");
  const auto need = [&handler](const std::string& name) {  // throws where nobody offers it
    if (!handler.is_null()) handler->preRequest<Teko::LinearOp>(Teko::RequestMesg(name));
  };
  if (kind == "Scaled Mass") {
    need("Schur Shear Mass");
    need("Schur Bulk Mass");
    return std::make_unique<ScaledMass>(handler, list.get<double>("Theta Factor", 1.0));
  }
  const auto inverse =
      library.getInverseFactory(list.get<std::string>("Inverse Schur Type", "Amesos2"));
  if (kind == "Algebraic") return std::make_unique<Algebraic>(inverse);
  if (kind == "Operator Splitting") {
    need("Schur Laplacian");
    need("Schur Mass");
    return std::make_unique<OperatorSplitting>(inverse, handler, list.get("Stabilisation", true),
                                               list.get("Convection", false));
  }
  throw std::invalid_argument("\"Schur Complement\" is \"" + kind +
                              "\", expected \"Algebraic\", \"Operator Splitting\" or "
                              "\"Scaled Mass\".");
}

}  // namespace tunica::linear
