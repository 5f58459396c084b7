#include "tunica/smoothers/node_ilu/ghost_rows.hpp"

#include <algorithm>

#include "tunica/base/map_of.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::smoothers {

template <class Real>
GhostRows<Real>::GhostRows(const NodeBlocks& blocks)
    : blocks_(&blocks), halo_places_(blocks.ghost_places()) {
  const CrsMatrix& rows = *blocks.ghost_rows();
  // Columns that no place stands for get one behind all others. Of a node that is known, own rows
  // need not reach each unknown.
  std::vector<int> places(blocks.ghost_column_places());
  const int known = blocks.width() * blocks.n_nodes();
  std::vector<char> is_fetched(known, 0);
  for (const std::vector<int>* some : {&blocks.place_of_row(), &blocks.ghost_places()})
    for (const int place : *some) is_fetched[place] = 1;
  const auto own = global_numbers(*rows.getRowMap());
  std::vector<GlobalOrdinal> halo(own.begin(), own.end());
  for (std::size_t c = 0; c < places.size(); ++c) {
    if (places[c] >= 0 && is_fetched[places[c]]) continue;
    if (places[c] < 0) places[c] = known + static_cast<int>(beyond_++);
    halo.push_back(rows.getColMap()->getGlobalElement(static_cast<int>(c)));
    halo_places_.push_back(places[c]);
  }
  halo_ =
      Teuchos::rcp(new Import(blocks.ghost_import()->getSourceMap(), map_of(halo, rows.getComm())));
  const auto local = rows.getLocalMatrixHost();
  const std::size_t* const first = local.graph.row_map.data();
  start_.assign(first, first + own.size() + 1);
  for (std::size_t k = 0; k < start_.back(); ++k)
    columns_.push_back(places[local.graph.entries(k)]);
  values_.resize(columns_.size());
  ghosts_ = parcel(*blocks.ghost_import(), 1);
  of_x_ = parcel(*halo_, 1);
  of_x_and_b_ = parcel(*halo_, 2);
}

template <class Real>
void GhostRows<Real>::refresh() {
  const auto local = blocks_->ghost_rows()->getLocalMatrixHost();
  std::transform(local.values.data(), local.values.data() + values_.size(), values_.begin(),
                 [](double value) { return static_cast<Real>(value); });
}

template <class Real>
void GhostRows<Real>::fetch(const Import& import, Parcel& parcel,
                            const std::vector<std::vector<double>*>& all) {
  {
    const auto to = parcel.own.getLocalViewHost(overwrite_all);
    const std::vector<int>& places = blocks_->place_of_row();
    for (std::size_t j = 0; j < all.size(); ++j)
      for (std::size_t i = 0; i < places.size(); ++i) to(i, j) = (*all[j])[places[i]];
  }
  parcel.fetched.doImport(parcel.own, import, insert);
  const auto from = parcel.fetched.getLocalViewHost(read_only);
  for (std::size_t j = 0; j < all.size(); ++j)
    for (std::size_t i = 0; i < from.extent(0); ++i)
      // Only x has places beyond.
      if (static_cast<std::size_t>(halo_places_[i]) < all[j]->size())
        (*all[j])[halo_places_[i]] = from(i, j);
}

template <class Real>
void GhostRows<Real>::find_residual(const std::vector<double>& b, const std::vector<double>& x,
                                    std::vector<double>& r) const {
  const std::vector<int>& places = blocks_->ghost_places();
  for (std::size_t row = 0; row < places.size(); ++row) {
    double sum = b[places[row]];
    for (std::size_t k = start_[row]; k < start_[row + 1]; ++k) sum -= values_[k] * x[columns_[k]];
    r[places[row]] = sum;
  }
}

template <class Real>
double GhostRows<Real>::bytes() const {
  return static_cast<double>(sizeof(Real) * values_.size() + sizeof(int) * columns_.size() +
                             sizeof(std::size_t) * start_.size());
}

template class GhostRows<float>;
template class GhostRows<double>;

}  // namespace tunica::smoothers
