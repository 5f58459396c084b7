#pragma once
#include <memory>

#include "tunica/multigrid/muelu/smoothers/ifpack2_sweeps.hpp"
#include "tunica/multigrid/muelu/smoothers/matrix_smoother.hpp"

namespace tunica::multigrid {

/// "FieldSmoother" of a MueLu list, for mixed matrices of a coupled system: block Gauss-Seidel over
/// its parts on each level, with a method of Ifpack2 for each. Known from monolithic solvers as
/// AMG(BGS) [GKW11].
///
///   x ← x + ω R_fᵀ M_f⁻¹ R_f (b − K x)      for each field f in turn
///
/// Keys: "sweeps" (1), "damping" (1.0), and "Fields": a list per field, in their order, with
/// "parts" (Array(string)) and the keys of "Ifpack2Smoother". Together they have all parts.
class FieldSmoother : public MixedSmoother {
public:
  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>> Copy()
      const override;
  void refresh() override;

private:
  struct Field;

  void check(const Teuchos::ParameterList& list) const override;
  void set_up(const ::tunica::CrsMatrix& K, const algebra::DofLayout& numbering) override;
  void smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const override;

  const ::tunica::CrsMatrix* K_ = nullptr;
  std::shared_ptr<std::vector<Field>> fields_;
};

}  // namespace tunica::multigrid
