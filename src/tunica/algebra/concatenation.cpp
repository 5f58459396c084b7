#include "tunica/algebra/concatenation.hpp"

#include <stdexcept>

#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

namespace {

Teuchos::RCP<const Map> concatenated_map(const BlockSpace& space) {
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  std::size_t count = 0;
  for (int b = 0; b < space.n_blocks(); ++b) count += n_local(*space[b].map);
  return Teuchos::rcp(new Map(unknown, count, 0, space.comm()));
}

}  // namespace

Concatenation::Concatenation(BlockSpacePtr space)
    : space_(std::move(space)), map_(concatenated_map(*space_)) {}

std::vector<Teuchos::RCP<MultiVector>> Concatenation::parts(const MultiVector& x) const {
  std::vector<Teuchos::RCP<MultiVector>> views;
  std::size_t first = 0;
  for (int b = 0; b < space_->n_blocks(); ++b) {
    const Teuchos::RCP<const Map>& map = (*space_)[b].map;
    views.push_back(const_cast<MultiVector&>(x).offsetViewNonConst(map, first));
    first += n_local(*map);
  }
  return views;
}

void Concatenation::gather(const BlockVector& x, MultiVector& all) const {
  const auto views = parts(all);
  for (std::size_t b = 0; b < views.size(); ++b) views[b]->assign(x[static_cast<int>(b)]);
}

void Concatenation::scatter(const MultiVector& all, BlockVector& x) const {
  const auto views = parts(all);
  for (std::size_t b = 0; b < views.size(); ++b) x[static_cast<int>(b)].assign(*views[b]);
}

void ConcatenatedOperator::apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode,
                                 Scalar alpha, Scalar beta) const {
  if (mode != Teuchos::NO_TRANS) throw std::logic_error("ConcatenatedOperator: no transpose");
  K_->apply_blocks(blocks_.parts(X), blocks_.parts(Y), alpha, beta);
}

}  // namespace tunica::algebra
