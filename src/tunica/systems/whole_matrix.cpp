#include "tunica/systems/whole_matrix.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/systems/scalar_rows.hpp"

namespace tunica::systems {

namespace {

ColumnRows made_column(const MatrixRows& K) {
  ColumnRows b;
  b.n_rows = K.n_rows;
  for (std::size_t i = 0; i < K.n_local_rows(); ++i) {
    double sum = 0.0;
    for (std::size_t k = K.start[i]; k < K.start[i + 1]; ++k)
      sum += K.values[k] * std::sin(static_cast<double>(K.columns[k] + 1));
    b.values.push_back(sum);
  }
  return b;
}

/// Number of each row of the file within its field.
std::vector<long long> numbers_in_fields(const std::vector<char>& is_scalar) {
  std::vector<long long> numbers;
  long long next[] = {0, 0};
  for (const char field : is_scalar) numbers.push_back(next[field != 0 ? 1 : 0]++);
  return numbers;
}

/// Takes rows and entries of K to the four blocks.
class Splitter {
public:
  Splitter(const MatrixRows& K, const ScalarRows& scalars)
      : K_(K), scalars_(scalars), number_(numbers_in_fields(scalars.is_scalar)) {
    const auto m = static_cast<long long>(
        std::count(scalars.is_scalar.begin(), scalars.is_scalar.end(), char{1}));
    size_ = {K.n_rows - m, m};
  }

  /// Collective, as all others.
  MatrixRows block(int i, int j) const {
    RowCollector collector(size_[i], size_[j], K_.comm);
    in_batches(K_, [&](std::size_t first, std::size_t last) {
      std::vector<Entry> entries;
      for (std::size_t row = first; row < last; ++row) {
        const long long in_file = K_.first_row() + static_cast<long long>(row);
        if (field(in_file) != i) continue;
        for (std::size_t k = K_.start[row]; k < K_.start[row + 1]; ++k)
          if (field(K_.columns[k]) == j)
            entries.push_back({number_[in_file], number_[K_.columns[k]], sign(i) * K_.values[k]});
      }
      collector.add(entries);
    });
    return collector.take();
  }

  /// Of the rank's portion of a field. Not collective.
  std::vector<long long> rows_in_file(int i) const {
    const Portion portion = portion_of(size_[i], *K_.comm);
    std::vector<long long> rows;
    for (long long row = 0; row < K_.n_rows; ++row)
      if (field(row) == i && number_[row] >= portion.first &&
          number_[row] < portion.first + portion.count)
        rows.push_back(row);
    return rows;
  }

private:
  int field(long long row) const { return scalars_.is_scalar[row] != 0 ? 1 : 0; }
  double sign(int i) const { return i == 0 ? scalars_.vector_sign : scalars_.scalar_sign; }

  const MatrixRows& K_;
  const ScalarRows& scalars_;
  std::vector<long long> number_;
  std::array<long long, 2> size_{};
};

}  // namespace

Blocks split_whole(const MatrixRows& K, const Teuchos::ParameterList& options, std::string& order) {
  TUNICA_CHECK(K.n_rows == K.n_columns, "System: K is " + std::to_string(K.n_rows) + " x " +
                                            std::to_string(K.n_columns) +
                                            ", expected a square matrix.");
  const ScalarRows scalars = find_scalars(K, options);
  order = scalars.text;
  const Splitter split(K, scalars);
  Blocks blocks;
  blocks.A = with_diagonal(split.block(0, 0));
  blocks.B1T = split.block(0, 1);
  blocks.B2 = split.block(1, 0);
  blocks.mC = with_diagonal(split.block(1, 1));
  blocks.signs = {scalars.vector_sign, scalars.scalar_sign};
  blocks.files = {"K", "K"};
  blocks.in_nodes = scalars.in_nodes;
  blocks.file_rows = {split.rows_in_file(0), split.rows_in_file(1)};
  TUNICA_CHECK(blocks.n_rows(0) > 0, "System: all rows of K would be scalar unknowns.");
  return blocks;
}

Blocks read_whole(const Teuchos::ParameterList& options, const CommPtr& comm,
                  std::size_t lines_at_once, std::string& order, ColumnRows& b) {
  const MatrixRows K = read_matrix(options.get<std::string>("K"), comm, lines_at_once);
  const auto& rhs = options.get<std::string>("rhs");
  Blocks blocks = split_whole(K, options, order);
  b = rhs.empty() ? made_column(K) : read_column(rhs, comm, lines_at_once);
  TUNICA_CHECK(b.n_rows == K.n_rows, "System: rhs has " + std::to_string(b.n_rows) +
                                         " rows, expected " + std::to_string(K.n_rows) +
                                         ", as many as K.");
  return blocks;
}

}  // namespace tunica::systems
