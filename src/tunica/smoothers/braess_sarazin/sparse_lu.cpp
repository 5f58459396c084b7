#include "tunica/smoothers/braess_sarazin/sparse_lu.hpp"

#include <Amesos2.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultMpiComm.hpp>
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <new>
#include <stdexcept>

#include "tunica/base/exchange.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::smoothers {

namespace {

enum class Verdict { good, singular, out_of_memory };

GlobalOrdinal span_of(const Map& rows) {
  return rows.getMaxAllGlobalIndex() - rows.getIndexBase() + 1;
}

}  // namespace

/// KLU2 of a matrix all of whose rows are on one rank.
class SparseLu::Factors {
public:
  explicit Factors(const Teuchos::RCP<const CrsMatrix>& A)
      : A_(A), klu2_(Amesos2::create<CrsMatrix, MultiVector>("KLU2", A)) {
    const Map& rows = *A->getRowMap();
    if (static_cast<GlobalOrdinal>(rows.getGlobalNumElements()) < span_of(rows)) {
      const auto list = Teuchos::rcp(new Teuchos::ParameterList("Amesos2"));
      list->sublist("KLU2").set("IsContiguous", false, "Are GIDs Contiguous");
      klu2_->setParameters(list);
    }
    klu2_->symbolicFactorization();
  }

  Verdict refactor() {
    klu2_->setA(A_, Amesos2::SYMBFACT);
    try {
      klu2_->numericFactorization();
    } catch (const std::exception&) {  // it tells of Amesos2's source lines
      return lacks_memory() ? Verdict::out_of_memory : Verdict::singular;
    }
    return Verdict::good;
  }

  void solve(const MultiVector& B, MultiVector& X) const { klu2_->solve(&X, &B); }

private:
  /// KLU2 calls a matrix singular also where malloc() fails; it has given back what it took.
  bool lacks_memory() const {
    constexpr std::size_t bytes_per_entry = 2 * (sizeof(double) + sizeof(int));  // while growing
    void* const probe = std::malloc(1 + bytes_per_entry * klu2_->getStatus().getNnzLU());
    std::free(probe);
    return probe == nullptr;
  }

  Teuchos::RCP<const CrsMatrix> A_;
  Teuchos::RCP<Amesos2::Solver<CrsMatrix, MultiVector>> klu2_;
};

/// The matrix on rank 0, by rows in the order of their numbers.
class SparseLu::Gathered {
public:
  explicit Gathered(const CrsMatrix& A)
      : is_root_(A.getComm()->getRank() == 0), map_(all_on_root(*A.getRowMap())),
        import_(A.getRowMap(), map_), b_(map_, 1), x_(map_, 1) {
    const auto K = A.getLocalMatrixHost();
    const Map& columns = *A.getColMap();
    std::vector<int> lengths;
    for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(K.numRows()); ++row)
      lengths.push_back(static_cast<int>(K.graph.row_map(row + 1) - K.graph.row_map(row)));
    std::vector<GlobalOrdinal> entries;
    for (std::size_t k = 0; k < K.nnz(); ++k)
      entries.push_back(columns.getGlobalElement(K.graph.entries(k)));
    const auto numbers = global_numbers(*A.getRowMap());
    rows_ = to_root(*A.getComm(), std::vector<GlobalOrdinal>(numbers.begin(), numbers.end()));
    lengths_ = to_root(*A.getComm(), lengths);
    entries_ = to_root(*A.getComm(), entries);
  }

  /// The matrix on rank 0 alone, still without values. Not collective.
  Teuchos::RCP<const CrsMatrix> make_alone() {
    const auto n = rows_.size();
    const auto self = Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF));
    const auto map = Teuchos::rcp(new Map(n, 0, self));
    std::vector<std::size_t> from(n);  // where the row begins among all entries
    std::vector<int> length(n);
    for (std::size_t k = 0, begin = 0; k < n; begin += lengths_[k++]) {
      const LocalOrdinal row = map_->getLocalElement(rows_[k]);
      from[row] = begin;
      length[row] = lengths_[k];
    }
    Teuchos::ArrayRCP<std::size_t> starts(n + 1, 0);
    for (std::size_t row = 0; row < n; ++row) starts[row + 1] = starts[row] + length[row];
    Teuchos::ArrayRCP<LocalOrdinal> columns(entries_.size());
    Teuchos::ArrayRCP<Scalar> values(entries_.size(), 0.0);
    places_.resize(entries_.size());
    std::vector<std::pair<LocalOrdinal, std::size_t>> sorted;
    for (std::size_t row = 0; row < n; ++row) {
      sorted.clear();
      for (std::size_t k = from[row]; k < from[row] + length[row]; ++k)
        sorted.emplace_back(map_->getLocalElement(entries_[k]), k);
      std::sort(sorted.begin(), sorted.end());
      for (std::size_t k = 0; k < sorted.size(); ++k) {
        columns[starts[row] + k] = sorted[k].first;
        places_[sorted[k].second] = starts[row] + k;
      }
    }
    alone_ = Teuchos::rcp(new CrsMatrix(map, map, starts, columns, values));
    alone_->expertStaticFillComplete(map, map);
    set_columns(1);
    rows_ = entries_ = {};
    lengths_ = {};
    return alone_;
  }

  /// New values on rank 0. Collective.
  void refresh(const CrsMatrix& A) {
    const auto K = A.getLocalMatrixHost();
    const std::vector<double> values =
        to_root(*A.getComm(), std::vector<double>(K.values.data(), K.values.data() + K.nnz()));
    if (!is_root_) return;
    const auto alone = alone_->getLocalMatrixHost().values;
    for (std::size_t k = 0; k < values.size(); ++k) alone(places_[k]) = values[k];
  }

  /// factors: null but on rank 0.
  void solve(const MultiVector& B, MultiVector& X, const Factors* factors) const {
    if (b_.getNumVectors() != B.getNumVectors()) set_columns(B.getNumVectors());
    b_.doImport(B, import_, Tpetra::REPLACE);
    if (factors != nullptr) {
      copy(b_, b_alone_);
      factors->solve(b_alone_, x_alone_);
      copy(x_alone_, x_);
    }
    X.doExport(x_, import_, Tpetra::REPLACE);
  }

