#include "tunica/params/known_keys.hpp"

#include <algorithm>
#include <stdexcept>

#include "tunica/params/nearest.hpp"

namespace tunica::params {

void check_keys(const Teuchos::ParameterList& list, const std::vector<std::string>& known,
                const std::string& owner) {
  const std::string start = owner.empty() ? "" : owner + ": ";
  for (auto it = list.begin(); it != list.end(); ++it)
    if (std::find(known.begin(), known.end(), list.name(it)) == known.end())
      throw std::invalid_argument(start + "unknown key \"" + list.name(it) + "\". " +
                                  did_you_mean(list.name(it), known));
}

}  // namespace tunica::params
