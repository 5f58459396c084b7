#pragma once
#include <string>

namespace tunica {

/// The telling line of what an exception says: Trilinos puts its source lines before it.
std::string exception_summary(std::string text);

}  // namespace tunica
