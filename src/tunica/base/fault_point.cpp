#include "tunica/base/fault_point.hpp"

#include <mpi.h>

#include <cstdlib>
#include <new>
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
  std::string place, kind;
  int rank = -1;
};

Wish read_wish() {
  const char* const text = std::getenv("TUNICA_FAULT");
  if (text == nullptr) return {};
  const std::string words = text;
  const auto first = words.find(':'), second = words.find(':', first + 1);
  if (first == std::string::npos) return {};
  Wish wish;
  wish.place = words.substr(0, first);
  wish.rank = std::atoi(words.c_str() + first + 1);
  wish.kind = second == std::string::npos ? "bad_alloc" : words.substr(second + 1);
  return wish;
}

bool is_on(int rank) {
  int is_running = 0, mine = 0;
  MPI_Initialized(&is_running);
  if (is_running != 0) MPI_Comm_rank(MPI_COMM_WORLD, &mine);
  return mine == rank;
}

}  // namespace

void fault_point(const char* place) {
  static Wish wish = read_wish();
  last() = place;
  if (wish.place != place || !is_on(wish.rank)) return;
  wish.place.clear();  // once
  const std::string message = std::string("fault wanted at: ") + place;
  if (wish.kind == "error") throw Error(message);
  if (wish.kind == "runtime") throw std::runtime_error(message);
  throw std::bad_alloc();
}

const char* last_fault_point() { return last(); }

}  // namespace tunica
