#include "tunica/multigrid/muelu/validated_choice.hpp"

#include <algorithm>
#include <stdexcept>

#include "tunica/params/nearest.hpp"

namespace tunica::multigrid {

std::string validated_choice(const std::string& smoother, const Teuchos::ParameterList& list,
                             const std::string& key, const std::vector<std::string>& known) {
  const auto& value = list.get<std::string>(key);
  if (std::find(known.begin(), known.end(), value) == known.end())
    throw std::invalid_argument(smoother + ": \"" + key + "\" is \"" + value +
                                "\", expected one of " + params::quoted(known) + ".");
  return value;
}

}  // namespace tunica::multigrid
