#pragma once
#include <MueLu_SmootherPrototype.hpp>

#include "tunica/algebra/refreshable.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/multigrid/muelu/xpetra.hpp"

namespace tunica::multigrid {

/// Common base of the smoothers that Tunica adds to MueLu.
class MatrixSmoother : public MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>,
                       public algebra::Refreshable {
public:
  /// Throws std::invalid_argument for a word or number that the smoother does not permit.
  void SetParameterList(const Teuchos::ParameterList& list) override;
  void DeclareInput(MueLu::Level& level) const override;
  void Setup(MueLu::Level& level) override;
  void Apply(XMultiVector& x, const XMultiVector& b, bool is_zero) const override;
  std::size_t getNodeSmootherComplexity() const override { return n_local_entries(*K_); }

protected:
  virtual void check(const Teuchos::ParameterList& list) const = 0;
  /// Both, graphs and values.
  virtual void set_up(int level, const Teuchos::RCP<::tunica::CrsMatrix>& K) = 0;
  virtual void smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const = 0;
  /// Whatever x holds.
  virtual void smooth_from_zero(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const;

private:
  Teuchos::RCP<::tunica::CrsMatrix> K_;  // MueLu's base has names of its own
};

}  // namespace tunica::multigrid
