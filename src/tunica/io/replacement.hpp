#pragma once
#include <string>

namespace tunica::io {

/// A file in the making: written under a temporary name, renamed by commit(), removed if
/// commit() is never reached. The old file stays until then.
class Replacement {
public:
  explicit Replacement(const std::string& path);
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  /// Where to write.
  const std::string& temporary() const { return temporary_; }
  void commit();

private:
  std::string path_;
  std::string temporary_;
  bool is_committed_ = false;
};

/// Writes a file as a whole, or throws Error and leaves nothing.
void write_bytes(const std::string& path, const std::string& content);

}  // namespace tunica::io
