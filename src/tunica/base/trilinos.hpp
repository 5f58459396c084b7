#pragma once
#include <Trilinos_version.h>

#include "tunica/base/types.hpp"

/// Names that differ between Trilinos 13 and its successors. No version is asked for elsewhere,
/// except where a signature really differs.
namespace tunica {

#if TRILINOS_MAJOR_VERSION < 14

/// Numbers of the calling rank.
inline std::size_t n_local(const Map& map) { return map.getNodeNumElements(); }
inline Teuchos::ArrayView<const GlobalOrdinal> global_numbers(const Map& map) {
  return map.getNodeElementList();
}

/// Rows and entries of the calling rank.
inline std::size_t n_local_rows(const RowMatrix& A) { return A.getNodeNumRows(); }
inline std::size_t n_local_rows(const CrsGraph& A) { return A.getNodeNumRows(); }
inline std::size_t n_local_entries(const RowMatrix& A) { return A.getNodeNumEntries(); }
inline std::size_t longest_local_row(const RowMatrix& A) { return A.getNodeMaxNumRowEntries(); }
inline std::size_t longest_local_row(const CrsGraph& A) { return A.getNodeMaxNumRowEntries(); }

#else

inline std::size_t n_local(const Map& map) { return map.getLocalNumElements(); }
inline Teuchos::ArrayView<const GlobalOrdinal> global_numbers(const Map& map) {
  return map.getLocalElementList();
}
inline std::size_t n_local_rows(const RowMatrix& A) { return A.getLocalNumRows(); }
inline std::size_t n_local_rows(const CrsGraph& A) { return A.getLocalNumRows(); }
inline std::size_t n_local_entries(const RowMatrix& A) { return A.getLocalNumEntries(); }
inline std::size_t longest_local_row(const RowMatrix& A) { return A.getLocalMaxNumRowEntries(); }
inline std::size_t longest_local_row(const CrsGraph& A) { return A.getLocalMaxNumRowEntries(); }

#endif

}  // namespace tunica
