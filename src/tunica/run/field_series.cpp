#include "tunica/run/field_series.hpp"

#include "tunica/io/messages.hpp"

namespace tunica::run {

FieldSeries::FieldSeries(const RunOutput& output, const std::vector<output::Grid>& grids,
                         const CommPtr& comm)
    : every_(output.settings.fields_every) {
  if (every_ == 0 && !output.settings.wants_fields_at_times()) return;
  writer_.emplace(output.folder.path(), grids, comm, output.steps_done());
  writer_->compress(output.settings.compression);
  if (comm->getRank() == 0 && !writer_->remark().empty())
    io::print_error_line("warning: " + writer_->remark());
}

bool FieldSeries::is_due(const stepping::Clock& clock) const {
  return writer_ &&
         (clock.is_asked_for() || (every_ > 0 && (clock.is_every(every_) || clock.is_last())));
}

void FieldSeries::write(const stepping::Clock& clock, std::vector<observe::GridFields> fields) {
  for (observe::GridFields& f : fields)
    writer_->write(clock.step(), clock.time(), f.grid, std::move(f.points), std::move(f.cells));
  writer_->finish_step();
}

void FieldSeries::finish() {
  if (writer_) writer_->finish();
}

}  // namespace tunica::run
