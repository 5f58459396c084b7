#include "tunica/mesh/formats/text_scanner.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/params/plain_text.hpp"

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

constexpr std::size_t longest_word = 1 << 16;

}  // namespace

TextScanner::TextScanner(const std::string& path, char comment, std::size_t piece)
    : path_(path), comment_(comment), piece_(piece) {
  std::error_code code;
  TUNICA_CHECK(std::filesystem::exists(path, code), path + ": no such file");
  TUNICA_CHECK(std::filesystem::is_regular_file(path, code), path + ": not a regular file");
  file_.open(path, std::ios::binary);
  TUNICA_CHECK(file_, path + ": cannot be opened for reading");
  left_ = static_cast<long long>(std::filesystem::file_size(path, code));
  TUNICA_CHECK(!code, path + ": its size cannot be read: " + code.message());
  while (text_.size() < 4 && refill()) {
  }
  text_.erase(0, params::mark_size(text_, path));
}

bool TextScanner::refill() {
  if (at_ > 0) before_ = text_[at_ - 1];
  text_.erase(0, at_);
  at_ = 0;
  const std::size_t kept = text_.size();
  const auto wanted = std::min(static_cast<long long>(piece_), left_);
  text_.resize(kept + static_cast<std::size_t>(wanted));
  file_.read(text_.data() + kept, wanted);
  TUNICA_CHECK(file_.gcount() == wanted, path_ + ": reading failed");
  left_ -= wanted;
  return wanted > 0;
}

void TextScanner::fail(const std::string& message) const {
  throw Error(path_ + ":" + std::to_string(line_) + ": " + message);
}

void TextScanner::skip_space() {
  bool is_comment = false;
  for (;; ++at_) {
    if (at_ == text_.size() && !refill()) return;
    const char c = text_[at_];
    const bool begins_line = before() == '\n' || before() == '\r';
    if (comment_ != 0 && begins_line && c == comment_) is_comment = true;
    if (c == '\n' || c == '\r') {
      is_comment = false;
      if (c == '\r' || before() != '\r') ++line_;  // "\r\n" is one end
    } else if (!is_comment && !is_space(c)) {
      return;
    }
  }
}

std::size_t TextScanner::find(const char* characters, std::size_t from) {
  for (;;) {
    const std::size_t found = text_.find_first_of(characters, from);
    if (found != std::string::npos) return found;
    from = text_.size() - at_;  // where the new piece begins
    if (!refill()) return text_.size();
  }
}

bool TextScanner::is_at_end() {
  skip_space();
  return at_ == text_.size();
}

std::string_view TextScanner::peek() {
  skip_space();
  std::size_t length = 0;
  while (length < longest_word) {
    if (at_ + length == text_.size() && !refill()) break;
    if (is_space(text_[at_ + length])) break;
    ++length;
  }
  return std::string_view(text_).substr(at_, length);
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

long long TextScanner::count(const std::string& expected, int least_bytes) {
  const long long value = integer(expected);
  if (value < 0) fail(expected + " is " + std::to_string(value) + ", expected 0 or more");
  const long long most = (left_ + static_cast<long long>(text_.size() - at_)) / least_bytes;
  if (value > most)
    fail(expected + " is " + std::to_string(value) + ", but the rest of the file can hold only " +
         std::to_string(most) + ". Is it truncated?");
  return value;
}

std::string TextScanner::quoted(const std::string& expected) {
  if (is_at_end() || text_[at_] != '"') fail("expected " + expected + " in double quotes");
  ++at_;
  const std::size_t end = find("\"\r\n", at_);
  if (end == text_.size() || text_[end] != '"')
    fail("expected " + expected + " in double quotes, the second is missing");
  std::string found = text_.substr(at_, end - at_);
  at_ = end + 1;
  return found;
}

std::string TextScanner::rest_of_line() {
  const std::size_t end = find("\r\n", at_);
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
