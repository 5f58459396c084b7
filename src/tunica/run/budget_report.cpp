#include "tunica/run/budget_report.hpp"

#include "tunica/base/formatted.hpp"
#include "tunica/io/messages.hpp"

namespace tunica::run {

void BudgetReport::step(const stepping::Clock& clock, const discretisation::Observables& row,
                        const observe::Budget& budget, const RunLog& log) {
  if (!table_) {
    std::vector<std::string> columns{"step", "time", "step_size"};
    for (const auto& o : row) columns.push_back(o.name);
    table_ = std::make_unique<io::CsvTable>(output_->folder.file("budget.csv"), columns, is_root_,
                                            output_->steps_done());
  }
  std::vector<io::Cell> cells{clock.step(), clock.time(), clock.step_size()};
  for (const auto& o : row) cells.emplace_back(o.value);
  table_->row(cells);
  output::RunRecord& record = output_->record;
  for (const observe::Verdict& v : budget.verdicts()) {
    record.set("budget", v.of, std::vector<double>{v.amount, v.whole, v.part, v.bound});
    record.set("budget verdicts", v.of, observe::text_of(v));
    if (v.of != "mass" || v.is_kept() || has_warned_) continue;
    log.warn(
        formatted("mass is not kept: %.2g of what has flowed through the fluid so far is lost "
                  "or gained, permitted is %.2g (budget.csv). Solve more accurately, with "
                  "smaller tolerances of Newton's methods, or balance what is prescribed at "
                  "the openings of a closed fluid.",
                  v.part, v.bound));
    has_warned_ = true;
  }
  for (const auto& o : budget.energies())
    record.set("budget of energy [kPa mm^3]", o.name, o.value);
}

void BudgetReport::finish(const observe::Budget& budget) const {
  if (!is_root_ || !table_) return;
  for (const observe::Verdict& v : budget.verdicts()) {
    const std::string line = "budget of " + observe::text_of(v);
    if (v.is_of_solver && !v.is_kept())
      io::print_error_line("warning: " + line);
    else
      io::print_line(line);
  }
}

}  // namespace tunica::run
