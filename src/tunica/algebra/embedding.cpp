#include "tunica/algebra/embedding.hpp"

#include <algorithm>

#include "tunica/algebra/entry_offsets.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

Embedding::Embedding(const BlockMatrix& part, const BlockMatrix& whole, std::vector<Place> places)
    : part_(&part), unknowns_(part.n_blocks(), 1.0), equations_(part.n_blocks(), 1.0) {
  std::vector<std::vector<GlobalOrdinal>> owned;
  for (int b = 0; b < part.n_blocks(); ++b) {
    const Map& rows = *(*part.space())[b].map;
    const auto& numbers = places[b].numbers;
    owned.emplace_back(numbers.begin(), numbers.begin() + n_local(rows));
    blocks_.push_back(places[b].block);
    rows_.push_back(local_numbers(owned[b], *(*whole.space())[places[b].block].map));
  }
  for (int i = 0; i < part.n_blocks(); ++i)
    for (int j = 0; j < part.n_blocks(); ++j)
      if (!part(i, j).is_null())
        matrices_.push_back({i, j,
                             entry_offsets(*part(i, j), owned[i], places[j].numbers,
                                           *whole(places[i].block, places[j].block))});
}

void Embedding::set_units(std::vector<double> unknowns, std::vector<double> equations) {
  unknowns_ = std::move(unknowns);
  equations_ = std::move(equations);
}

void Embedding::restrict(const BlockVector& x, BlockVector& part) const {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const auto from = x[blocks_[b]].getLocalViewHost(read_only);
    const auto to = part[static_cast<int>(b)].getLocalViewHost(overwrite_all);
    for (std::size_t i = 0; i < rows_[b].size(); ++i)
      to(i, 0) = unknowns_[b] * from(rows_[b][i], 0);
  }
}

void Embedding::insert(const BlockVector& part, BlockVector& x) const {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const auto from = part[static_cast<int>(b)].getLocalViewHost(read_only);
    const auto to = x[blocks_[b]].getLocalViewHost(read_write);
    for (std::size_t i = 0; i < rows_[b].size(); ++i)
      to(rows_[b][i], 0) = from(i, 0) / unknowns_[b];
  }
}

void Embedding::add(const BlockVector& part, BlockVector& F) const {
  add_weighted(equations_, part, F);
}

void Embedding::add_weighted(const std::vector<double>& weights, const BlockVector& part,
                             BlockVector& x) const {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const auto from = part[static_cast<int>(b)].getLocalViewHost(read_only);
    const auto to = x[blocks_[b]].getLocalViewHost(read_write);
    for (std::size_t i = 0; i < rows_[b].size(); ++i) to(rows_[b][i], 0) += weights[b] * from(i, 0);
  }
}

void Embedding::add_block(const CrsMatrix& part, int row, int column, CrsMatrix& whole) const {
  const auto place = std::find_if(matrices_.begin(), matrices_.end(), [=](const MatrixPlace& p) {
    return p.row == row && p.column == column;
  });
  const auto from = part.getLocalMatrixHost().values;
  const auto to = whole.getLocalMatrixHost().values;
  const double unit = equations_[row] * unknowns_[column];
  for (std::size_t k = 0; k < place->offsets.size(); ++k) to(place->offsets[k]) += unit * from(k);
}

void Embedding::add_matrix(BlockMatrix& whole, int first_product) const {
  for (const MatrixPlace& place : matrices_)
    add_block(*(*part_)(place.row, place.column), place.row, place.column,
              *whole(blocks_[place.row], blocks_[place.column]));
  if (!part_->low_rank()) return;
  for (int k = 0; k < part_->low_rank()->rank(); ++k) {
    const RankOne& from = (*part_->low_rank())[k];
    RankOne& to = (*whole.low_rank())[first_product + k];
    to.scale = from.scale;
    to.w.set_zero();
    to.v.set_zero();
    add_weighted(equations_, from.w, to.w);  // R Pᵀ w
    add_weighted(unknowns_, from.v, to.v);   // S Pᵀ v
  }
}

}  // namespace tunica::algebra
