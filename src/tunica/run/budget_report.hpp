#pragma once
#include <memory>

#include "tunica/observe/budget.hpp"
#include "tunica/run/run_log.hpp"

namespace tunica::run {

/// budget.csv, and what is said of the totals: on the screen and in run.json.
class BudgetReport {
public:
  BudgetReport(RunOutput& output, bool is_root) : output_(&output), is_root_(is_root) {}

  /// The row of a step, and the totals up to it. The first time that mass is lost beyond its bound
  /// there is a warning.
  void step(const stepping::Clock& clock, const discretisation::Observables& row,
            const observe::Budget& budget, const RunLog& log);
  /// The verdicts at the end of the run; what solvers have left beyond its bound is a warning.
  void finish(const observe::Budget& budget) const;

private:
  RunOutput* output_;
  bool is_root_;
  std::unique_ptr<io::CsvTable> table_;
  bool has_warned_ = false;
};

}  // namespace tunica::run
