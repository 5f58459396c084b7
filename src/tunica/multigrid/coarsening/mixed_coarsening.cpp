#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"

#include <algorithm>
#include <stdexcept>

#include "tunica/algebra/independent_set.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::multigrid {

namespace {

/// Takes a prolongator of nodes to the unknowns stride*node + first + i, i < count. A coarse node
/// has those that it has on the finer level.
class Expansion {
public:
  Expansion(NodalCoarsening& nodes, int level, int stride, int first, int count, const Map& fine)
      : P_(nodes.prolongator(level)), stride_(stride), first_(first), count_(count) {
    Vector owns(P_->getRowMap()), coarse_owns(P_->getDomainMap());
    const auto has = owns.getLocalViewHost(read_write);
    for (std::size_t a = 0; a < has.extent(0); ++a)
      for (int i = 0; i < count; ++i)
        if (fine.isNodeGlobalElement(number(P_->getRowMap()->getGlobalElement(a), i)))
          has(a, 0) += 1 << i;
    const std::vector<int>& rows = nodes.coarse_rows(level);
    const auto coarse_has = coarse_owns.getLocalViewHost(overwrite_all);
    for (std::size_t c = 0; c < rows.size(); ++c) coarse_has(c, 0) = has(rows[c], 0);
    fine_ = flags(owns);
    coarse_ = flags(coarse_owns);
    columns_ = flags(algebra::on_columns(*P_, coarse_owns));
  }

  int most_parents() const { return static_cast<int>(longest_local_row(*P_)); }

  void append_coarse(std::vector<GlobalOrdinal>& numbers) const {
    for (std::size_t c = 0; c < coarse_.size(); ++c)
      for (int i = 0; i < count_; ++i)
        if (coarse_[c] >> i & 1)
          numbers.push_back(number(P_->getDomainMap()->getGlobalElement(c), i));
  }

  void insert_into(CrsMatrix& result) const {
    const auto local = P_->getLocalMatrixHost();
    std::vector<GlobalOrdinal> parents;
    for (int a = 0; a < local.numRows(); ++a)
      for (int i = 0; i < count_; ++i) {
        if (!(fine_[a] >> i & 1)) continue;
        parents.clear();
        const auto row = local.rowConst(a);
        for (int k = 0; k < row.length; ++k)
          if (columns_[row.colidx(k)] >> i & 1)
            parents.push_back(number(P_->getColMap()->getGlobalElement(row.colidx(k)), i));
        const std::vector<Scalar> weights(parents.size(),
                                          1.0 / static_cast<double>(parents.size()));
        result.insertGlobalValues(number(P_->getRowMap()->getGlobalElement(a), i),
                                  Teuchos::arrayViewFromVector(parents),
                                  Teuchos::arrayViewFromVector(weights));
      }
  }

private:
  GlobalOrdinal number(GlobalOrdinal node, int i) const { return stride_ * node + first_ + i; }

  static std::vector<int> flags(const Vector& v) {
    const auto values = v.getLocalViewHost(read_only);
    std::vector<int> all(values.extent(0));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(values(i, 0));
    return all;
  }

  Teuchos::RCP<const CrsMatrix> P_;
  int stride_, first_, count_;
  std::vector<int> fine_, coarse_, columns_;  ///< bit i: the node has unknown i
};

}  // namespace

MixedCoarsening::MixedCoarsening(const algebra::BlockMatrices& K)
    : numbering_{K.components},
      vectors_(std::make_shared<NodalCoarsening>(K.vectors.graph, *K.vectors.order)),
      scalars_(K.scalars.graph == K.vectors.graph
                   ? vectors_
                   : std::make_shared<NodalCoarsening>(K.scalars.graph, *K.scalars.order)) {
  maps_[{0, Part::vector}] = K.vector_map();
  maps_[{0, Part::scalar}] = K.scalar_map();
  maps_[{0, Part::both}] = numbering_.mixed_map(*K.vector_map(), *K.scalar_map());
}

Teuchos::RCP<const CrsMatrix> MixedCoarsening::prolongator(int level, const Map& rows) {
  return prolongator(level, part_of(level, rows));
}

MixedCoarsening::Part MixedCoarsening::part_of(int level, const Map& rows) {
  std::vector<Part> found;
  for (const Part part : {Part::both, Part::vector, Part::scalar})
    if (map(level, part)->getGlobalNumElements() == rows.getGlobalNumElements())
      found.push_back(part);
  // Blocks on different nodes may have as many rows.
  for (const Part part : found)
    if (found.size() == 1 || map(level, part)->isSameAs(rows)) return part;
  throw std::runtime_error("NodalPFactory: no block has these " +
                           std::to_string(rows.getGlobalNumElements()) + " rows on level " +
                           std::to_string(level) + ".");
}

void MixedCoarsening::check_mixed(int level, const CrsMatrix& K) {
  const auto has_rows_of = [&](Part part) {
    return map(level, part)->getGlobalNumElements() == K.getGlobalNumRows();
  };
  if (has_rows_of(Part::both)) return;
  const Map& rows = *K.getRowMap();
  const std::size_t n = n_local(rows), dofs = numbering_.dofs();
  // Whole nodes are as good where another coarsening made the level.
  const bool is_block = has_rows_of(Part::vector) || has_rows_of(Part::scalar);  // collective
  bool is_mixed = n % dofs == 0 && !is_block;
  for (std::size_t i = 0; is_mixed && i < n; ++i)
    is_mixed = rows.getGlobalElement(static_cast<int>(i)) % numbering_.dofs() ==
               static_cast<GlobalOrdinal>(i % dofs);
  const std::string problem = agreed_message(
      *rows.getComm(), is_mixed ? ""
                                : "a smoother for mixed matrices needs one with " +
                                      std::to_string(dofs) + " unknowns per node, the scalar last");
  if (!problem.empty()) throw std::runtime_error(problem);
}

const Teuchos::RCP<const Map>& MixedCoarsening::map(int level, Part part) {
  if (level > 0) prolongator(level - 1, part);
  return maps_.at({level, part});
}

Teuchos::RCP<const CrsMatrix> MixedCoarsening::prolongator(int level, Part part) {
  const auto found = prolongators_.find({level, part});
  if (found != prolongators_.end()) return found->second;
  const Teuchos::RCP<const Map> fine = map(level, part);
  const int components = numbering_.components;
  const int stride = part == Part::both ? numbering_.dofs() : components;
  std::vector<Expansion> expansions;
  if (part != Part::scalar) expansions.emplace_back(*vectors_, level, stride, 0, components, *fine);
  if (part == Part::both) expansions.emplace_back(*scalars_, level, stride, components, 1, *fine);
  if (part == Part::scalar) expansions.emplace_back(*scalars_, level, 1, 0, 1, *fine);
  std::vector<GlobalOrdinal> numbers;
  int most_parents = 0;
  for (const Expansion& expansion : expansions) {
    expansion.append_coarse(numbers);
    most_parents = std::max(most_parents, expansion.most_parents());
  }
  std::sort(numbers.begin(), numbers.end());
  const Teuchos::RCP<const Map> coarse = map_of(numbers, fine->getComm());
  const auto P = Teuchos::rcp(new CrsMatrix(fine, most_parents));
  for (const Expansion& expansion : expansions) expansion.insert_into(*P);
  P->fillComplete(coarse, fine);
  maps_[{level + 1, part}] = coarse;
  return prolongators_[{level, part}] = P;
}

}  // namespace tunica::multigrid
