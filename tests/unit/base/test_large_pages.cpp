#include <Teuchos_UnitTestHarness.hpp>
#include <numeric>
#include <vector>

#include "tunica/base/large_pages.hpp"

namespace tunica {
namespace {

// The system moves what lies within whole pages; it, its neighbours and short arrays stay as they
// are.
TEUCHOS_UNIT_TEST(large_pages, leave_values_as_they_are) {
  std::vector<int> values(3 << 20);
  std::iota(values.begin(), values.end(), 0);
  const std::vector<int> before = values;
  use_large_pages(values.data() + 5, (values.size() - 12) * sizeof(int));
  TEST_ASSERT(values == before);
  use_large_pages(values);
  TEST_ASSERT(values == before);
  use_large_pages(values.data(), 0);
  use_large_pages(std::vector<int>());
  values.back() = 7;
  TEST_EQUALITY(values.back(), 7);
}

}  // namespace
}  // namespace tunica
