#pragma once
#include <array>
#include <set>

namespace tunica {

/// The work during which a rank sends.
enum class Work { other, preconditioner, solve, mesh_motion };
constexpr int n_works = 4;

/// Data that this rank has passed to MPI.
struct Traffic {
  long long messages = 0;     ///< from this rank to one other
  long long bytes = 0;        ///< in these
  long long collectives = 0;  ///< calls in which all ranks take part
  std::set<int> partners{};   ///< ranks that were sent to
};

/// Traffic of this process, by work. It is counted only in programs that wrap MPI's functions with
/// counters (output/traffic_report.cpp).
std::array<Traffic, n_works>& traffic();

/// While it lives, what is sent belongs to this work.
class TrafficScope {
public:
  explicit TrafficScope(Work work);
  ~TrafficScope();
  TrafficScope(const TrafficScope&) = delete;
  TrafficScope& operator=(const TrafficScope&) = delete;

  static Work current();

private:
  Work before_;
};

}  // namespace tunica
