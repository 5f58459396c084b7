#include "tunica/params/xml_scan.hpp"

#include <algorithm>

namespace tunica::params {

namespace {

/// Behind the ">" of the tag that begins at start, which may stand in quoted values.
std::size_t end_of_tag(const std::string& text, std::size_t start) {
  char quote = 0;
  for (std::size_t i = start; i < text.size(); ++i) {
    const char c = text[i];
    if (quote == 0 && c == '>') return i + 1;
    if (quote == 0 && (c == '"' || c == '\''))
      quote = c;
    else if (c == quote)
      quote = 0;
  }
  return text.size();
}

/// Behind the given mark.
std::size_t behind(const std::string& text, const std::string& mark, std::size_t start) {
  const std::size_t at = text.find(mark, start);
  return at == std::string::npos ? text.size() : at + mark.size();
}

/// Behind whatever begins with the "<" at start.
std::size_t behind_markup(const std::string& text, std::size_t start) {
  if (text.compare(start, 4, "<!--") == 0) return behind(text, "-->", start + 4);
  return end_of_tag(text, start);
}

int line_at(const std::string& text, std::size_t place) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + place, '\n'));
}

}  // namespace

int line_too_deep(const std::string& text) {
  int depth = 0;
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const std::size_t start = at;
    at = behind_markup(text, start);
    if (text.compare(start, 2, "<?") == 0 || text.compare(start, 2, "<!") == 0) continue;
    if (text.compare(start, 2, "</") == 0)
      --depth;
    else if (text.compare(at - std::min<std::size_t>(at, 2), 2, "/>") != 0)
      ++depth;
    if (depth > deepest_list) return line_at(text, start);
  }
  return 0;
}

int line_of_lost_tag(const std::string& text) {
  for (std::size_t at = 0; at < text.size(); at = behind_markup(text, at)) {
    const std::size_t end = std::min(text.find('<', at), text.size());
    std::size_t first = end;
    for (const char* mark : {"=\"", "='", "/>", "Parameter"})
      first = std::min(first, text.find(mark, at));
    if (first < end) return line_at(text, first);
    at = end;
    if (at == text.size()) break;
  }
  return 0;
}

}  // namespace tunica::params
