#pragma once
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace tunica::mesh {

constexpr int largest_int = std::numeric_limits<int>::max();

/// Reads a text file word by word. Every mistake of the file becomes an Error that begins
/// with "path:line:". Words are separated by white space.
class TextScanner {
public:
  /// Reads the whole file. Lines whose first character is comment are skipped (0: none are).
  explicit TextScanner(const std::string& path, char comment = 0);

  /// True if only white space and comments are left.
  bool is_at_end();
  /// The next word; expected is for the message if the file ends here.
  std::string_view word(const std::string& expected);
  /// The next word, left where it is; empty at the end of the file.
  std::string_view peek();
  long long integer(const std::string& expected);
  /// An integer between low and high.
  int integer(const std::string& expected, int low, int high);
  double real(const std::string& expected);
  /// A number of entries that the rest of the file can hold, at least least_bytes each.
  std::size_t count(const std::string& expected, std::size_t least_bytes);
  /// A word in double quotes, which may hold blanks.
  std::string quoted(const std::string& expected);
  /// What is left of this line, without white space at its ends.
  std::string rest_of_line();
  /// Fails unless the next word is this one.
  void expect(const std::string& expected);

  int line() const { return line_; }
  const std::string& path() const { return path_; }
  [[noreturn]] void fail(const std::string& message) const;

private:
  void skip_space();

  std::string path_;
  std::string text_;
  std::size_t at_ = 0;
  int line_ = 1;
  char comment_;
};

/// The whole content of a regular file; throws Error if it cannot be read.
std::string read_text(const std::string& path);

}  // namespace tunica::mesh
