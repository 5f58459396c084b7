#include "tunica/params/xml_depth.hpp"

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

}  // namespace

int line_too_deep(const std::string& text) {
  int depth = 0;
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const std::size_t start = at;
    if (text.compare(at, 4, "<!--") == 0) {
      at = behind(text, "-->", at + 4);
    } else if (text.compare(at, 2, "<?") == 0 || text.compare(at, 2, "<!") == 0) {
      at = end_of_tag(text, at);
    } else {
      at = end_of_tag(text, at);
      if (text.compare(start, 2, "</") == 0)
        --depth;
      else if (text.compare(at - std::min<std::size_t>(at, 2), 2, "/>") != 0)
        ++depth;
    }
    if (depth > deepest_list)
      return 1 + static_cast<int>(std::count(text.begin(), text.begin() + start, '\n'));
  }
  return 0;
}

}  // namespace tunica::params
