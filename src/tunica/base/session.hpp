#pragma once
#include <mpi.h>

#include <Teuchos_BLAS.hpp>
#include <Tpetra_Core.hpp>

#include "tunica/base/types.hpp"

namespace tunica {

/// MPI and Kokkos live as long as the one object of it, the first in main().
class Session {
public:
  Session() : scope_(&count_, &names_) {
    warm_up_blas();
    if (Tpetra::getDefaultComm()->getSize() > 1) warm_up_files();
  }

private:
  /// OpenBLAS takes its buffer at the first call and keeps it. Where it gets none it asks for ever:
  /// better here, before there is any work, than later on one of the ranks.
  static void warm_up_blas() {
    const double one = 1.0;
    double x = 1.0;
    Teuchos::BLAS<int, double>().TRSM(Teuchos::LEFT_SIDE, Teuchos::UPPER_TRI, Teuchos::NO_TRANS,
                                      Teuchos::NON_UNIT_DIAG, 1, 1, 1.0, &one, 1, &x, 1);
  }

  /// Open MPI loads what it needs for files with the first one. Where one of the ranks has no
  /// memory for that later on, it takes something else than the others, and all wait for ever.
  static void warm_up_files() {
    MPI_File file = MPI_FILE_NULL;
    if (MPI_File_open(MPI_COMM_SELF, "/dev/null", MPI_MODE_WRONLY, MPI_INFO_NULL, &file) ==
        MPI_SUCCESS)
      MPI_File_close(&file);
  }

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
