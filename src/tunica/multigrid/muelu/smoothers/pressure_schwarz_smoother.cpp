#include "tunica/multigrid/muelu/smoothers/pressure_schwarz_smoother.hpp"

#include <Ifpack2_Factory.hpp>
#include <Xpetra_MapExtractorFactory.hpp>
#include <Xpetra_MapFactory.hpp>

#include "tunica/base/trilinos.hpp"

namespace tunica::multigrid {

namespace {

using XMap = Xpetra::Map<LocalOrdinal, GlobalOrdinal, Node>;
using Extractor = Xpetra::MapExtractor<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
using BlockedVectors = Xpetra::BlockedMultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

/// The same blocks; the rows of all of them are numbered one block after the other.
Teuchos::RCP<XBlockedMatrix> block_after_block(const XBlockedMatrix& A) {
  const Teuchos::RCP<const XMap> u = A.getRangeMap(0), p = A.getRangeMap(1);
  std::vector<GlobalOrdinal> numbers;
  for (const auto& map : {u, p})
    for (const GlobalOrdinal number : global_numbers(*Xpetra::toTpetra(map)))
      numbers.push_back(number);
  const Teuchos::RCP<const XMap> all = Xpetra::MapFactory<LocalOrdinal, GlobalOrdinal, Node>::Build(
      Xpetra::UseTpetra, Teuchos::OrdinalTraits<Xpetra::global_size_t>::invalid(),
      Teuchos::arrayViewFromVector(numbers), 0, u->getComm());
  Teuchos::RCP<const Extractor> extractor =
      Xpetra::MapExtractorFactory<Scalar, LocalOrdinal, GlobalOrdinal, Node>::Build(all, {u, p});
  const auto result = Teuchos::rcp(new XBlockedMatrix(extractor, extractor, 0));
  for (int r = 0; r < 2; ++r)
    for (int c = 0; c < 2; ++c) result->setMatrix(r, c, A.getMatrix(r, c));
  result->fillComplete();
  return result;
}

const std::string patch_list = "subdomain solver parameters";

/// Which patch the rows are seeds of, -1 none.
struct Seeds {
  Teuchos::ArrayRCP<LocalOrdinal> patch;
  int n_patches = 0;

