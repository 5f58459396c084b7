#include "tunica/linear/schur.hpp"

#include <Teko_InverseLibrary.hpp>
#include <Teko_RequestHandler.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>
#include <TpetraExt_MatrixMatrix.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tunica/linear/inverse_sum.hpp"
#include "tunica/linear/thyra_operator.hpp"
#include "tunica/smoothers/braess_sarazin/schur_matrix.hpp"

namespace tunica::linear {

namespace {

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

/// C + B2 D⁻¹ B1ᵀ.
Teuchos::RCP<CrsMatrix> schur_matrix(const Teko::BlockedLinearOp& K, Vector D) {
  const auto block = [&K](int i, int j) { return matrix_of(Teko::getBlock(i, j, K)); };
  D.reciprocal(D);
  return smoothers::SchurMatrix(*block(0, 1), *block(1, 0), *block(1, 1), D).matrix();
}

Vector diagonal_of(const CrsMatrix& A) {
  Vector diagonal(A.getRowMap());
  A.getLocalDiagCopy(diagonal);
  return diagonal;
}

class Algebraic final : public SchurInverse {
public:
  explicit Algebraic(const Teuchos::RCP<const Teko::InverseFactory>& inverse) : inverse_(inverse) {}

  Teko::LinearOp build(const Teko::BlockedLinearOp& K,
                       Teko::BlockPreconditionerState& state) const override {
    const auto A = matrix_of(Teko::getBlock(0, 0, K));
    // S̃ = C + B2 diag(A)⁻¹ B1ᵀ
    const auto S = schur_matrix(K, diagonal_of(*A));
    return invert(*inverse_, thyra_operator(S), "inverse S", state);
  }

private:
  Teuchos::RCP<const Teko::InverseFactory> inverse_;
};

Teko::LinearOp ask(Teko::RequestHandler& handler, const std::string& name) {
  return handler.request<Teko::LinearOp>(Teko::RequestMesg(name));
}

/// The part of A that translations of the whole body see, its inertia: per row the sum over the
/// unknowns of its own component, which is the lumped inertia. Rows whose sum says nothing (next
/// to fixed nodes, or without inertia) keep a small share of the diagonal.
Vector lumped_inertia(const CrsMatrix& A, int components) {
  const Vector diagonal = diagonal_of(A);
  Vector inertia(A.getRowMap());
  const auto local = A.getLocalMatrixHost();
  const auto D = diagonal.getLocalViewHost(read_only);
  const auto sums = inertia.getLocalViewHost(overwrite_all);
  for (int i = 0; i < local.numRows(); ++i) {
    const auto component = A.getRowMap()->getGlobalElement(i) % components;
    const auto row = local.rowConst(i);
    double row_sum = 0.0;
    for (int k = 0; k < row.length; ++k)
      if (A.getColMap()->getGlobalElement(row.colidx(k)) % components == component)
        row_sum += row.value(k);
    sums(i, 0) = std::max(row_sum, 1e-3 * std::abs(D(i, 0)));
  }
  return inertia;
}

/// With a = k² the symbol of the Laplacian, A behaves as α + μ a and C as τ a, hence
///
///   S⁻¹ = (α + μ a) / (a (β + τ μ a)) ≈ (a/α + τ a)⁻¹ + (1/μ + τ a)⁻¹,  β = 1 + τ α ≈ 1:
///
/// two elliptic solves with the stabilisation in both ([CC88] has no C). The iterations hardly
/// tell μ from μ/2, which is what the wall hands over.
class TwoScale final : public SchurInverse {
public:
  TwoScale(const Teuchos::RCP<const Teko::InverseFactory>& inverse,
           const Teuchos::RCP<const Teko::InverseFactory>& inverse_mass,
           const Teuchos::RCP<Teko::RequestHandler>& handler)
      : inverse_(inverse), inverse_mass_(inverse_mass), handler_(handler) {}

