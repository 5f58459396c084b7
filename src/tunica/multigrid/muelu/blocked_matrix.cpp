#include "tunica/multigrid/muelu/blocked_matrix.hpp"

#include <Xpetra_MapExtractorFactory.hpp>
#include <Xpetra_MultiVectorFactory.hpp>
#include <Xpetra_StridedMapFactory.hpp>
#include <array>
#include <stdexcept>

#include "tunica/base/agreement.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::multigrid {

namespace {

using XMap = Xpetra::Map<LocalOrdinal, GlobalOrdinal, Node>;
using StridedMaps = Xpetra::StridedMapFactory<LocalOrdinal, GlobalOrdinal, Node>;
using Extractor = Xpetra::MapExtractor<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

/// The rows or columns of each block and of all, as MueLu wants them described.
struct Side {
  std::vector<Teuchos::RCP<const XMap>> maps;
  Teuchos::RCP<const Extractor> extractor;

  Side(const Map& all, const algebra::DofLayout& numbering) {
    // Blocks keep the merged numbers, dofs·node + k, of which each has its stride of components.
    std::vector<std::size_t> striding;
    for (int b = 0; b < numbering.n_blocks(); ++b) striding.push_back(numbering.components(b));
    const auto strided = [&](const std::vector<GlobalOrdinal>& numbers, int block) {
      return StridedMaps::Build(
          Xpetra::UseTpetra, Teuchos::OrdinalTraits<Xpetra::global_size_t>::invalid(),
          Teuchos::arrayViewFromVector(numbers), 0, striding, all.getComm(), block);
    };
    std::vector<std::vector<GlobalOrdinal>> numbers(numbering.n_blocks());
    std::vector<GlobalOrdinal> every;
    for (const GlobalOrdinal number : global_numbers(all)) {
      numbers[numbering.block_of(number)].push_back(number);
      every.push_back(number);
    }
    for (int b = 0; b < numbering.n_blocks(); ++b) maps.push_back(strided(numbers[b], b));
    // -1: the map of all blocks.
    extractor = Xpetra::MapExtractorFactory<Scalar, LocalOrdinal, GlobalOrdinal, Node>::Build(
        strided(every, -1), maps);
  }
};

/// The entries of M in the rows and columns of these blocks.
Teuchos::RCP<CrsMatrix> block_of(const CrsMatrix& M, const algebra::DofLayout& numbering,
                                 const std::array<int, 2>& blocks, const Side& rows,
                                 const Side& columns) {
  const auto row_map = Xpetra::toTpetra(rows.maps[blocks[0]]);
  const auto result = Teuchos::rcp(new CrsMatrix(row_map, longest_local_row(M)));
  const auto local = M.getLocalMatrixHost();
  std::vector<GlobalOrdinal> numbers;
  std::vector<Scalar> values;
  for (int i = 0; i < local.numRows(); ++i) {
    const GlobalOrdinal row_number = M.getRowMap()->getGlobalElement(i);
    if (numbering.block_of(row_number) != blocks[0]) continue;
    const auto row = local.rowConst(i);
    numbers.clear();
    values.clear();
    for (int k = 0; k < row.length; ++k) {
      const GlobalOrdinal number = M.getColMap()->getGlobalElement(row.colidx(k));
      if (numbering.block_of(number) != blocks[1]) continue;
      // Entries of a static graph that are zero couple nothing; a diagonal has to be there.
      if (row.value(k) == 0.0 && number != row_number) continue;
      numbers.push_back(number);
      values.push_back(row.value(k));
    }
    result->insertGlobalValues(row_number, Teuchos::arrayViewFromVector(numbers),
                               Teuchos::arrayViewFromVector(values));
  }
  result->fillComplete(Xpetra::toTpetra(columns.maps[blocks[1]]), row_map);
  return result;
}

}  // namespace

Teuchos::RCP<XBlockedMatrix> blocked(const CrsMatrix& M, const algebra::DofLayout& numbering) {
  // M = [M_rc], each block with the strides of its rows and columns
  Side rows(*M.getRangeMap(), numbering), columns(*M.getDomainMap(), numbering);
  // Xpetra asks for extractors it may change.
  const auto result = Teuchos::rcp(new XBlockedMatrix(rows.extractor, columns.extractor, 0));
  for (int r = 0; r < numbering.n_blocks(); ++r)
    for (int c = 0; c < numbering.n_blocks(); ++c) {
      const auto part = block_of(M, numbering, {r, c}, rows, columns);
      if (part->getGlobalNumEntries() == 0) continue;
      const auto block = wrapped(part);
      block->CreateView("stridedMaps", rows.maps[r], columns.maps[c]);
      result->setMatrix(r, c, block);
    }
  result->fillComplete();
  return result;
}

// Near-null space of a block: e_i at all nodes, the translations of a vector, the constant of a
// scalar.
Teuchos::RCP<XMultiVector> constants(const XBlockedMatrix& A, int block, int components) {
  const auto map = A.getRangeMap(block);
  const auto vectors =
      Xpetra::MultiVectorFactory<Scalar, LocalOrdinal, GlobalOrdinal, Node>::Build(map, components);
  const auto view = unwrapped(*vectors)->getLocalViewHost(overwrite_all);
  for (std::size_t row = 0; row < view.extent(0); ++row)
    for (int i = 0; i < components; ++i)
      view(row, i) = static_cast<int>(row) % components == i ? 1.0 : 0.0;
  return vectors;
}

void set_blocks(MueLu::Level& finest, const CrsMatrix& A, const algebra::DofLayout& numbering) {
  const Map& rows = *A.getRowMap();
  // MueLu counts the rows of a strided map by components, and takes each node for whole.
  bool is_whole = true;
  GlobalOrdinal expected = 0;  // component
  for (const GlobalOrdinal number : global_numbers(rows)) {
    if (numbering.is_scalar(number)) continue;
    is_whole &= number % numbering.dofs() == expected;
    expected = (expected + 1) % numbering.components(0);
  }
  throw_if_any<std::runtime_error>(
      *rows.getComm(), is_whole && expected == 0
                           ? ""
                           : "\"matrix\" = \"blocked\" needs all components at each vector node.");
  const auto blocks = blocked(A, numbering);
  finest.Set<Teuchos::RCP<XMatrix>>("A", blocks);
  for (int b = 0; b < numbering.n_blocks(); ++b)
    finest.Set("Nullspace" + std::to_string(b + 1), constants(*blocks, b, numbering.components(b)));
}

}  // namespace tunica::multigrid
