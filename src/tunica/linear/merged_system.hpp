#pragma once
#include <functional>

#include "tunica/algebra/merged_matrix.hpp"
#include "tunica/algebra/products/grouped_matrix.hpp"
#include "tunica/linear/preconditioned_system.hpp"

namespace tunica::linear {

/// A preconditioner of one matrix.
class MatrixPreconditioner {
public:
  virtual ~MatrixPreconditioner() = default;

  /// Sets up for the present values. Throws SetupFailure where they do not permit it. Collective.
  virtual void refresh() = 0;
  /// Null: none.
  virtual Teuchos::RCP<const Operator> as_operator() const = 0;
  /// Levels of a multigrid hierarchy. Collective.
  virtual multigrid::Levels levels() const { return {}; }
  /// Estimated bytes of the factors of a direct solver. Collective.
  virtual double expected_bytes() const { return 0.0; }
  /// As PreconditionedSystem has it.
  virtual bool note(int iterations, double reduction) {
    static_cast<void>(iterations);
    static_cast<void>(reduction);
    return false;
  }
  virtual bool may_improve() const { return false; }
  /// As LinearSolver has them.
  virtual std::vector<double> save() const { return {}; }
  virtual void restore(const std::vector<double>& numbers) { static_cast<void>(numbers); }
};

/// One matrix with the unknowns of a node side by side, and a preconditioner of it.
class MergedSystem final : public PreconditionedSystem {
public:
  using Maker =
      std::function<std::unique_ptr<MatrixPreconditioner>(const Teuchos::RCP<CrsMatrix>&)>;

  MergedSystem(const algebra::BlockMatrix& K, const Maker& make)
      : K_(K), matrix_(Teuchos::rcp(new algebra::GroupedMatrix(K_.matrix()))),
        preconditioner_(make(K_.matrix())) {}

  Teuchos::RCP<const Map> map() const override { return K_.matrix()->getRowMap(); }
  Teuchos::RCP<const Operator> matrix() const override { return matrix_; }
  Teuchos::RCP<const Operator> preconditioner() const override {
    return preconditioner_->as_operator();
  }
  void refresh_matrix() override { K_.refresh(); }
  void refresh_preconditioner() override { preconditioner_->refresh(); }
  double expected_bytes() const override { return preconditioner_->expected_bytes(); }
  multigrid::Levels levels() const override { return preconditioner_->levels(); }
  bool note(int iterations, double reduction) override {
    return preconditioner_->note(iterations, reduction);
  }
  bool may_improve() const override { return preconditioner_->may_improve(); }
  std::vector<double> save() const override { return preconditioner_->save(); }
  void restore(const std::vector<double>& numbers) override { preconditioner_->restore(numbers); }
  void gather(const algebra::BlockVector& x, MultiVector& all) const override { K_.merge(x, all); }
  void scatter(const MultiVector& all, algebra::BlockVector& x) const override { K_.split(all, x); }

private:
  algebra::MergedMatrix K_;
  Teuchos::RCP<const Operator> matrix_;
  std::unique_ptr<MatrixPreconditioner> preconditioner_;
};

}  // namespace tunica::linear
