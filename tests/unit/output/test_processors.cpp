#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_Core.hpp>

#include "tunica/output/processors.hpp"

namespace {

using namespace tunica;

TEUCHOS_UNIT_TEST(processors, quotas_of_containers_are_read) {
  for (const auto& [text, expected] :
       {std::pair("max 100000\n", 0), std::pair("100000 100000\n", 1),
        std::pair("150000 100000\n", 2), std::pair("400000 50000", 8), std::pair("", 0)})
    TEST_EQUALITY(output::granted_processors(text), expected);
}

TEUCHOS_UNIT_TEST(processors, ranks_that_share_one_are_told_how_to_yield_it) {
  const auto said = [](int ranks, int processors, bool yield) {
    return output::doubt_of({ranks, processors}, yield);
  };
  TEST_EQUALITY(said(2, 2, false), "");
  TEST_EQUALITY(said(2, 1, true), "");
  TEST_EQUALITY(said(2, 1, false).rfind("2 ranks share 1 processor of a machine", 0), 0u);
  TEST_ASSERT(said(8, 4, false).find("OMPI_MCA_mpi_yield_when_idle=1") != std::string::npos);
}

TEUCHOS_UNIT_TEST(processors, ranks_of_a_machine_are_counted) {
  const CommPtr comm = Tpetra::getDefaultComm();
  const output::Processors found = output::scarcest_processors(*comm);
  TEST_EQUALITY(found.ranks, comm->getSize());  // tests run on one machine
  TEST_COMPARE(found.processors, >=, 1);
}

}  // namespace
