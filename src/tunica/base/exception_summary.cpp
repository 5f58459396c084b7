#include "tunica/base/exception_summary.hpp"

#include <algorithm>

namespace tunica {

std::string exception_summary(std::string text) {
  const std::size_t preamble = text.find("Throw test that evaluated to true");
  if (preamble != std::string::npos)
    text.erase(0, std::min(text.find('\n', preamble), text.size()));
  text.erase(0, std::min(text.find_first_not_of(" \n"), text.size()));
  text.erase(std::min(text.find('\n'), text.size()));
  return text.empty() ? "an exception without a message" : text;
}

}  // namespace tunica
