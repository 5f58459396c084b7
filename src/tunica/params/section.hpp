#pragma once
#include <string>

namespace tunica::params {

/// Those parts of what Table::print_markdown() has printed that are about a list, "Fluid/Surfaces",
/// and the lists in it; or the row of a key, "Fluid/density". Free names may be anything. Throws
/// tunica::Error with the nearest name where there is none.
std::string section_of(const std::string& reference, const std::string& path);

}  // namespace tunica::params
