#include "tunica/algebra/merged_rows.hpp"

#include "tunica/algebra/dof_layout.hpp"
#include "tunica/algebra/entry_offsets.hpp"

namespace tunica::algebra {

MergedRows::MergedRows(const BlockSpace& space, const Map& merged) {
  const DofLayout layout(space);
  for (int b = 0; b < space.n_blocks(); ++b)
    rows_.push_back(local_numbers(layout.merged_numbers(*space[b].map, b), merged));
}

void MergedRows::merge(const BlockVector& x, MultiVector& merged) const {
  const auto all = merged.getLocalViewHost(overwrite_all);
  for (int b = 0; b < x.n_blocks(); ++b) {
    const auto from = x[b].getLocalViewHost(read_only);
    for (std::size_t i = 0; i < rows_[b].size(); ++i) all(rows_[b][i], 0) = from(i, 0);
  }
}

void MergedRows::split(const MultiVector& merged, BlockVector& x) const {
  const auto all = merged.getLocalViewHost(read_only);
  for (int b = 0; b < x.n_blocks(); ++b) {
    const auto to = x[b].getLocalViewHost(overwrite_all);
    for (std::size_t i = 0; i < rows_[b].size(); ++i) to(i, 0) = all(rows_[b][i], 0);
  }
}

}  // namespace tunica::algebra
