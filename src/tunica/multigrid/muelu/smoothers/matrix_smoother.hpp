#pragma once
#include <MueLu_SmootherPrototype.hpp>
#include <string>
#include <vector>

#include "tunica/algebra/refreshable.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"
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
  /// Where it computes residuals faster than the matrix of the level, with which it lives.
  virtual void offer_residuals(LevelMatrix&) const {}
  virtual void smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const = 0;
  /// Whatever x holds.
  virtual void smooth_from_zero(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const;

private:
  Teuchos::RCP<::tunica::CrsMatrix> K_;  // MueLu's base has names of its own
};

/// A smoother for mixed matrices.
class MixedSmoother : public MatrixSmoother {
public:
  /// Says how unknowns are numbered; before Setup().
  void set_coarsening(const Teuchos::RCP<MixedCoarsening>& coarsening) { coarsening_ = coarsening; }

protected:
  /// Hosts of the matrix, see MixedCoarsening.
  const Teuchos::RCP<const ::tunica::Vector>& hosts() const { return hosts_; }
  const MixedCoarsening& coarsening() const { return *coarsening_; }
  ::tunica::Vector parts(const ::tunica::CrsMatrix& K) const {
    return coarsening_->parts(level_, K);
  }
  virtual void set_up(const ::tunica::CrsMatrix& K, const algebra::DofLayout& numbering) = 0;

private:
  void set_up(int level, const Teuchos::RCP<::tunica::CrsMatrix>& K) final {
    coarsening_->check_mixed(level, *K);
    hosts_ = coarsening_->hosts(level, *K);
    level_ = level;
    set_up(*K, coarsening_->numbering());
  }

  Teuchos::RCP<MixedCoarsening> coarsening_;
  Teuchos::RCP<const ::tunica::Vector> hosts_;
  int level_ = 0;
};

/// The value of a key of a smoother's list. Throws std::invalid_argument, which lists the known
/// words, for any other.
std::string validated_choice(const std::string& smoother, const Teuchos::ParameterList& list,
                             const std::string& key, const std::vector<std::string>& known);

}  // namespace tunica::multigrid
