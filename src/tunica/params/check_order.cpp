#include "tunica/params/check_order.hpp"

#include "tunica/base/error.hpp"
#include "tunica/base/told_apart.hpp"

namespace tunica::params {

void check_order(const Teuchos::ParameterList& list, const std::string& path,
                 const std::string& smaller, const std::string& larger) {
  const double low = list.get<double>(smaller), high = list.get<double>(larger);
  const auto [found, most] = told_apart(low, high);
  TUNICA_CHECK(low <= high, path + ": \"" + smaller + "\" is " + found + ", more than \"" + larger +
                                "\", which is " + most + ".");
}

}  // namespace tunica::params
