#pragma once
#include <map>
#include <string>
#include <vector>

#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// Replaces numbers by positions among those that are in use, ascending, and returns these as tags;
/// one without name is called kind-number: "region-7", "surface-11".
std::vector<Tag> number_tags(std::map<int, std::string> names, const std::string& kind,
                             std::vector<int>& numbers);

}  // namespace tunica::mesh
