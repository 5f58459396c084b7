#pragma once
#include <Ifpack2_Preconditioner.hpp>

#include "tunica/base/types.hpp"

namespace tunica::multigrid {

/// x += M⁻¹ (b − K x) with a method of Ifpack2, which follows new values of K without finding its
/// graphs again. Factorisations, which look at the rows of their rank only, get those of others by
/// additive Schwarz.
class Ifpack2Sweeps {
public:
  /// list: "type", "overlap" and "ParameterList", as checked. Sets up. Collective.
  Ifpack2Sweeps(const Teuchos::ParameterList& list, const Teuchos::RCP<CrsMatrix>& K);

  /// Adds these keys to what a factory knows.
  static void declare(Teuchos::ParameterList& list);
  /// Throws std::invalid_argument.
  static void check(const Teuchos::ParameterList& list);

  void refresh();
  void smooth(const MultiVector& b, MultiVector& x) const;

private:
  Teuchos::RCP<CrsMatrix> K_;
  Teuchos::RCP<Ifpack2::Preconditioner<Scalar, LocalOrdinal, GlobalOrdinal, Node>> method_;
  bool has_overlap_;
};

}  // namespace tunica::multigrid
