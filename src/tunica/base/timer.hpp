#pragma once
#include <chrono>

namespace tunica {

/// Wall-clock seconds since its construction.
class Stopwatch {
public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Number and duration of an operation on this rank.
struct Throughput {
  long long items = 0;
  double seconds = 0.0;
};

}  // namespace tunica
