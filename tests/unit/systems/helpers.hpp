#pragma once
#include <Teuchos_DefaultSerialComm.hpp>
#include <Tpetra_Core.hpp>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <string>

#include "tunica/base/error.hpp"
#include "tunica/base/types.hpp"
#include "unit/multigrid/complaint.hpp"

namespace tunica::systems_tests {

constexpr std::size_t at_once = 3;  ///< lines of a file

inline CommPtr world() { return Tpetra::getDefaultComm(); }
/// Each rank for itself.
inline CommPtr alone() { return Teuchos::rcp(new Teuchos::SerialComm<int>); }

/// A file of its own that is there for all ranks as long as this is.
class File {
public:
  explicit File(const std::string& text)
      : path("np" + std::to_string(world()->getSize()) + "_" + std::to_string(count++) + ".mtx") {
    if (world()->getRank() == 0) std::ofstream(path) << text;
    world()->barrier();
  }
  ~File() {
    world()->barrier();
    if (world()->getRank() == 0) std::remove(path.c_str());
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  const std::string path;

private:
  static inline int count = 0;
};

/// What is refused, as this rank is told.
template <class Work>
std::string refusal(const Work& work) {
  return test::complaint<Error>(work);
}

inline bool says(const std::string& reason, const std::string& what) {
  return reason.find(what) != std::string::npos;
}

}  // namespace tunica::systems_tests
