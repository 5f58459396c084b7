#pragma once
#include <string>
#include <vector>

#include "tunica/systems/read_system.hpp"

namespace tunica::systems {

/// Takes new values of one matrix K with all unknowns to the system that was made of it, without
/// work on graphs: what the preparation has found in the old values, scales and known unknowns,
/// stays as it is.
class NewValues {
public:
  /// pattern: of all rows that any rank knows, in any portions; counted from first_row. Collective.
  NewValues(const SparseRows& pattern, long long first_row, const System& system);

  /// Values in the order of the columns of the pattern. Returns why what was found in the old ones
  /// does not hold for these, the same on all ranks, or nothing. Collective.
  std::string take(const double* values, System& system) const;

private:
  void fill(const double* values, System& system) const;
  void prepare(System& system) const;

  std::size_t n_values_;
  std::vector<int> ranks_;  ///< that have the rows, of each value
  /// Of values in the order of their arrival: the block, and where they stand in it.
  std::vector<std::pair<int, std::size_t>> places_;
  std::vector<std::vector<int>> offsets_;  ///< of each value of the blocks of K in those given
};

}  // namespace tunica::systems
