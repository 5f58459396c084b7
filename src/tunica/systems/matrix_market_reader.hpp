#pragma once
#include <fstream>
#include <string>
#include <vector>

namespace tunica::systems {

/// The lines of a file in the Matrix Market format, one after the other, and what stands in them. A
/// number is taken whole or not at all, with exponents of C or Fortran (1e3, 1.0D+03). Whatever
/// does not belong there is an Error that names file, line and column.
class MatrixMarketReader {
public:
  /// layout: "coordinate" or "array", which the file must have, of real or integer numbers.
  MatrixMarketReader(const std::string& path, const std::string& layout);

  bool is_symmetric() const { return is_symmetric_; }
  /// So many counts, from the line of sizes.
  std::vector<long long> sizes(std::size_t count);

  /// Goes to the next line that is neither empty nor a comment; says what was expected where there
  /// is none.
  void next_line(const std::string& expected);
  /// The next word of the line.
  long long integer(const std::string& what);
  double number(const std::string& what);
  /// Nothing else stands in the line.
  void end_line();
  /// Nothing else stands in the file.
  void end_file(const std::string& why);

  [[noreturn]] void refuse(const std::string& reason) const;

private:
  bool advance();
  /// Empty at the end of the line.
  std::string word();

  std::string path_;
  std::ifstream file_;
  std::string line_;
  long long line_number_ = 0;
  std::size_t word_ = 0, next_ = 0;  ///< places in the line
  bool is_symmetric_ = false;
};

}  // namespace tunica::systems
