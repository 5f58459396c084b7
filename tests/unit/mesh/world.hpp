#pragma once
#include <Tpetra_Core.hpp>

#include "tunica/base/types.hpp"

namespace tunica::mesh {

inline CommPtr world() { return Tpetra::getDefaultComm(); }

}  // namespace tunica::mesh