  Seeds(const CrsMatrix& A, int n_vector_rows) : patch(n_local_rows(A), -1) {
    // A row that is coupled to nothing makes no patch of its own; all other pressures do.
    const auto local = A.getLocalMatrixHost();
    std::vector<int> uncovered_rows;
    for (int i = 0; i < local.numRows(); ++i) {
      const bool is_uncovered = !has_neighbours(A, i, i < n_vector_rows);
      if (is_uncovered) uncovered_rows.push_back(i);
      if (!is_uncovered && i >= n_vector_rows) patch[i] = n_patches++;
    }
    // All uncovered rows make one patch: Ifpack2 writes outside of its vectors for a single row.
    if (uncovered_rows.size() > 1 || n_patches == 0) ++n_patches;
    // A single one goes with the last pressure, with which it has nothing in common.
    for (const int row : uncovered_rows) patch[row] = n_patches - 1;
  }

private:
  /// Own ones only, or those of other ranks as well.
  static bool has_neighbours(const CrsMatrix& A, int i, bool counts_ghosts) {
    const auto row = A.getLocalMatrixHost().rowConst(i);
    const GlobalOrdinal own = A.getRowMap()->getGlobalElement(i);
    for (int k = 0; k < row.length; ++k) {
      const GlobalOrdinal number = A.getColMap()->getGlobalElement(row.colidx(k));
      const bool counts = counts_ghosts || A.getRowMap()->isNodeGlobalElement(number);
      if (number != own && counts && row.value(k) != 0.0) return true;
    }
    return false;
  }
};

/// The blocks of x, one after the other; x holds blocks itself or numbers them as A does.
void gather(const Extractor& extractor, const XMultiVector& x, MultiVector& all) {
  const auto to = all.getLocalViewHost(overwrite_all);
  auto whole = Teuchos::rcpFromRef(x);
  std::size_t next = 0;
  for (std::size_t b = 0; b < extractor.NumMaps(); ++b) {
    const auto part = extractor.ExtractVector(whole, b, false);
    const auto from = unwrapped(*part)->getLocalViewHost(read_only);
    for (std::size_t i = 0; i < from.extent(0); ++i, ++next)
      for (std::size_t c = 0; c < from.extent(1); ++c) to(next, c) = from(i, c);
  }
}

void scatter(const Extractor& extractor, const MultiVector& all, XMultiVector& x) {
  const auto from = all.getLocalViewHost(read_only);
  const bool has_blocks = dynamic_cast<BlockedVectors*>(&x) != nullptr;
  auto whole = Teuchos::rcpFromRef(x);
  std::size_t next = 0;
  for (std::size_t b = 0; b < extractor.NumMaps(); ++b) {
    const auto part = extractor.ExtractVector(whole, b, false);  // a copy without blocks
    {
      const auto to = unwrapped(*part)->getLocalViewHost(overwrite_all);
      for (std::size_t i = 0; i < to.extent(0); ++i, ++next)
        for (std::size_t c = 0; c < to.extent(1); ++c) to(i, c) = from(next, c);
    }
    if (!has_blocks) extractor.InsertVector(*part, b, x, false);
  }
}

}  // namespace

PressureSchwarzSmoother::PressureSchwarzSmoother(const Teuchos::ParameterList& schwarz, int overlap)
    : schwarz_(schwarz), overlap_(overlap) {
  const auto& patches = schwarz_.sublist(patch_list);
  const std::string key = "partitioner: overlap";
  if (!patches.isType<int>(key) || patches.get<int>(key) < 1)
    throw std::invalid_argument("SCHWARZ: \"" + key +
                                "\" must be an int of at least 1 for the "
                                "\"partitioner: type\" \"user\".");
}

void PressureSchwarzSmoother::DeclareInput(MueLu::Level& level) const { this->Input(level, "A"); }

// Ifpack2 takes one matrix, and for each patch its seed, a pressure, around which it adds as many
// layers of neighbours as "partitioner: overlap" says.
void PressureSchwarzSmoother::Setup(MueLu::Level& level) {
  const auto A =
      Teuchos::rcp_dynamic_cast<XBlockedMatrix>(this->Get<Teuchos::RCP<XMatrix>>(level, "A"));
  if (A.is_null())
    throw std::runtime_error("\"partitioner: type\" \"user\" requires a matrix of blocks");
  extractor_ = A->getRangeMapExtractor();
  rows_ = unwrapped(block_after_block(*A)->Merge());
  const Seeds seeds(*rows_, static_cast<int>(n_local(*Xpetra::toTpetra(A->getRangeMap(0)))));
  Teuchos::ParameterList list(schwarz_);
  list.sublist(patch_list)
      .set("partitioner: map", seeds.patch)
      .set("partitioner: local parts", seeds.n_patches);
  const Teuchos::RCP<const RowMatrix> rows = rows_;
  smoother_ = Ifpack2::Factory::create<RowMatrix>("SCHWARZ", rows, overlap_);
  smoother_->setParameters(list);
  smoother_->initialize();
  smoother_->compute();
  this->IsSetup(true);
}

// Vectors come in blocks or merged, and go to Ifpack2 with one block behind the other.
void PressureSchwarzSmoother::Apply(XMultiVector& x, const XMultiVector& b, bool is_zero) const {
  ::tunica::MultiVector all_x(rows_->getRowMap(), x.getNumVectors());
  ::tunica::MultiVector all_b(rows_->getRowMap(), b.getNumVectors());
  gather(*extractor_, b, all_b);
  if (!is_zero) gather(*extractor_, x, all_x);
  smoother_->setZeroStartingSolution(is_zero);
  smoother_->apply(all_b, all_x);
  scatter(*extractor_, all_x, x);
}

Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>>
PressureSchwarzSmoother::Copy() const {
  return Teuchos::rcp(new PressureSchwarzSmoother(*this));
}

std::size_t PressureSchwarzSmoother::getNodeSmootherComplexity() const {
  return n_local_entries(*rows_);
}

}  // namespace tunica::multigrid
