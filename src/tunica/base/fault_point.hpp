#pragma once

namespace tunica {

/// Marks a place of a run. A message about exhausted memory names the last one passed. And a test
/// can have a rank fail there: TUNICA_FAULT="place:rank[:kind[:pass]]", read once, makes a pass of
/// that rank throw, the first unless a number is given. rank may be "all"; kind is "bad_alloc"
/// (otherwise), "error" or "runtime". A place is a literal without a colon, such as "mesh motion".
void fault_point(const char* place);

/// The last one that this rank has passed; "start" before any.
const char* last_fault_point();

/// Fault points passed during its lifetime are forgotten: for work after a failure whose place is
/// still to be reported.
class KeepsLastFaultPoint {
public:
  KeepsLastFaultPoint() : place_(last_fault_point()) {}
  ~KeepsLastFaultPoint();
  KeepsLastFaultPoint(const KeepsLastFaultPoint&) = delete;
  KeepsLastFaultPoint& operator=(const KeepsLastFaultPoint&) = delete;

private:
  const char* place_;
};

}  // namespace tunica
