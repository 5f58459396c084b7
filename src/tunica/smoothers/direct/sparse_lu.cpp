#include "tunica/smoothers/direct/sparse_lu.hpp"

#include <mpi.h>

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

/// KLU2's.
class Klu2Factors final : public Factors {
public:
  explicit Klu2Factors(const Teuchos::RCP<const CrsMatrix>& A)
      : A_(A), klu2_(Amesos2::create<CrsMatrix, MultiVector>("KLU2", A)) {
    const Map& rows = *A->getRowMap();
    // Amesos2 takes the numbers for contiguous unless a key says otherwise.
    if (static_cast<GlobalOrdinal>(rows.getGlobalNumElements()) < span_of(rows)) {
      const auto list = Teuchos::rcp(new Teuchos::ParameterList("Amesos2"));
      list->sublist("KLU2").set("IsContiguous", false, "Are GIDs Contiguous");
      klu2_->setParameters(list);
    }
    klu2_->symbolicFactorization();
  }

  void refactor() override {
    // Order and symbolic factors stay: values alone are new.
    klu2_->setA(A_, Amesos2::SYMBFACT);
    try {
      klu2_->numericFactorization();
    } catch (const std::exception&) {  // it tells of Amesos2's source lines
      if (lacks_memory()) throw std::bad_alloc();
      throw std::runtime_error("the matrix is singular");
    }
  }

  void solve(const MultiVector& B, MultiVector& X) const override { klu2_->solve(&X, &B); }

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

}  // namespace

/// The matrix on rank 0, its rows in the order of their numbers. What a solve sends is gathered and
/// scattered by MPI, which needs log P messages one behind another where rank 0 alone would need P.
class SparseLu::Gathered {
public:
  explicit Gathered(const CrsMatrix& A)
      : comm_(mpi_comm(*A.getComm())), is_root_(A.getComm()->getRank() == 0),
        n_mine_(n_local_rows(A)) {
    const auto K = A.getLocalMatrixHost();
    const Map& columns = *A.getColMap();
    std::vector<int> lengths;
    for (std::size_t row = 0; row < n_mine_; ++row)
      lengths.push_back(static_cast<int>(K.graph.row_map(row + 1) - K.graph.row_map(row)));
    std::vector<GlobalOrdinal> entries;
    for (std::size_t k = 0; k < K.nnz(); ++k)
      entries.push_back(columns.getGlobalElement(K.graph.entries(k)));
    const auto numbers = global_numbers(*A.getRowMap());
    rows_ = to_root(*A.getComm(), std::vector<GlobalOrdinal>(numbers.begin(), numbers.end()));
    lengths_ = to_root(*A.getComm(), lengths).items;
    entries_ = to_root(*A.getComm(), entries).items;
  }

  /// The matrix on rank 0 alone, still without values. Not collective.
  Teuchos::RCP<const CrsMatrix> make_alone() {
    const std::size_t n = rows_.items.size();
    std::vector<GlobalOrdinal> numbers(rows_.items);
    std::sort(numbers.begin(), numbers.end());
    const auto place_of = [&numbers](GlobalOrdinal number) {
      return static_cast<LocalOrdinal>(std::lower_bound(numbers.begin(), numbers.end(), number) -
                                       numbers.begin());
    };
    std::vector<std::size_t> from(n);  // where the entries of a row begin as they came
    Teuchos::ArrayRCP<std::size_t> starts(n + 1, 0);
    for (std::size_t k = 0, begin = 0; k < n; begin += lengths_[k++]) {
      row_.push_back(place_of(rows_.items[k]));
      from[row_[k]] = begin;
      starts[row_[k] + 1] = lengths_[k];
    }
    for (std::size_t row = 0; row < n; ++row) starts[row + 1] += starts[row];
    Teuchos::ArrayRCP<LocalOrdinal> columns(entries_.size());
    entry_.resize(entries_.size());
    std::vector<std::pair<LocalOrdinal, std::size_t>> sorted;
    for (std::size_t row = 0; row < n; ++row) {
      sorted.clear();
      for (std::size_t k = from[row]; k < from[row] + starts[row + 1] - starts[row]; ++k)
        sorted.emplace_back(place_of(entries_[k]), k);
      std::sort(sorted.begin(), sorted.end());
      for (std::size_t k = 0; k < sorted.size(); ++k) {
        columns[starts[row] + k] = sorted[k].first;
        entry_[sorted[k].second] = starts[row] + k;
      }
    }
    const auto self = Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF));
    const auto map = Teuchos::rcp(new Map(n, 0, self));
    alone_ = Teuchos::rcp(
        new CrsMatrix(map, map, starts, columns, Teuchos::ArrayRCP<Scalar>(entries_.size(), 0.0)));
    alone_->expertStaticFillComplete(map, map);
    lengths_ = std::vector<int>();
    entries_ = std::vector<GlobalOrdinal>();
    return alone_;
  }

  /// New values on rank 0. Collective.
  void refresh(const CrsMatrix& A) {
    const auto K = A.getLocalMatrixHost();
    // Values come in the order in which entries came, and entry_ says where each one stands.
    const std::vector<double> values =
        to_root(*A.getComm(), std::vector<double>(K.values.data(), K.values.data() + K.nnz()))
            .items;
    if (!is_root_) return;
    const auto alone = alone_->getLocalMatrixHost().values;
    for (std::size_t k = 0; k < values.size(); ++k) alone(entry_[k]) = values[k];
  }

  /// factors: null but on rank 0.
  void solve(const MultiVector& B, MultiVector& X, const Factors* factors) const {
    // b to rank 0, x = A⁻¹ b there, and x back: two collective calls
    if (n_columns_ != B.getNumVectors()) set_columns(B.getNumVectors());
    const auto n = static_cast<int>(mine_.size());
    const auto b = B.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t i = 0, k = 0; i < n_mine_; ++i)
      for (std::size_t j = 0; j < n_columns_; ++j) mine_[k++] = b(i, j);
    MPI_Gatherv(mine_.data(), n, MPI_DOUBLE, all_.data(), counts_.data(), starts_.data(),
                MPI_DOUBLE, 0, comm_);
    if (factors != nullptr) solve_alone(*factors);
    MPI_Scatterv(all_.data(), counts_.data(), starts_.data(), MPI_DOUBLE, mine_.data(), n,
                 MPI_DOUBLE, 0, comm_);
    const auto x = X.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0, k = 0; i < n_mine_; ++i)
      for (std::size_t j = 0; j < n_columns_; ++j) x(i, j) = mine_[k++];
  }

