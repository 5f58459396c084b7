#pragma once
#include <vector>

#include "tunica/algebra/products/sparse_product.hpp"

namespace tunica::smoothers {

/// C + B2 D⁻¹ B1ᵀ, and again for new values on the same graphs. mC holds −C.
class SchurMatrix {
public:
  /// The blocks must outlive the object and keep their graphs. Collective.
  SchurMatrix(const CrsMatrix& B1T, const CrsMatrix& B2, const CrsMatrix& mC,
              const Vector& inverse_D);

  SchurMatrix(const SchurMatrix&) = delete;  // product_ refers to scaled_
  SchurMatrix& operator=(const SchurMatrix&) = delete;

  const Teuchos::RCP<CrsMatrix>& matrix() const { return S_; }
  void refresh(const Vector& inverse_D);

private:
  const CrsMatrix *B1T_, *mC_;
  CrsMatrix scaled_;
  algebra::SparseProduct product_;
  Teuchos::RCP<CrsMatrix> S_;
  std::vector<int> places_of_product_, places_of_mC_;
};

}  // namespace tunica::smoothers
