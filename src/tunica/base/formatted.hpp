#pragma once
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace tunica {

/// A text of any length by printf's rules.
template <class... Values>
std::string formatted(const char* format, Values... values) {
  const int size = std::snprintf(nullptr, 0, format, values...);
  std::string text(static_cast<std::size_t>(std::max(size, 0)) + 1, '\0');
  std::snprintf(text.data(), text.size(), format, values...);
  text.pop_back();  // the zero at the end
  return text;
}

/// "a", "a and b", "a, b and c".
inline std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  return text;
}

}  // namespace tunica
