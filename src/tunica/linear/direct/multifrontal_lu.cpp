#include "tunica/linear/direct/multifrontal_lu.hpp"

#include <dlfcn.h>
#include <dmumps_c.h>
#include <mpi.h>

#include <cmath>
#include <new>
#include <stdexcept>
#include <string>

#include "tunica/base/trilinos.hpp"
#include "tunica/linear/direct/level_widths.hpp"

namespace tunica::linear {

namespace {

enum Job { begin = -1, end = -2, analyse = 1, factor = 2, solve_with = 3 };
enum Ordering { given = 1, least_fill = 2 };
enum class Verdict { good, singular, wants_space, lacks_memory, fault };

/// By the numbers of MUMPS' manual.
Verdict verdict_of(int status) {
  switch (status) {
    case -6:
    case -10:
      return Verdict::singular;
    case -8:
    case -9:
    case -14:
    case -15:
    case -17:
    case -20:
      return Verdict::wants_space;
    case -5:
    case -7:
    case -13:
    case -19:
      return Verdict::lacks_memory;
    default:
      return status < 0 ? Verdict::fault : Verdict::good;
  }
}

/// MUMPS asks MPI for messages at each of its many fronts, though one rank alone gets none. Where
/// Open MPI has been told to yield its processor, each question costs a slice of time on a busy
/// machine: minutes for a solve. Within this scope it does not yield.
class Unyielding {
public:
  Unyielding() {
    if (set() != nullptr) before_ = set()(false);
  }
  ~Unyielding() {
    if (set() != nullptr) set()(before_);
  }
  Unyielding(const Unyielding&) = delete;
  Unyielding& operator=(const Unyielding&) = delete;

private:
  using Set = bool (*)(bool);
  static Set set() {  // null for other MPIs
    static const auto function =
        reinterpret_cast<Set>(dlsym(RTLD_DEFAULT, "opal_progress_set_yield_when_idle"));
    return function;
  }

  bool before_ = false;
};

}  // namespace

/// MUMPS' record of a matrix, with its numbers of parameters from 1 as in its manual.
class MultifrontalLu::Instance {
public:
  Instance() {
    id_.par = 1;
    id_.sym = 0;
    id_.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(MPI_COMM_SELF));
    run(begin);
    for (const int k : {1, 2, 3}) option(k) = -1;  // it writes nothing
    option(4) = 0;
  }
  ~Instance() {
    id_.job = end;
    dmumps_c(&id_);
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  DMUMPS_STRUC_C& id() { return id_; }
  int& option(int k) { return id_.icntl[k - 1]; }
  double operations() const { return id_.rinfog[0]; }
  /// Of the factors; as millions below zero where there are many.
  double entries() const { return id_.infog[2] < 0 ? -1e6 * id_.infog[2] : id_.infog[2]; }

  void run(Job job) {
    const Unyielding scope;
    // The work space is an estimate, which pivots off the diagonal exceed.
    Verdict verdict = attempt(job);
    for (int left = 5; verdict == Verdict::wants_space && left > 0; --left) {
      option(14) *= 2;
      verdict = attempt(job);
    }
    if (verdict == Verdict::good) return;
    if (verdict == Verdict::singular) throw std::runtime_error("the matrix is singular");
    if (verdict != Verdict::fault) throw std::bad_alloc();
    throw std::runtime_error("MUMPS failed with " + std::to_string(id_.infog[0]) + ", " +
                             std::to_string(id_.infog[1]));
  }

private:
  Verdict attempt(Job job) {
    id_.job = job;
    dmumps_c(&id_);
    return verdict_of(id_.infog[0]);
  }

  DMUMPS_STRUC_C id_{};
};

MultifrontalLu::MultifrontalLu(const Teuchos::RCP<const CrsMatrix>& A, double most_operations)
    : A_(A), mumps_(std::make_unique<Instance>()) {
  const auto K = A->getLocalMatrixHost();
  const Map &rows = *A->getRowMap(), &columns = *A->getColMap();
  entries_.rows.reserve(K.nnz());
  entries_.columns.reserve(K.nnz());
  std::vector<int> row_of_column(K.numCols());
  for (int j = 0; j < K.numCols(); ++j)
    row_of_column[j] = rows.getLocalElement(columns.getGlobalElement(j));
  for (int i = 0; i < K.numRows(); ++i)
    for (auto k = K.graph.row_map(i); k < K.graph.row_map(i + 1); ++k) {
      entries_.rows.push_back(i + 1);
      entries_.columns.push_back(1 + row_of_column[K.graph.entries(k)]);
    }
  if (most_operations > 0.0) {
    // w³/4 with the narrowest level w. Orders in the arena take from 5 (Taylor–Hood in space) to
    // 1,000 times as many.
    const double least =
        0.25 * std::pow(narrowest_level(static_cast<int>(K.numRows()), entries_), 3);
    if (least > most_operations) least_operations_ = least;
    if (!is_ordered()) return;
  }
  DMUMPS_STRUC_C& id = mumps_->id();
  id.n = static_cast<MUMPS_INT>(K.numRows());
  id.nnz = static_cast<MUMPS_INT8>(entries_.rows.size());
  id.irn = entries_.rows.data();
  id.jcn = entries_.columns.data();
  mumps_->option(6) = 0;  // no permutation of columns: it wants values
  mumps_->option(7) = least_fill;
  mumps_->run(analyse);
}

MultifrontalLu::~MultifrontalLu() = default;

double MultifrontalLu::expected_operations() const {
  return is_ordered() ? mumps_->operations() : least_operations_;
}

double MultifrontalLu::expected_bytes() const { return sizeof(double) * mumps_->entries(); }

void MultifrontalLu::dissect() {
  const double operations = mumps_->operations();
  std::vector<int> place = nested_dissection(mumps_->id().n, entries_);
  for (int& number : place) ++number;
  mumps_->id().perm_in = place.data();
  mumps_->option(7) = given;
  mumps_->run(analyse);
  mumps_->id().perm_in = nullptr;
  if (mumps_->operations() <= operations) return;
  mumps_->option(7) = least_fill;
  mumps_->run(analyse);
}

void MultifrontalLu::refactor() {
  mumps_->id().a = A_->getLocalMatrixHost().values.data();
  mumps_->run(factor);
}

// MUMPS solves in the place of the right sides.
void MultifrontalLu::solve(const MultiVector& B, MultiVector& X) const {
  DMUMPS_STRUC_C& id = mumps_->id();
  const auto n = static_cast<std::size_t>(id.n);
  const std::size_t columns = B.getNumVectors();
  std::vector<double> all(n * columns);
  const auto b = B.getLocalViewHost(read_only);
  for (std::size_t j = 0; j < columns; ++j)
    for (std::size_t i = 0; i < n; ++i) all[j * n + i] = b(i, j);
  id.rhs = all.data();
  id.nrhs = static_cast<MUMPS_INT>(columns);
  id.lrhs = id.n;
  mumps_->run(solve_with);
  const auto x = X.getLocalViewHost(overwrite_all);
  for (std::size_t j = 0; j < columns; ++j)
    for (std::size_t i = 0; i < n; ++i) x(i, j) = all[j * n + i];
}

}  // namespace tunica::linear
