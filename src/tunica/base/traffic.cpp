#include "tunica/base/traffic.hpp"

namespace tunica {

namespace {
Work current_work = Work::other;
}

std::array<Traffic, n_works>& traffic() {
  static std::array<Traffic, n_works> counted;
  return counted;
}

TrafficScope::TrafficScope(Work work) : before_(current_work) { current_work = work; }
TrafficScope::~TrafficScope() { current_work = before_; }
Work TrafficScope::current() { return current_work; }

}  // namespace tunica
