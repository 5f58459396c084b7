#include "tunica/stepping/time_scheme.hpp"

namespace tunica::stepping {

History::History(std::vector<std::string> names, int n_places)
    : names_(std::move(names)), parts_(names_.size() + 1, std::vector<Vec3>(n_places)) {}

std::vector<Vec3> TimeScheme::pasts(const History& history) const {
  std::vector<Vec3> pasts(history.value().size());
  for (std::size_t k = 0; k < pasts.size(); ++k) pasts[k] = past(history, static_cast<int>(k));
  return pasts;
}

}  // namespace tunica::stepping
