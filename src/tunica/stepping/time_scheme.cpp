#include "tunica/stepping/time_scheme.hpp"

namespace tunica::stepping {

History::History(std::vector<std::string> names, int n_places)
    : names_(std::move(names)), parts_(names_.size() + 1, std::vector<Vec3>(n_places)) {}

namespace {

template <class ValueAt>
std::vector<Vec3> all_of(const History& history, const ValueAt& value_at) {
  std::vector<Vec3> values(history.value().size());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = value_at(static_cast<int>(k));
  return values;
}

}  // namespace

std::vector<Vec3> TimeScheme::pasts(const History& history) const {
  return all_of(history, [&](int place) { return past(history, place); });
}

std::vector<Vec3> TimeScheme::predictions(const History& history) const {
  return all_of(history, [&](int place) { return prediction(history, place); });
}

}  // namespace tunica::stepping
