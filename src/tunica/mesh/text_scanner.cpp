#include "tunica/mesh/text_scanner.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "tunica/base/error.hpp"

namespace tunica::mesh {
namespace {

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// At most 40 characters of a word, for messages.
std::string shown(std::string_view word) {
  std::string text = "\"";
  for (const char c : word.substr(0, 40))
    text += std::isprint(static_cast<unsigned char>(c)) ? c : '?';
  return text + (word.size() > 40 ? "…\"" : "\"");
}

}  // namespace

std::string read_text(const std::string& path) {
  std::error_code code;
  TUNICA_CHECK(std::filesystem::exists(path, code), path + ": no such file");
  TUNICA_CHECK(std::filesystem::is_regular_file(path, code), path + ": not a regular file");
  std::ifstream in(path, std::ios::binary);
  TUNICA_CHECK(in, path + ": cannot be opened for reading");
  const auto size = std::filesystem::file_size(path, code);
  TUNICA_CHECK(!code, path + ": its size cannot be read: " + code.message());
  std::string text(size, '\0');
  in.read(text.data(), static_cast<std::streamsize>(size));
  TUNICA_CHECK(static_cast<std::size_t>(in.gcount()) == size, path + ": reading failed");
  return text;
}

TextScanner::TextScanner(const std::string& path, char comment)
    : path_(path), text_(read_text(path)), comment_(comment) {}

void TextScanner::fail(const std::string& message) const {
  throw Error(path_ + ":" + std::to_string(line_) + ": " + message);
}

void TextScanner::skip_space() {
  while (at_ < text_.size()) {
    const bool starts_line = at_ == 0 || text_[at_ - 1] == '\n';
    if (comment_ != 0 && starts_line && text_[at_] == comment_) {
      while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    } else if (is_space(text_[at_])) {
      if (text_[at_++] == '\n') ++line_;
    } else {
      return;
    }
  }
}

bool TextScanner::is_at_end() {
  skip_space();
  return at_ == text_.size();
}

std::string_view TextScanner::peek() {
  skip_space();
  std::size_t end = at_;
  while (end < text_.size() && !is_space(text_[end])) ++end;
  return std::string_view(text_).substr(at_, end - at_);
}

std::string_view TextScanner::word(const std::string& expected) {
  const std::string_view found = peek();
  if (found.empty()) fail("the file ends here, expected " + expected + ". Is it truncated?");
  at_ += found.size();
  return found;
}

long long TextScanner::integer(const std::string& expected) {
  const std::string_view found = word(expected);
  long long value = 0;
  const auto [end, code] = std::from_chars(found.data(), found.data() + found.size(), value);
  if (code != std::errc() || end != found.data() + found.size())
    fail("found " + shown(found) + ", expected " + expected + " (an integer)");
  return value;
}

int TextScanner::integer(const std::string& expected, int low, int high) {
  const long long value = integer(expected);
  if (value < low || value > high)
    fail(expected + " is " + std::to_string(value) + ", expected " + std::to_string(low) + ".." +
         std::to_string(high));
  return static_cast<int>(value);
}

double TextScanner::real(const std::string& expected) {
  const std::string_view found = word(expected);
  double value = 0.0;
  const auto [end, code] = std::from_chars(found.data(), found.data() + found.size(), value);
  const bool is_whole = end == found.data() + found.size();
  // An underflow is reported as out of range; the value is then as good as zero.
  const bool is_tiny =
      code == std::errc::result_out_of_range &&
      (found.find("e-") != std::string_view::npos || found.find("E-") != std::string_view::npos);
  if (!is_whole || (code != std::errc() && !is_tiny) || !std::isfinite(value))
    fail("found " + shown(found) + ", expected " + expected + " (a finite number)");
  return code == std::errc() ? value : 0.0;
}

std::size_t TextScanner::count(const std::string& expected, std::size_t least_bytes) {
  const long long value = integer(expected);
  if (value < 0) fail(expected + " is " + std::to_string(value) + ", expected 0 or more");
  const std::size_t most = (text_.size() - at_) / least_bytes;
  if (static_cast<unsigned long long>(value) > most || value > std::numeric_limits<int>::max() / 8)
    fail(expected + " is " + std::to_string(value) + ", but the rest of the file can hold only " +
         std::to_string(most) + ". Is it truncated?");
  return static_cast<std::size_t>(value);
}

std::string TextScanner::quoted(const std::string& expected) {
  if (is_at_end() || text_[at_] != '"') fail("expected " + expected + " in double quotes");
  const std::size_t end = text_.find_first_of("\"\n", at_ + 1);
  if (end == std::string::npos || text_[end] != '"')
    fail("expected " + expected + " in double quotes, the second is missing");
  std::string found = text_.substr(at_ + 1, end - at_ - 1);
  at_ = end + 1;
  return found;
}

std::string TextScanner::rest_of_line() {
  std::size_t end = text_.find('\n', at_);
  if (end == std::string::npos) end = text_.size();
  while (at_ < end && is_space(text_[at_])) ++at_;
  std::size_t last = end;
  while (last > at_ && is_space(text_[last - 1])) --last;
  std::string found = text_.substr(at_, last - at_);
  at_ = end;
  return found;
}

void TextScanner::expect(const std::string& expected) {
  const std::string_view found = word(expected);
  if (found != expected) fail("found " + shown(found) + ", expected " + expected);
}

}  // namespace tunica::mesh
