#pragma once
#include <chrono>
#include <ctime>

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

/// Seconds that processors have worked for this rank since its construction: those of the wall
/// clock also count the work of others.
class ProcessorWatch {
public:
  double seconds() const {
    return static_cast<double>(std::clock() - start_) / static_cast<double>(CLOCKS_PER_SEC);
  }

private:
  std::clock_t start_ = std::clock();
};

/// Number and duration of an operation on this rank.
struct Throughput {
  long long items = 0;
  double seconds = 0.0;
};

}  // namespace tunica
