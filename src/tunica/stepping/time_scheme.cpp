#include "tunica/stepping/time_scheme.hpp"

namespace tunica::stepping {

History::History(std::vector<std::string> names, int n_places)
    : names_(std::move(names)), parts_(names_.size() + 1, std::vector<Vec3>(n_places)) {}

}  // namespace tunica::stepping
