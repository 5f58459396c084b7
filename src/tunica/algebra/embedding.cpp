#include "tunica/algebra/embedding.hpp"

#include "tunica/algebra/entry_offsets.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

Embedding::Embedding(const BlockSpace& whole, std::vector<Place> places)
    : places_(std::move(places)), unknowns_(places_.size(), 1.0), equations_(places_.size(), 1.0) {
  for (const Place& place : places_) {
    const auto first = place.numbers.begin();
    const std::vector<GlobalOrdinal> owned(first, first + n_local(*place.owned));
    rows_.push_back(local_numbers(owned, *whole[place.block].map));
  }
}

void Embedding::set_units(std::vector<double> unknowns, std::vector<double> equations) {
  unknowns_ = std::move(unknowns);
  equations_ = std::move(equations);
}

void Embedding::restrict(const BlockVector& x, BlockVector& part) const {
  for (std::size_t b = 0; b < places_.size(); ++b) {
    const auto from = x[places_[b].block].getLocalViewHost(read_only);
    const auto to = part[static_cast<int>(b)].getLocalViewHost(overwrite_all);
    for (std::size_t i = 0; i < rows_[b].size(); ++i)
      to(i, 0) = unknowns_[b] * from(rows_[b][i], 0);
  }
}

void Embedding::insert(const BlockVector& part, BlockVector& x) const {
  for (std::size_t b = 0; b < places_.size(); ++b) {
    const auto from = part[static_cast<int>(b)].getLocalViewHost(read_only);
    const auto to = x[places_[b].block].getLocalViewHost(read_write);
    for (std::size_t i = 0; i < rows_[b].size(); ++i)
      to(rows_[b][i], 0) = from(i, 0) / unknowns_[b];
  }
}

void Embedding::add(const BlockVector& part, BlockVector& F) const {
  add_weighted(equations_, part, F);
}

void Embedding::add_weighted(const std::vector<double>& weights, const BlockVector& part,
                             BlockVector& x) const {
  for (std::size_t b = 0; b < places_.size(); ++b) {
    const auto from = part[static_cast<int>(b)].getLocalViewHost(read_only);
    const auto to = x[places_[b].block].getLocalViewHost(read_write);
    for (std::size_t i = 0; i < rows_[b].size(); ++i) to(rows_[b][i], 0) += weights[b] * from(i, 0);
  }
}

void Embedding::add_block(const CrsMatrix& part, int row, int column, CrsMatrix& whole) const {
  const auto numbers_of = [this](const Map& map, int b) {
    std::vector<GlobalOrdinal> numbers;
    for (const GlobalOrdinal number : global_numbers(map))
      numbers.push_back(places_[b].numbers[places_[b].with_ghosts->getLocalElement(number)]);
    return numbers;
  };
  const std::vector<int> offsets = entry_offsets(part, numbers_of(*part.getRowMap(), row),
                                                 numbers_of(*part.getColMap(), column), whole);
  const auto from = part.getLocalMatrixHost().values;
  const auto to = whole.getLocalMatrixHost().values;
  const double unit = equations_[row] * unknowns_[column];
  for (std::size_t k = 0; k < offsets.size(); ++k) to(offsets[k]) += unit * from(k);
}

void Embedding::set_products(const LowRank& part, LowRank& whole, int first) const {
  for (int k = 0; k < part.rank(); ++k) {
    const RankOne& from = part[k];
    RankOne& to = whole[first + k];
    to.scale = from.scale;
    to.w.set_zero();
    to.v.set_zero();
    add_weighted(equations_, from.w, to.w);  // R Pᵀ w
    add_weighted(unknowns_, from.v, to.v);   // S Pᵀ v
  }
}

}  // namespace tunica::algebra
