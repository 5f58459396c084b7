#include "tunica/base/out_of_memory.hpp"

#include <mpi.h>

#include <cstdlib>
#include <new>

#include "tunica/base/fault_point.hpp"

namespace tunica {

namespace {

constexpr std::size_t aside = 4 << 20;  ///< bytes; only the address space is really taken

void*& memory_aside() {
  static void* memory = nullptr;
  return memory;
}

/// For std::set_new_handler.
void give_back() {
  std::free(memory_aside());
  memory_aside() = nullptr;
  throw std::bad_alloc();
}

}  // namespace

bool is_out_of_memory(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return true;
  const std::string text = error.what();
  for (const char* sign : {"std::bad_alloc", "failed to allocate", "out of memory"})
    if (text.find(sign) != std::string::npos) return true;
  return false;
}

std::string out_of_memory_text() {
  int rank = 0, is_running = 0;
  MPI_Initialized(&is_running);
  if (is_running != 0) MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return "out of memory on rank " + std::to_string(rank) + " (" + last_fault_point() + ")";
}

void set_memory_aside() {
  if (memory_aside() == nullptr) memory_aside() = std::malloc(aside);
  std::set_new_handler(give_back);
}

}  // namespace tunica
