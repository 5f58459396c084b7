#include "tunica/systems/matrix_market_reader.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/params/plain_text.hpp"

namespace tunica::systems {

namespace {

constexpr const char* blank = " \t\r";

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

template <class Number>
bool is_whole(const std::string& text, Number& value) {
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+');
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(begin, end, value);
  return error == std::errc() && last == end;
}

}  // namespace

MatrixMarketReader::MatrixMarketReader(const std::string& path, const std::string& layout)
    : path_(path), file_(path) {
  TUNICA_CHECK(file_, path + ": cannot be read.");
  if (file_.get() == 0x1f && file_.get() == 0x8b)
    throw Error(path + ": is compressed. Unpack it first, with gunzip.");
  file_.clear();
  file_.seekg(0);
  params::begin_text(file_, path);
  ++line_number_;
  std::getline(file_, line_);
  const std::string head = lower(word()), object = lower(word()), found = lower(word()),
                    field = lower(word()), symmetry = lower(word());
  if (head != "%%matrixmarket" || object != "matrix") {
    word_ = 0;  // where the line begins
    refuse("no Matrix Market file: expected a first line \"%%MatrixMarket matrix " + layout +
           " real general\"");
  }
  if (found != layout) refuse("the layout is \"" + found + "\", expected \"" + layout + "\"");
  if (field != "real" && field != "double" && field != "integer")
    refuse("the field is \"" + field + "\", expected \"real\" or \"integer\"");
  is_symmetric_ = symmetry == "symmetric";
  if (symmetry != "general" && !(is_symmetric_ && layout == "coordinate"))
    refuse("the symmetry is \"" + symmetry + "\", expected \"general\"" +
           (layout == "coordinate" ? " or \"symmetric\"" : ""));
  end_line();
}

void MatrixMarketReader::refuse(const std::string& reason) const {
  throw Error(path_ + ":" + std::to_string(line_number_) + ":" + std::to_string(word_ + 1) + ": " +
              reason + ".");
}

bool MatrixMarketReader::advance() {
  while (std::getline(file_, line_)) {
    ++line_number_;
    word_ = next_ = 0;
    const std::size_t first = line_.find_first_not_of(blank);
    if (first != std::string::npos && line_[first] != '%') return true;
  }
  ++line_number_;
  line_.clear();
  word_ = next_ = 0;
  return false;
}

void MatrixMarketReader::next_line(const std::string& expected) {
  if (!advance()) refuse("the file ends, expected " + expected);
}

std::string MatrixMarketReader::word() {
  word_ = std::min(line_.find_first_not_of(blank, next_), line_.size());
  next_ = std::min(line_.find_first_of(blank, word_), line_.size());
  return line_.substr(word_, next_ - word_);
}

long long MatrixMarketReader::integer(const std::string& what) {
  const std::string text = word();
  long long value = 0;
  if (!is_whole(text, value)) refuse("expected " + what + ", found \"" + text + "\"");
  return value;
}

double MatrixMarketReader::number(const std::string& what) {
  const std::string text = word();
  std::string in_c = text;
  const auto is_fortrans = [](char c) { return c == 'D' || c == 'd'; };
  std::replace_if(in_c.begin(), in_c.end(), is_fortrans, 'e');
  double value = 0.0;
  if (!is_whole(in_c, value)) refuse("expected " + what + ", found \"" + text + "\"");
  if (!std::isfinite(value)) refuse(what + " is not finite");
  return value;
}

void MatrixMarketReader::end_line() {
  const std::string rest = word();
  if (!rest.empty()) refuse("\"" + rest + "\" does not belong here");
}

void MatrixMarketReader::end_file(const std::string& why) {
  if (advance()) refuse("a line too many: " + why);
}

std::vector<long long> MatrixMarketReader::sizes(std::size_t count) {
  next_line("the line of sizes");
  std::vector<long long> all;
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(integer("a size"));
    if (all.back() < 0) refuse("the size is negative");
  }
  end_line();
  return all;
}

}  // namespace tunica::systems
