#pragma once
#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Operator.hpp>
#include <Tpetra_Vector.hpp>

namespace tunica {

using Scalar = double;
using LocalOrdinal = int;
using GlobalOrdinal = long long;

using Map = Tpetra::Map<LocalOrdinal, GlobalOrdinal>;
using Node = Map::node_type;
using Import = Tpetra::Import<LocalOrdinal, GlobalOrdinal, Node>;
using Vector = Tpetra::Vector<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
using MultiVector = Tpetra::MultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
using Operator = Tpetra::Operator<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
using CrsGraph = Tpetra::CrsGraph<LocalOrdinal, GlobalOrdinal, Node>;
using CrsMatrix = Tpetra::CrsMatrix<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
using RowMatrix = Tpetra::RowMatrix<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

using Comm = Teuchos::Comm<int>;
using CommPtr = Teuchos::RCP<const Comm>;

// How a view of a vector on the host will be used: v.getLocalViewHost(read_only).
constexpr auto read_only = Tpetra::Access::ReadOnly;
constexpr auto read_write = Tpetra::Access::ReadWrite;
constexpr auto overwrite_all = Tpetra::Access::OverwriteAll;

constexpr auto insert = Tpetra::INSERT;  ///< imported values replace those at the target

}  // namespace tunica
