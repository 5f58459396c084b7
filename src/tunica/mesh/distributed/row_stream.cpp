#include "tunica/mesh/distributed/row_stream.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <exception>
#include <utility>

#include "tunica/base/agreement.hpp"
#include "tunica/base/exchange.hpp"
#include "tunica/base/portion.hpp"

namespace tunica::mesh {

namespace {

enum Kind : int { end_of_rows = 1, vertex_rows, tet_rows, triangle_rows, vector_rows };

}  // namespace

template <class Row>
RowChannel<Row>::RowChannel(const CommPtr& comm, int piece, int tag)
    : comm_(comm), piece_(piece), tag_(tag) {}

template <class Row>
void RowChannel<Row>::put(const Row& row) {
  if (filling_.empty()) filling_.reserve(static_cast<std::size_t>(piece_));
  filling_.push_back(row);
  ++count_;
  if (count_ % piece_ == 0) flush();
}

template <class Row>
void RowChannel<Row>::flush() {
  if (filling_.empty()) return;
  const auto to = static_cast<int>((count_ - 1) / piece_ % comm_->getSize());
  if (to == 0)
    mine_.insert(mine_.end(), filling_.begin(), filling_.end());
  else
    MPI_Send(filling_.data(), static_cast<int>(filling_.size() * sizeof(Row)), MPI_BYTE, to, tag_,
             mpi_comm(*comm_));
  filling_.clear();
}

template <class Row>
void RowChannel<Row>::take(const std::vector<char>& message, int bytes) {
  const auto* rows = reinterpret_cast<const Row*>(message.data());
  mine_.insert(mine_.end(), rows, rows + static_cast<std::size_t>(bytes) / sizeof(Row));
}

template <class Row>
std::vector<Row> RowChannel<Row>::take_portions() {
  const int rank = comm_->getRank(), ranks = comm_->getSize();
  if (ranks == 1) return std::exchange(mine_, {});
  Teuchos::broadcast(*comm_, 0, 1, &count_);
  // 1. The k-th of a rank's pieces is the (k ranks + rank)-th of all: to whose portions it belongs.
  std::vector<int> counts(ranks, 0);
  int owner = 0;
  for (std::size_t i = 0; i < mine_.size(); ++i) {
    const auto k = static_cast<long long>(i) / piece_;
    const long long row = (k * ranks + rank) * piece_ + static_cast<long long>(i) % piece_;
    while (first_row(count_, owner + 1, ranks) <= row) ++owner;
    ++counts[owner];
  }
  const Received<Row> received = exchange(*comm_, std::exchange(mine_, {}), counts);
  // 2. What came from one rank is in order; from which rank the next row came follows from its
  // number.
  std::vector<std::size_t> next(ranks, 0);
  for (int r = 1; r < ranks; ++r)
    next[r] = next[r - 1] + static_cast<std::size_t>(received.counts[r - 1]);
  const Portion portion = portion_of(count_, *comm_);
  std::vector<Row> rows;
  rows.reserve(received.items.size());
  for (long long row = portion.first; row < portion.first + portion.count; ++row)
    rows.push_back(received.items[next[row / piece_ % ranks]++]);
  return rows;
}

template class RowChannel<Vec3>;
template class RowChannel<TetRow>;
template class RowChannel<TriangleRow>;
template class RowChannel<VectorRow>;

RowStream::RowStream(const CommPtr& comm, int rows_at_once)
    : vertices(comm, rows_at_once, vertex_rows), tets(comm, rows_at_once, tet_rows),
      triangles(comm, rows_at_once, triangle_rows), vectors(comm, rows_at_once, vector_rows),
      comm_(comm), piece_(rows_at_once) {}

void RowStream::run(const std::function<void(RowStream&)>& reader) {
  const bool is_root = comm_->getRank() == 0;
  constexpr std::size_t longest =
      std::max({sizeof(Vec3), sizeof(TetRow), sizeof(TriangleRow), sizeof(VectorRow)});
  std::vector<char> message;
  on_all(*comm_, [&] {  // before rank 0 waits for the others to receive
    if (!is_root) message.resize(longest * static_cast<std::size_t>(piece_));
  });
  on_all(*comm_, [&] {
    if (!is_root) return receive_all(message);
    try {
      reader(*this);
      flush();
    } catch (...) {
      send_end();  // nobody must wait for what does not come
      throw;
    }
    send_end();
  });
}

void RowStream::flush() {
  vertices.flush();
  tets.flush();
  triangles.flush();
  vectors.flush();
}

void RowStream::send_end() const {
  for (int r = 1; r < comm_->getSize(); ++r)
    MPI_Send(nullptr, 0, MPI_BYTE, r, end_of_rows, mpi_comm(*comm_));
}

void RowStream::take(int tag, const std::vector<char>& message, int bytes) {
  switch (tag) {
    case vertex_rows:
      return vertices.take(message, bytes);
    case tet_rows:
      return tets.take(message, bytes);
    case triangle_rows:
      return triangles.take(message, bytes);
    default:
      vectors.take(message, bytes);
  }
}

void RowStream::receive_all(std::vector<char>& message) {
  std::exception_ptr failure;  // what is sent must be received all the same
  for (;;) {
    MPI_Status envelope;
    MPI_Recv(message.data(), static_cast<int>(message.size()), MPI_BYTE, 0, MPI_ANY_TAG,
             mpi_comm(*comm_), &envelope);
    if (envelope.MPI_TAG == end_of_rows) break;
    int bytes = 0;
    MPI_Get_count(&envelope, MPI_BYTE, &bytes);
    try {
      if (!failure) take(envelope.MPI_TAG, message, bytes);
    } catch (...) {
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace tunica::mesh
