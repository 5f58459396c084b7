#pragma once
#include <cstddef>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

namespace tunica::mesh {

constexpr int largest_int = std::numeric_limits<int>::max();

/// Reads a text file word by word, and never has more of it than a piece or a line. Every mistake
/// of the file becomes an Error that begins with "path:line:". Words are separated by white space;
/// what is longer than any number or name comes as several. A byte-order mark of UTF-8 is passed
/// over, and lines may end with a carriage return alone.
class TextScanner {
public:
  /// Lines whose first character is comment are skipped (0: none are). Throws Error if it is not
  /// a file that can be read. piece: bytes that are read at once.
  explicit TextScanner(const std::string& path, char comment = 0,
                       std::size_t piece = std::size_t{1} << 20);

  /// True if only white space and comments are left.
  bool is_at_end();
  /// The next word, which is there until the next call; expected is for the message if the file
  /// ends here.
  std::string_view word(const std::string& expected);
  /// The next word, left where it is; empty at the end of the file.
  std::string_view peek();
  long long integer(const std::string& expected);
  /// An integer between low and high.
  int integer(const std::string& expected, int low, int high);
  double real(const std::string& expected);
  /// A number of entries that the rest of the file can hold, at least least_bytes each.
  long long count(const std::string& expected, int least_bytes);
  /// A word in double quotes, which may hold blanks.
  std::string quoted(const std::string& expected);
  /// The rest of this line, without white space at its ends.
  std::string rest_of_line();
  /// Fails unless the next word is this one.
  void expect(const std::string& expected);

  long long line() const { return line_; }
  const std::string& path() const { return path_; }
  [[noreturn]] void fail(const std::string& message) const;

private:
  void skip_space();
  /// The character that stands before the next one.
  char before() const { return at_ > 0 ? text_[at_ - 1] : before_; }
  /// Drops what was taken and reads the next piece behind the rest; false at the end of the file.
  bool refill();
  /// Where the first of these characters stands; the end of the text if there is none.
  std::size_t find(const char* characters, std::size_t from);

  std::string path_;
  std::ifstream file_;
  long long left_ = 0;  ///< bytes that were not read yet
  std::string text_;
  std::size_t at_ = 0;  ///< in the text
  char before_ = '\n';  ///< the character before the text
  long long line_ = 1;
  char comment_;
  std::size_t piece_;
};

}  // namespace tunica::mesh
