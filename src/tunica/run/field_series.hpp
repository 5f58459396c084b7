#pragma once
#include <optional>
#include <vector>

#include "tunica/observe/field.hpp"
#include "tunica/output/field_writer.hpp"
#include "tunica/run/run_output.hpp"
#include "tunica/stepping/clock.hpp"

namespace tunica::run {

/// The time series of the fields, as often as the case wants them.
class FieldSeries {
public:
  /// Collective.
  FieldSeries(const RunOutput& output, const std::vector<output::Grid>& grids, const CommPtr& comm);

  bool is_due(const stepping::Clock& clock) const;
  /// Collective.
  void write(const stepping::Clock& clock, std::vector<observe::GridFields> fields);
  /// At the end of a run. Collective.
  void finish();

private:
  int every_;
  std::optional<output::FieldWriter> writer_;
};

}  // namespace tunica::run
