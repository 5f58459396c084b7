#pragma once
#include <string>

#include "tunica/base/outcome.hpp"

namespace tunica::io {

/// Keeps other processes out of a folder, by a file in it that is locked (flock), and says in it
/// who holds it.
///
/// The system gives the lock back however its holder ends, kill -9 among the ways; network file
/// systems pass it on to other hosts. Where one knows no locks, the words in the file must do: the
/// folder is free if they name a process of this host that is no more. A folder that takes no files
/// is not locked. Not collective.
class FolderLock {
public:
  FolderLock() = default;
  ~FolderLock() { give_back(); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Fails where another one holds it, and says who; does nothing where this one does.
  Outcome take(const std::string& folder);
  /// Removes the file, too.
  void give_back();

private:
  std::string path_;
  int file_ = -1;
};

}  // namespace tunica::io