  Teko::LinearOp build(const Teko::BlockedLinearOp& K,
                       Teko::BlockPreconditionerState& state) const override {
    const int components = handler_->request<int>(Teko::RequestMesg(components_request));
    // With D ~ α alone B2 D⁻¹ B1ᵀ ~ k²/α; diag(A) would have the stiffness in it, too.
    const auto L = schur_matrix(K, lumped_inertia(*matrix_of(Teko::getBlock(0, 0, K)), components));
    // Block (1, 1) of K is −C.
    const auto M = sum(1.0, *matrix_of(ask(*handler_, "Schur Mass")), -1.0,
                       *matrix_of(Teko::getBlock(1, 1, K)));
    // S̃⁻¹ = L⁻¹ + M⁻¹ with L = C + B2 D⁻¹ B1ᵀ, M = C + the mass over μ
    return inverse_sum({{1.0, invert(*inverse_, thyra_operator(L), "inverse L", state)},
                        {1.0, invert(*inverse_mass_, thyra_operator(M), "inverse M", state)}});
  }

private:
  Teuchos::RCP<const Teko::InverseFactory> inverse_, inverse_mass_;
  Teuchos::RCP<Teko::RequestHandler> handler_;
};

/// A matrix that somebody else knows to be like S.
class Given final : public SchurInverse {
public:
  Given(const Teuchos::RCP<const Teko::InverseFactory>& inverse,
        const Teuchos::RCP<Teko::RequestHandler>& handler)
      : inverse_(inverse), handler_(handler) {}

  Teko::LinearOp build(const Teko::BlockedLinearOp&,
                       Teko::BlockPreconditionerState& state) const override {
    return invert(*inverse_, ask(*handler_, "Given Schur"), "inverse S", state);
  }

private:
  Teuchos::RCP<const Teko::InverseFactory> inverse_;
  Teuchos::RCP<Teko::RequestHandler> handler_;
};

class OperatorSplitting final : public SchurInverse {
public:
  OperatorSplitting(const Teuchos::RCP<const Teko::InverseFactory>& inverse,
                    const Teuchos::RCP<Teko::RequestHandler>& handler, bool has_stabilisation,
                    bool has_convection)
      : inverse_(inverse), handler_(handler), has_stabilisation_(has_stabilisation),
        has_convection_(has_convection) {}

  Teko::LinearOp build(const Teko::BlockedLinearOp& K,
                       Teko::BlockPreconditionerState& state) const override {
    // L = Δt/ρ Dp (+ C),   M = Mp/μ,   N = Δt/μ Cp
    Teko::LinearOp L = ask(*handler_, "Schur Laplacian");
    if (has_stabilisation_)
      L = thyra_operator(sum(1.0, *matrix_of(L), -1.0, *matrix_of(Teko::getBlock(1, 1, K))));
    const Teko::LinearOp inverse_L = invert(*inverse_, L, "inverse L", state);
    const Teko::LinearOp inverse_M = Teko::getInvDiagonalOp(ask(*handler_, "Schur Mass"));
    // S̃⁻¹ = L⁻¹ + diag(M)⁻¹ (+ diag(M)⁻¹ N L⁻¹)
    std::vector<std::pair<Scalar, InverseOp>> terms{{1.0, inverse_L}, {1.0, inverse_M}};
    if (has_convection_)
      terms.emplace_back(1.0,
                         Teko::multiply(inverse_M, ask(*handler_, "Schur Convection"), inverse_L));
    return inverse_sum(terms);
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
    const auto shear = matrix_of(ask(*handler_, "Schur Mass"));
    const auto bulk = matrix_of(ask(*handler_, "Schur Bulk Mass"));
    // S̃⁻¹ = (diag(M_s)/θ + diag(M_b))⁻¹
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
    need("Schur Mass");
    need("Schur Bulk Mass");
    return std::make_unique<ScaledMass>(handler, list.get<double>("Theta Factor", 1.0));
  }
  const auto inverse =
      library.getInverseFactory(list.get<std::string>("Inverse Schur Type", "Amesos2"));
  if (kind == "Two Scale") {
    need("Schur Mass");
    return std::make_unique<TwoScale>(
        inverse,
        library.getInverseFactory(list.get<std::string>(
            "Inverse Mass Type", list.get<std::string>("Inverse Schur Type"))),
        handler);
  }
  if (kind == "Algebraic") return std::make_unique<Algebraic>(inverse);
  if (kind == "Given") {
    need("Given Schur");
    return std::make_unique<Given>(inverse, handler);
  }
  if (kind == "Operator Splitting") {
    need("Schur Laplacian");
    need("Schur Mass");
    return std::make_unique<OperatorSplitting>(inverse, handler, list.get("Stabilisation", true),
                                               list.get("Convection", false));
  }
  throw std::invalid_argument(
      "\"Schur Complement\" is \"" + kind +
      "\", expected \"Algebraic\", \"Two Scale\", \"Operator Splitting\", \"Scaled Mass\" or "
      "\"Given\".");
}

}  // namespace tunica::linear
