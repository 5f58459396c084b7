#include "tunica/base/fault_point.hpp"

#include <mpi.h>

#include <cstdlib>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tunica/base/error.hpp"

namespace tunica {

namespace {

const char*& last() {
  static const char* place = "start";
  return place;
}

/// What a test asks for.
struct Wish {
  std::string place, rank, kind = "bad_alloc";
  int passes = 1;  ///< to come, with the one that fails
};

Wish read_wish() {
  const char* const text = std::getenv("TUNICA_FAULT");
  if (text == nullptr) return {};
  std::istringstream words(text);
  Wish wish;
  std::getline(words, wish.place, ':');
  std::getline(words, wish.rank, ':');
  if (std::string kind; std::getline(words, kind, ':')) wish.kind = kind;
  words >> wish.passes;
  return wish;
}

bool is_on(const std::string& rank) {
  int is_running = 0, mine = 0;
  MPI_Initialized(&is_running);
  if (is_running != 0) MPI_Comm_rank(MPI_COMM_WORLD, &mine);
  return rank == "all" || rank == std::to_string(mine);
}

}  // namespace

void fault_point(const char* place) {
  static Wish wish = read_wish();
  last() = place;
  if (wish.place != place || --wish.passes > 0 || !is_on(wish.rank)) return;
  wish.place.clear();  // once
  const std::string message = std::string("fault wanted at: ") + place;
  if (wish.kind == "error") throw Error(message);
  if (wish.kind == "runtime") throw std::runtime_error(message);
  throw std::bad_alloc();
}

const char* last_fault_point() { return last(); }

KeepsLastFaultPoint::~KeepsLastFaultPoint() { last() = place_; }

}  // namespace tunica
