#pragma once
#include <fstream>
#include <string>

#include "tunica/base/outcome.hpp"

namespace tunica::io {

/// A file in the making: it grows as "<path>.tmp", gets its name by commit(), and is removed if
/// that fails or is never reached. A reader sees the old file or the new one, never a part.
///
/// Nothing throws: the reason of a failure names the file, so that ranks can agree on it first. Not
/// collective.
class AtomicFile {
public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// "<path>.tmp", for those that write to it by other means.
  static std::string draft_of(const std::string& path) { return path + ".tmp"; }

  /// Appends to the draft. A failure is kept for close() and commit().
  void add(const std::string& text);
  /// Ends what add() does.
  Outcome close();
  /// Gives the draft its name.
  Outcome commit();
  /// Gives the draft its name once it is on the disk; the folder is flushed too, otherwise a power
  /// failure could undo the name.
  Outcome commit_to_disk();

private:
  void note_failure();

  std::string path_, draft_;
  std::ofstream file_;
  Outcome outcome_ = Outcome::success();
  bool is_committed_ = false;
};

/// Replaces a file of a run by the text in one step. Returns as AtomicFile does.
Outcome replace_file(const std::string& path, const std::string& text);

/// Replaces a file that the user has named. Throws Error that begins with the path, and leaves all
/// as it was.
void write_file(const std::string& path, const std::string& text);

/// Renames "fields.h5" to "fields.old.h5", or to "fields.old-2.h5" where that is taken, and so on:
/// nothing is overwritten. The new path, or what went wrong. Not collective.
Result<std::string> set_aside(const std::string& path);

/// ": No space left on device" from errno, or empty if errno says nothing.
std::string system_reason();

}  // namespace tunica::io
