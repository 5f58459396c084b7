#pragma once
#include <Tpetra_Core.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tunica/base/types.hpp"

namespace tunica::output::test {

inline CommPtr world() { return Tpetra::getDefaultComm(); }

/// A name in a folder of the build, of its own for each number of ranks. Collective: what an
/// earlier test left there is gone on return.
inline std::string scratch(const std::string& name) {
  const CommPtr comm = world();
  const std::string path = TUNICA_TEST_SCRATCH "/np" + std::to_string(comm->getSize()) + "/" + name;
  comm->barrier();
  if (comm->getRank() == 0) std::filesystem::remove_all(path);
  comm->barrier();
  return path;
}

inline std::string content(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace tunica::output::test
