#include "linear/known_keys.hpp"

#include <algorithm>
#include <stdexcept>

#include "params/nearest.hpp"

namespace tunica::linear {

void check_keys(const Teuchos::ParameterList& list, const std::vector<std::string>& known) {
  for (auto it = list.begin(); it != list.end(); ++it)
    if (std::find(known.begin(), known.end(), list.name(it)) == known.end())
      throw std::invalid_argument("unknown key \"" + list.name(it) + "\". " +
                                  params::did_you_mean(list.name(it), known));
}

}  // namespace tunica::linear
