#pragma once
#include <string>

namespace tunica {

/// The telling line of what an exception says: Trilinos puts its source lines before it.
std::string telling_line(std::string text);

}  // namespace tunica
