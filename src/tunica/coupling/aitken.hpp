#pragma once
#include "tunica/coupling/accelerator.hpp"

namespace tunica::coupling {

/// Dynamic relaxation
///
///   d_k = d_{k−1} + ω_{k−1} r_k,
///   ω_k = −(d_k − d_{k−1})·(r_{k+1} − r_k) / |r_{k+1} − r_k|²
///
///   r_k  preconditioned interface residual of iteration k  mm        ω_k  relaxation factor  1
///
/// Source: [LY1] eq:acceit, eq:dnomega (after Küttler and Wall 2008), where d_k − d_{k−1} is
/// written ω_{k−1} r_k; here the coupling may have cut the update short. Deviation: the factor is
/// kept within bounds, and a step begins with the first factor, or with the last one of the step
/// before, as the keys say.
class Aitken : public Accelerator {
public:
  Aitken(const Teuchos::ParameterList& list, const CommPtr& comm);

  void begin_step() override;
  InterfaceVector next(const InterfaceVector& d, const InterfaceVector& residual) override;
  void end_step() override {}
  void save(fields::State& state) const override;
  void restore(const fields::State& state) override;
  double relaxation() const override { return factor_; }
  int columns() const override { return 0; }

private:
  CommPtr comm_;
  double first_factor_, smallest_factor_, largest_factor_;
  bool restarts_;
  double factor_;
  bool is_first_ = true;  ///< no residual of this step yet
  InterfaceVector last_d_, last_residual_;
};

params::Table aitken_table();

}  // namespace tunica::coupling
