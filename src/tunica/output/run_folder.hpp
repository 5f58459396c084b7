#pragma once
#include <string>

#include "tunica/base/types.hpp"

namespace tunica::output {

/// The folder that receives everything a run writes.
///
/// Files that are there stay until a writer of this run replaces the one of its name: run/ asks
/// first whether it may. Only a run that is restarted adds to them.
class RunFolder {
public:
  /// Rank 0 creates the folder with its parents and checks that files can be written there.
  /// Throws tunica::Error on all ranks if that fails. Collective.
  RunFolder(const std::string& path, const CommPtr& comm);

  const std::string& path() const { return path_; }

  /// Path of a file in the folder.
  std::string file(const std::string& name) const;

private:
  std::string path_;
};

}  // namespace tunica::output