private:
  template <class Item>
  static std::vector<Item> to_root(const Comm& comm, const std::vector<Item>& mine) {
    std::vector<int> counts(comm.getSize(), 0);
    counts[0] = static_cast<int>(mine.size());
    return exchange(comm, mine, counts).items;
  }

  static Teuchos::RCP<const Map> all_on_root(const Map& rows) {
    const auto mine = global_numbers(rows);
    std::vector<GlobalOrdinal> numbers =
        to_root(*rows.getComm(), std::vector<GlobalOrdinal>(mine.begin(), mine.end()));
    std::sort(numbers.begin(), numbers.end());
    return Teuchos::rcp(new Map(rows.getGlobalNumElements(), Teuchos::arrayViewFromVector(numbers),
                                rows.getIndexBase(), rows.getComm()));
  }

  /// Of vectors on maps with the same local numbers.
  static void copy(const MultiVector& from, MultiVector& to) {
    const auto source = from.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto target = to.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t j = 0; j < from.getNumVectors(); ++j)
      for (std::size_t i = 0; i < from.getLocalLength(); ++i) target(i, j) = source(i, j);
  }

  void set_columns(std::size_t n) const {
    for (MultiVector* x : {&b_, &x_}) *x = MultiVector(map_, n);
    if (is_root_)
      for (MultiVector* x : {&b_alone_, &x_alone_}) *x = MultiVector(alone_->getRowMap(), n);
  }

  bool is_root_;
  Teuchos::RCP<const Map> map_;
  Import import_;
  std::vector<GlobalOrdinal> rows_, entries_;  ///< as they came, until the matrix is made
  std::vector<int> lengths_;
  std::vector<std::size_t> places_;  ///< in the matrix, of the entries as they come
  Teuchos::RCP<CrsMatrix> alone_;    ///< null but on rank 0
  mutable MultiVector b_, x_, b_alone_, x_alone_;
};

namespace {

/// What rank 0 finds, thrown on all ranks. Collective.
void agree(const Comm& comm, const std::function<Verdict()>& of_root) {
  auto verdict = static_cast<int>(Verdict::good);
  if (comm.getRank() == 0) {
    try {
      verdict = static_cast<int>(of_root());
    } catch (const std::bad_alloc&) {
      verdict = static_cast<int>(Verdict::out_of_memory);
    } catch (const std::exception&) {  // it tells of Amesos2's source lines
      verdict = static_cast<int>(Verdict::singular);
    }
  }
  Teuchos::broadcast(comm, 0, &verdict);
  if (verdict == static_cast<int>(Verdict::out_of_memory)) throw std::bad_alloc();
  if (verdict == static_cast<int>(Verdict::singular))
    throw std::runtime_error("the matrix is singular");
}

}  // namespace

SparseLu::SparseLu(const Teuchos::RCP<const CrsMatrix>& A) : A_(A) {
  if (A->getComm()->getSize() > 1) gathered_ = std::make_unique<Gathered>(*A);
  agree(*A->getComm(), [&] {
    factors_ = std::make_unique<Factors>(gathered_ ? gathered_->make_alone() : A);
    return Verdict::good;
  });
}

SparseLu::~SparseLu() = default;

void SparseLu::refactor() {
  if (gathered_) gathered_->refresh(*A_);
  agree(*A_->getComm(), [this] { return factors_->refactor(); });
}

void SparseLu::solve(const MultiVector& B, MultiVector& X) const {
  if (gathered_) return gathered_->solve(B, X, factors_.get());
  factors_->solve(B, X);
}

}  // namespace tunica::smoothers
