#include "tunica/params/nearest.hpp"

#include <algorithm>
#include <cctype>

namespace tunica::params {

namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

int edit_distance(const std::string& from, const std::string& to) {
  const std::size_t columns = to.size() + 1;
  std::vector<int> before(columns), last(columns), row(columns);
  for (std::size_t j = 0; j < columns; ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= from.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j < columns; ++j) {
      const int replaced = last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[to.size()];
}

std::string nearest(const std::string& name, const std::vector<std::string>& valid) {
  const std::string wanted = lower(name);
  std::string best;
  int best_distance = 3;
  for (const std::string& candidate : valid) {
    const int distance = edit_distance(wanted, lower(candidate));
    const std::size_t length = std::max(name.size(), candidate.size());
    if (distance < best_distance && static_cast<std::size_t>(distance) < length) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string quoted(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "\"" : ", \"") + name + "\"";
  return text;
}

std::string did_you_mean(const std::string& name, const std::vector<std::string>& valid) {
  const std::string best = nearest(name, valid);
  if (!best.empty()) return "Did you mean \"" + best + "\"?";
  return valid.empty() ? "No key is valid here." : "Valid: " + quoted(valid) + ".";
}

}  // namespace tunica::params
