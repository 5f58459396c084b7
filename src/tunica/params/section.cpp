#include "tunica/params/section.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/params/nearest.hpp"

namespace tunica::params {

namespace {

constexpr const char* free_name = "(any name)";

struct Section {
  std::vector<std::string> path;  ///< without the name of the whole
  std::string text;
};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  std::istringstream words(path);
  for (std::string part; std::getline(words, part, '/');)
    if (!trimmed(part).empty()) parts.push_back(trimmed(part));
  return parts;
}

std::vector<Section> sections_of(const std::string& reference) {
  std::vector<Section> sections;
  std::istringstream lines(reference);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("## ", 0) == 0) {
      std::vector<std::string> path = parts_of(line.substr(3, line.find(", `") - 3));
      path.erase(path.begin());
      sections.push_back({path, ""});
    }
    if (!sections.empty()) sections.back().text += line + "\n";
  }
  return sections;
}

/// True where the path of a section begins with that one.
bool begins_with(const std::vector<std::string>& path, const std::vector<std::string>& head) {
  return path.size() >= head.size() &&
         std::equal(head.begin(), head.end(), path.begin(),
                    [](const std::string& wanted, const std::string& its) {
                      return its == free_name || its == wanted;
                    });
}

/// The keys of sections at exactly this path, or their rows.
std::vector<std::pair<std::string, std::string>> rows_at(const std::vector<Section>& sections,
                                                         const std::vector<std::string>& path) {
  std::vector<std::pair<std::string, std::string>> rows;
  for (const Section& section : sections) {
    if (section.path.size() != path.size() || !begins_with(section.path, path)) continue;
    std::istringstream lines(section.text);
    for (std::string line; std::getline(lines, line);)
      if (line.rfind("| `", 0) == 0) rows.emplace_back(line.substr(3, line.find('`', 3) - 3), line);
  }
  return rows;
}

std::string row_of(const std::vector<Section>& sections, const std::vector<std::string>& path) {
  const std::vector<std::string> list(path.begin(), path.end() - 1);
  std::string text;
  for (const auto& [key, row] : rows_at(sections, list))
    if (key == path.back() && text.find(row) == std::string::npos) text += row + "\n";
  if (text.empty()) return "";
  return "| key | type | default | range, unit | meaning |\n|---|---|---|---|---|\n" + text;
}

[[noreturn]] void fail(const std::vector<Section>& sections, const std::vector<std::string>& path) {
  std::vector<std::string> known;
  for (const std::string& part : path) {
    std::vector<std::string> names;
    for (const auto& [key, row] : rows_at(sections, known))
      if (std::find(names.begin(), names.end(), key) == names.end()) names.push_back(key);
    known.push_back(part);
    const auto is_there = [&](const Section& s) { return begins_with(s.path, known); };
    if (std::any_of(sections.begin(), sections.end(), is_there)) continue;
    throw Error("the reference has no \"" + part + "\" there. " + did_you_mean(part, names));
  }
  throw Error("the reference has no such list.");
}

}  // namespace

std::string section_of(const std::string& reference, const std::string& path) {
  const std::vector<Section> sections = sections_of(reference);
  const std::vector<std::string> parts = parts_of(path);
  TUNICA_CHECK(!parts.empty(), "\"" + path + "\" names no list, expected one like Fluid/Surfaces");
  std::string text;
  // Choices of one key may have the same list, as conditions have Amplitude: it is printed once.
  for (const Section& section : sections)
    if (begins_with(section.path, parts) && text.find(section.text) == std::string::npos)
      text += section.text;
  if (text.empty()) text = row_of(sections, parts);
  if (text.empty()) fail(sections, parts);
  return text;
}

}  // namespace tunica::params
