#pragma once
#include "tunica/coupling/accelerator.hpp"

namespace tunica::coupling {

/// d ← d + ω r with a constant ω.
class ConstantRelaxation : public Accelerator {
public:
  ConstantRelaxation(const Teuchos::ParameterList& list, const CommPtr&)
      : factor_(list.get<double>("factor")) {}

  void begin_step() override {}
  InterfaceVector next(const InterfaceVector& d, const InterfaceVector& residual) override;
  void end_step() override {}
  double relaxation() const override { return factor_; }
  int columns() const override { return 0; }

private:
  double factor_;
};

params::Table constant_relaxation_table();

}  // namespace tunica::coupling
