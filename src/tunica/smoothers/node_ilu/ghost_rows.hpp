#pragma once
#include <vector>

#include "tunica/smoothers/node_ilu/node_blocks.hpp"

namespace tunica::smoothers {

/// The rows of other ranks that own rows reach, whole, so that their residuals are found here: a
/// sweep of overlapping factors then needs one message to each neighbour in place of two. Vectors
/// have the places of NodeBlocks, x with further ones for the columns beyond these.
template <class Real>
class GhostRows {
public:
  /// blocks must outlive the object and be those of several ranks. Collective.
  explicit GhostRows(const NodeBlocks& blocks);
  int n_beyond() const { return static_cast<int>(beyond_); }  ///< further places of x

  /// Takes over the values that blocks has fetched.
  void refresh();
  /// Values of other ranks that own rows reach, from their owners. Collective.
  void fetch(std::vector<double>& values) { fetch(*blocks_->ghost_import(), ghosts_, {&values}); }
  /// Of x those that own rows and ghosts' rows reach. Collective.
  void fetch_halo(std::vector<double>& x) { fetch(*halo_, of_x_, {&x}); }
  /// The same, and b of the ghosts' rows, in the same message. Collective.
  void fetch_halo(std::vector<double>& x, std::vector<double>& b) {
    fetch(*halo_, of_x_and_b_, {&x, &b});
  }
  /// r = b − K x of the ghosts' rows
  void find_residual(const std::vector<double>& b, const std::vector<double>& x,
                     std::vector<double>& r) const;
  double bytes() const;

private:
  /// What travels, own and fetched: kept, as each sweep sends.
  struct Parcel {
    MultiVector own, fetched;
  };

  static Parcel parcel(const Import& import, std::size_t columns) {
    return {MultiVector(import.getSourceMap(), columns),
            MultiVector(import.getTargetMap(), columns)};
  }
  void fetch(const Import& import, Parcel& parcel, const std::vector<std::vector<double>*>& all);

  const NodeBlocks* blocks_;
  std::size_t beyond_ = 0;
  Teuchos::RCP<const Import> halo_;  ///< ghosts' rows, then what lies beyond
  std::vector<int> halo_places_;     ///< of its values
  std::vector<std::size_t> start_;   ///< of the rows
  std::vector<int> columns_;         ///< places
  std::vector<Real> values_;
  Parcel ghosts_, of_x_, of_x_and_b_;
};

}  // namespace tunica::smoothers
