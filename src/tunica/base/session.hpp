#pragma once
#include <Tpetra_Core.hpp>

#include "tunica/base/types.hpp"

namespace tunica {

/// MPI and Kokkos live as long as the one object of it, the first in main().
class Session {
public:
  Session() : scope_(&count_, &names_) {}

private:
  // Kokkos answers --help itself, at length: it gets no arguments.
  char name_[7] = "tunica";
  char* name_list_[2] = {name_, nullptr};
  char** names_ = name_list_;
  int count_ = 1;
  Tpetra::ScopeGuard scope_;
};

/// All ranks of the session.
inline CommPtr all_ranks() { return Tpetra::getDefaultComm(); }

}  // namespace tunica
