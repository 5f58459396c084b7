#include <mpi.h>

#include <Teuchos_UnitTestHarness.hpp>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>

#include "tunica/base/error.hpp"
#include "tunica/base/fault_point.hpp"
#include "tunica/base/out_of_memory.hpp"

using namespace tunica;

namespace {

TEUCHOS_UNIT_TEST(fault_point, fails_once_where_a_test_wants_it_and_is_remembered) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  setenv("TUNICA_FAULT", "the middle:0:error:2", 1);  // before the first one: it is read once
  fault_point("the start");
  fault_point("the middle");
  if (rank == 0)
    TEST_THROW(fault_point("the middle"), Error)
  else
    fault_point("the middle");
  TEST_EQUALITY(std::string(last_fault_point()), "the middle");
  fault_point("the middle");
  fault_point("the end");
  {
    const KeepsLastFaultPoint kept;
    fault_point("behind the end");
  }
  TEST_EQUALITY(out_of_memory_text(),
                "out of memory on rank " + std::to_string(rank) + " (the end)");
}

TEUCHOS_UNIT_TEST(out_of_memory, is_recognised_also_in_the_words_of_others) {
  TEST_ASSERT(is_out_of_memory(std::bad_alloc()));
  TEST_ASSERT(is_out_of_memory(std::runtime_error("Kokkos failed to allocate memory for label x")));
  TEST_ASSERT(is_out_of_memory(std::logic_error("caught in a factory: std::bad_alloc")));
  TEST_ASSERT(!is_out_of_memory(std::runtime_error("the matrix is singular")));
}

}  // namespace
