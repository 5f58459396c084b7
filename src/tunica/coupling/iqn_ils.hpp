#pragma once
#include <deque>

#include "tunica/coupling/accelerator.hpp"

namespace tunica::coupling {

/// Interface quasi-Newton with the inverse Jacobian from a least-squares model:
///
///   d ← d + (W − V) c + P (r + V c),   c = argmin |r + V c|
///
///   P    preconditioner of what the model leaves
///   V = [r_k − r_{k−1}, …]    changes of the residual       mm
///   W = [d̃_k − d̃_{k−1}, …]    changes of the wall's answer  mm
///
/// newest first; columns of earlier steps follow those of the present one if they are reused.
/// Nearly dependent columns are dropped. Without any column the update is a relaxation. An
/// update is cut short where it is many times as long as the last one of its step.
///
/// Source: [DBV] Degroote, Bathe, Vierendeels 2009, where P is the identity; filter after [HBD]
/// Haelterman et al. 2016.
class IqnIls : public Accelerator {
public:
  IqnIls(const Teuchos::ParameterList& list, const CommPtr& comm);

  void begin_step() override;
  InterfaceVector next(const InterfaceVector& d, const InterfaceVector& residual) override;
  void end_step() override;
  void forget() override;
  void save(fields::State& state) const override;
  void restore(const fields::State& state) override;
  double relaxation() const override { return relaxation_; }
  int columns() const override { return columns_; }

private:
  double length(const InterfaceVector& x) const;
  /// Cuts the update from d to next_d to this length.
  void bound(const InterfaceVector& d, double most, InterfaceVector& next_d);
  void remember(const InterfaceVector& answer, const InterfaceVector& residual);
  void keep_steps(int most);

  CommPtr comm_;
  double first_factor_, filter_, update_growth_;
  int reused_steps_;
  bool is_first_ = true;
  InterfaceVector last_d_, last_residual_, last_answer_;
  std::deque<InterfaceVector> V_, W_;  ///< newest first
  std::deque<int> columns_of_step_;    ///< newest first; front is the present step
  double relaxation_ = 0.0;
  int columns_ = 0;
};

params::Table iqn_ils_table();

}  // namespace tunica::coupling
