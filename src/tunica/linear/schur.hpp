#pragma once
#include <Teko_BlockPreconditionerFactory.hpp>
#include <memory>

namespace tunica::linear {

/// By this name a strategy asks for the number of vector unknowns of a node, an int: row
/// components*node + i of A is unknown i.
constexpr const char* components_request = "Vector Components";

/// Approximates the inverse of the Schur complement S = C + B2 A⁻¹ B1ᵀ of a 2×2 block system
/// [A B1ᵀ; B2 −C].
class SchurInverse {
public:
  virtual ~SchurInverse() = default;
  /// S̃⁻¹ for the present values of K; state keeps what can be used again.
  virtual Teko::LinearOp build(const Teko::BlockedLinearOp& K,
                               Teko::BlockPreconditionerState& state) const = 0;
};

/// The approximation that a strategy's list describes: its key "Schur Complement" is
///
///   Algebraic           C + B2 diag(A)⁻¹ B1ᵀ, inverted by "Inverse Schur Type"
///   Two Scale           S̃⁻¹ = (C + B2 D⁻¹ B1ᵀ)⁻¹ + (C + M)⁻¹ with D the lumped inertia in A (its
///                       row sums per component) and the operator "Schur Mass" for M, inverted by
///                       "Inverse Schur Type" and "Inverse Mass Type"; [CC88] with stabilisation
///   Operator Splitting  S̃⁻¹ = L⁻¹ + diag(M)⁻¹ (+ diag(M)⁻¹ N L⁻¹ with "Convection"), with the
///                       operators "Schur Laplacian", "Schur Mass", "Schur Convection";
///                       "Stabilisation" adds C to L, which "Inverse Schur Type" inverts
///                       ([LY1] eq:rpreschur without it)
///   Given               the operator "Given Schur" for S̃, inverted by "Inverse Schur Type"
///   Scaled Mass         diag(M_s)/"Theta Factor" + diag(M_b), with the operators
///                       "Schur Mass" and "Schur Bulk Mass" ([LY1] eq:lpreschur)
///
/// Throws std::invalid_argument that lists the known ones for any other value.
std::unique_ptr<SchurInverse> make_schur_inverse(Teuchos::ParameterList& list,
                                                 const Teko::InverseLibrary& library,
                                                 const Teuchos::RCP<Teko::RequestHandler>& handler);

}  // namespace tunica::linear
