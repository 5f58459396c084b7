#pragma once
#include <string>

namespace tunica {

/// One-line summary of the text of an exception, without the source lines that Trilinos puts before
/// it.
std::string exception_summary(std::string text);

}  // namespace tunica
