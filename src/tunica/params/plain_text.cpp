#include "tunica/params/plain_text.hpp"

#include <fstream>
#include <iterator>

#include "tunica/base/error.hpp"

namespace tunica::params {

namespace {

constexpr std::string_view mark = "\xef\xbb\xbf";

/// Those of UTF-32 and, without a mark, of UTF-16 have bytes of zero.
bool is_of_wide_characters(std::string_view start) {
  const std::string_view two = start.substr(0, 2);
  return two == "\xff\xfe" || two == "\xfe\xff" ||
         start.substr(0, 4).find('\0') != std::string_view::npos;
}

}  // namespace

std::size_t mark_size(std::string_view start, const std::string& file) {
  TUNICA_CHECK(!is_of_wide_characters(start),
               file +
                   ": its characters have two or four bytes (UTF-16, UTF-32), expected UTF-8. "
                   "Save it as UTF-8, in PowerShell by \"Out-File -Encoding utf8\".");
  return start.substr(0, mark.size()) == mark ? mark.size() : 0;
}

std::string plain_text(const std::string& text, const std::string& file) {
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t i = mark_size(text, file); i < text.size(); ++i) {
    const bool is_return = text[i] == '\r';
    if (is_return && i + 1 < text.size() && text[i + 1] == '\n') continue;
    plain += is_return ? '\n' : text[i];
  }
  return plain;
}

std::string read_plain_text(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  TUNICA_CHECK(in, file + ": cannot be read.");
  return plain_text({std::istreambuf_iterator<char>(in), {}}, file);
}

void begin_text(std::istream& in, const std::string& file) {
  if (!in) return;
  std::string head(4096, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  in.clear();
  in.seekg(static_cast<std::streamoff>(mark_size(head, file)));
  const std::size_t last = head.find_last_not_of("\r\n");
  const std::size_t first = head.find_first_of("\r\n");
  const bool has_lines = first != std::string::npos && last != std::string::npos && first < last;
  TUNICA_CHECK(!has_lines || head.find('\n') != std::string::npos,
               file +
                   ": its lines end with a carriage return alone, expected a line feed. Save it "
                   "with line ends of Unix or Windows.");
}

}  // namespace tunica::params
