#pragma once
#include <functional>

#include "tunica/algebra/block_matrix.hpp"

namespace tunica::linear {

/// The part of low rank of a block matrix K on the vectors that a solver works on.
class LowRankForm {
public:
  /// Takes the blocks of a vector to the first column of a long one.
  using Gather = std::function<void(const algebra::BlockVector&, MultiVector&)>;

  /// K has such a part and outlives the object. map: of the long vectors.
  LowRankForm(const algebra::BlockMatrix& K, const Teuchos::RCP<const Map>& map, Gather gather);

  /// The present values.
  algebra::LowRank take() const;

private:
  std::shared_ptr<const algebra::LowRank> blocks_;
  algebra::BlockSpacePtr long_space_;  ///< one block
  Gather gather_;
};

/// A + W S Vᵀ on long vectors.
class LowRankSum final : public Operator {
public:
  LowRankSum(const Teuchos::RCP<const Operator>& A, const LowRankForm& form)
      : A_(A), form_(form), L_(form.take()) {}

  /// Takes over the present values of K.
  void refresh() { L_ = form_.take(); }

  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode = Teuchos::NO_TRANS,
             Scalar alpha = 1.0, Scalar beta = 0.0) const override;
  Teuchos::RCP<const Map> getDomainMap() const override { return A_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return A_->getRangeMap(); }

private:
  Teuchos::RCP<const Operator> A_;
  LowRankForm form_;
  algebra::LowRank L_;
};

/// An inverse or a preconditioner P⁻¹ of the blocks K made one of all, by Sherman, Morrison and
/// Woodbury:
///
///   (I − Z D Vᵀ) P⁻¹,   K Z = W,   D = (I + S VᵀZ)⁻¹ S
///
/// The bracket is (K + W S Vᵀ)⁻¹ K. With the inverse P = K this is the inverse of the sum; with any
/// other P the preconditioned sum (K + W S Vᵀ)(I − Z D Vᵀ) P⁻¹ = K P⁻¹ is that of the blocks: a
/// Krylov method, or a fixed point, does as it would without the part of low rank.
class LowRankInverse final : public Operator {
public:
  /// z ≈ K⁻¹ w; z holds that of the set-up before, or zeros.
  using Solve = std::function<void(const Vector& w, Vector& z)>;

  explicit LowRankInverse(LowRankForm form) : form_(std::move(form)), correction_(form_.take()) {}

  /// Sets up for the present values with one solve for each product. False where the sum is
  /// singular or a solve gives no numbers: then the object is P⁻¹ alone. Collective.
  bool refresh(const Teuchos::RCP<const Operator>& P_inverse, const Solve& solve);

  /// The columns of Z; none before the first set-up.
  const std::vector<Vector>& solutions() const { return Z_; }
  /// Takes those of another run for the next set-up, as many as it has solves, or none.
  void set_solutions(std::vector<Vector> Z);

  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode = Teuchos::NO_TRANS,
             Scalar alpha = 1.0, Scalar beta = 0.0) const override;
  Teuchos::RCP<const Map> getDomainMap() const override { return P_inverse_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return P_inverse_->getRangeMap(); }

private:
  LowRankForm form_;
  Teuchos::RCP<const Operator> P_inverse_;
  algebra::LowRank correction_;  ///< −Z D Vᵀ
  std::vector<Vector> Z_;
};

}  // namespace tunica::linear
