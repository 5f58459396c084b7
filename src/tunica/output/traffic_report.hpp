#pragma once
#include "tunica/output/run_record.hpp"

namespace tunica::output {

/// Forgets what was sent so far.
void restart_traffic();

/// Writes what a rank has sent in a step, in the mean over `steps` of them since the restart, as
/// the section "traffic of a rank and step": for each work messages, kilobytes, collective calls,
/// and the ranks it sent to, of the rank that has most of each. Collective.
void record_traffic(RunRecord& record, int steps, const Comm& comm);

}  // namespace tunica::output
