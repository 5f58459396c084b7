#include "tunica/io/matrix_market.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <stdexcept>

#include "tunica/base/agreement.hpp"
#include "tunica/io/atomic_file.hpp"

namespace tunica::io {

namespace {

constexpr int most_per_message = 1 << 28;

template <class Number>
void append(std::string& text, Number value, char end) {
  std::array<char, 32> digits;
  const auto last = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), last);
  text += end;
}

/// A file to which all ranks add, rank after rank, through rank 0.
class CommonFile {
public:
  CommonFile(const std::string& path, const std::string& heading, const CommPtr& comm)
      : comm_(comm) {
    if (comm_->getRank() != 0) return;
    file_.emplace(path);
    file_->add(heading);
  }

  /// Adds the texts of all ranks in their order. Collective.
  void add(const std::string& mine) {
    if (comm_->getRank() != 0) return send(mine);
    file_->add(mine);
    for (int rank = 1; rank < comm_->getSize(); ++rank) receive(rank);
  }

  /// Collective.
  void finish() {
    on_root_or_fault(*comm_, [this] { return file_->commit(); });
  }

private:
  void send(const std::string& mine) const {
    const auto size = static_cast<long long>(mine.size());
    Teuchos::send(*comm_, 1, &size, 0);
    for (long long at = 0; at < size; at += most_per_message)
      Teuchos::send(*comm_, static_cast<int>(std::min<long long>(most_per_message, size - at)),
                    mine.data() + at, 0);
  }

  /// Takes what was sent even where the disk is full, so that nobody waits.
  void receive(int rank) {
    long long size = 0;
    Teuchos::receive(*comm_, rank, 1, &size);
    std::string part;
    for (long long at = 0; at < size; at += most_per_message) {
      const auto count = static_cast<int>(std::min<long long>(most_per_message, size - at));
      part.resize(static_cast<std::size_t>(count));
      Teuchos::receive(*comm_, rank, count, part.data());
      file_->add(part);
    }
  }

  CommPtr comm_;
  std::optional<AtomicFile> file_;  ///< on rank 0
};

std::string heading(const std::string& layout, const std::string& comment) {
  const std::string first = "%%MatrixMarket matrix " + layout + " real general\n";
  return comment.empty() ? first : first + "% " + comment + "\n";
}

}  // namespace

void write_matrix_market(const std::string& path, const CrsMatrix& A, double factor,
                         const std::string& comment) {
  std::string text = heading("coordinate", comment);
  append(text, A.getGlobalNumRows(), ' ');
  append(text, A.getDomainMap()->getGlobalNumElements(), ' ');
  append(text, A.getGlobalNumEntries(), '\n');
  CommonFile file(path, text, A.getComm());
  std::string mine;
  const auto local = A.getLocalMatrixHost();
  for (LocalOrdinal row = 0; row < local.numRows(); ++row)
    for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
      append(mine, A.getRowMap()->getGlobalElement(row) + 1, ' ');
      append(mine, A.getColMap()->getGlobalElement(local.graph.entries(k)) + 1, ' ');
      append(mine, factor * local.values(k), '\n');
    }
  file.add(mine);
  file.finish();
}

void write_matrix_market(const std::string& path, const std::vector<const MultiVector*>& parts,
                         const std::string& comment) {
  const std::size_t columns = parts.front()->getNumVectors();
  std::size_t rows = 0;
  for (const MultiVector* part : parts) rows += part->getGlobalLength();
  std::string text = heading("array", comment);
  append(text, rows, ' ');
  append(text, columns, '\n');
  CommonFile file(path, text, parts.front()->getMap()->getComm());
  for (std::size_t j = 0; j < columns; ++j)
    for (const MultiVector* part : parts) {
      std::string mine;
      const auto values = part->getLocalViewHost(read_only);
      for (std::size_t i = 0; i < values.extent(0); ++i) append(mine, values(i, j), '\n');
      file.add(mine);
    }
  file.finish();
}

}  // namespace tunica::io