private:
  template <class Item>
  static Received<Item> to_root(const Comm& comm, const std::vector<Item>& mine) {
    std::vector<int> counts(comm.getSize(), 0);
    counts[0] = static_cast<int>(mine.size());
    return exchange(comm, mine, counts);
  }

  // From the order in which ranks send their rows to that of the numbers, and back
  void solve_alone(const Factors& factors) const {
    {
      const auto b = b_.getLocalViewHost(Tpetra::Access::OverwriteAll);
      for (std::size_t row = 0, k = 0; row < row_.size(); ++row)
        for (std::size_t j = 0; j < n_columns_; ++j) b(row_[row], j) = all_[k++];
    }
    factors.solve(b_, x_);
    const auto x = x_.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t row = 0, k = 0; row < row_.size(); ++row)
      for (std::size_t j = 0; j < n_columns_; ++j) all_[k++] = x(row_[row], j);
  }

  // Buffers for so many right sides, kept until another number of them comes.
  void set_columns(std::size_t n) const {
    n_columns_ = n;
    mine_.resize(n_mine_ * n);
    if (!is_root_) return;
    all_.resize(row_.size() * n);
    counts_.clear();
    starts_.assign(1, 0);
    for (const int count : rows_.counts) {
      counts_.push_back(count * static_cast<int>(n));
      starts_.push_back(starts_.back() + counts_.back());
    }
    for (MultiVector* x : {&b_, &x_}) *x = MultiVector(alone_->getRowMap(), n);
  }

  MPI_Comm comm_;
  bool is_root_;
  std::size_t n_mine_;
  // On rank 0, rows and entries as they come from the ranks in turn.
  Received<GlobalOrdinal> rows_;
  std::vector<int> lengths_;            ///< until the matrix is made, as entries_
  std::vector<GlobalOrdinal> entries_;  ///< their columns
  std::vector<LocalOrdinal> row_;       ///< in the matrix
  std::vector<std::size_t> entry_;      ///< in the matrix
  Teuchos::RCP<CrsMatrix> alone_;       ///< null on other ranks
  mutable std::size_t n_columns_ = 0;
  mutable std::vector<double> mine_, all_;
  mutable std::vector<int> counts_, starts_;
  mutable MultiVector b_, x_;
};

namespace {

/// What happens on rank 0, thrown on all ranks. Collective.
void agree(const Comm& comm, const std::function<void()>& of_root) {
  auto verdict = static_cast<int>(Verdict::good);
  if (comm.getRank() == 0) {
    try {
      of_root();
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

SparseLu::SparseLu(const Teuchos::RCP<const CrsMatrix>& A)
    : SparseLu(A, [](const auto& alone) { return std::make_unique<Klu2Factors>(alone); }) {}

SparseLu::SparseLu(const Teuchos::RCP<const CrsMatrix>& A, const MakeFactors& make) : A_(A) {
  if (A->getComm()->getSize() > 1) gathered_ = std::make_unique<Gathered>(*A);
  agree(*A->getComm(), [&] { factors_ = make(gathered_ ? gathered_->make_alone() : A); });
}

SparseLu::~SparseLu() = default;

// Rank 0 factors; all ranks get its verdict, and throw alike.
void SparseLu::refactor() {
  if (gathered_) gathered_->refresh(*A_);
  agree(*A_->getComm(), [this] { factors_->refactor(); });
}

double SparseLu::told(const std::function<double(Factors&)>& question) const {
  double answer = 0.0;
  agree(*A_->getComm(), [&] { answer = question(*factors_); });
  Teuchos::broadcast(*A_->getComm(), 0, &answer);
  return answer;
}

void SparseLu::solve(const MultiVector& B, MultiVector& X) const {
  if (gathered_) return gathered_->solve(B, X, factors_.get());
  factors_->solve(B, X);
}

}  // namespace tunica::smoothers
