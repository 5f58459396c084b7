#pragma once
#include <string>
#include <utility>

#include "tunica/base/formatted.hpp"

namespace tunica {

/// Two numbers that a message compares, with as few digits, at least so many, as tell them apart.
inline std::pair<std::string, std::string> told_apart(double one, double other, int digits = 6) {
  constexpr int all = 17;
  std::pair<std::string, std::string> texts;
  do texts = {formatted("%.*g", digits, one), formatted("%.*g", digits, other)};
  while (texts.first == texts.second && one != other && digits++ < all);
  return texts;
}

}  // namespace tunica
