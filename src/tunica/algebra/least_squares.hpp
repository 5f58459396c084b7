#pragma once
#include <deque>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// Coefficients c of min |b − Σ_j c_j v_j| over all ranks, by Gram–Schmidt with
/// reorthogonalisation in the order given. A column that lies within `filter` times its length
/// of the ones before it is dropped and gets no coefficient.
struct LeastSquares {
  std::vector<double> coefficients;  ///< per column; 0 where dropped
  std::vector<char> is_kept;
};
LeastSquares solve_least_squares(const Comm& comm, const std::deque<std::vector<double>>& columns,
                                 const std::vector<double>& b, double filter);

}  // namespace tunica::algebra
