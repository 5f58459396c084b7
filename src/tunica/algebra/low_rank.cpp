#include "tunica/algebra/low_rank.hpp"

#include <Teuchos_CommHelpers.hpp>

namespace tunica::algebra {

LowRank::LowRank(const BlockSpacePtr& space, int rank) {
  for (int k = 0; k < rank; ++k) parts_.push_back({0.0, BlockVector(space), BlockVector(space)});
}

void LowRank::add(const std::vector<Teuchos::RCP<MultiVector>>& x,
                  const std::vector<Teuchos::RCP<MultiVector>>& y, Scalar alpha) const {
  const std::size_t columns = x.front()->getNumVectors();
  std::vector<double> mine(columns * parts_.size(), 0.0), c(mine.size());
  for (std::size_t b = 0; b < x.size(); ++b) {
    const auto from = x[b]->getLocalViewHost(read_only);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const auto v = parts_[k].v[static_cast<int>(b)].getLocalViewHost(read_only);
      for (std::size_t j = 0; j < columns; ++j)
        for (std::size_t i = 0; i < v.extent(0); ++i)
          mine[k * columns + j] += v(i, 0) * from(i, j);  // v_kᵀ x
    }
  }
  Teuchos::reduceAll(*x.front()->getMap()->getComm(), Teuchos::REDUCE_SUM,
                     static_cast<int>(mine.size()), mine.data(), c.data());
  for (std::size_t b = 0; b < y.size(); ++b) {
    const auto to = y[b]->getLocalViewHost(read_write);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const auto w = parts_[k].w[static_cast<int>(b)].getLocalViewHost(read_only);
      for (std::size_t j = 0; j < columns; ++j) {
        const double factor = alpha * parts_[k].scale * c[k * columns + j];
        for (std::size_t i = 0; i < w.extent(0); ++i) to(i, j) += factor * w(i, 0);
      }
    }
  }
}

}  // namespace tunica::algebra
