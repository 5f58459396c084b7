#include "tunica/coupling/iqn_ils.hpp"

#include <cmath>
#include <numeric>

#include "tunica/algebra/least_squares.hpp"

namespace tunica::coupling {

IqnIls::IqnIls(const Teuchos::ParameterList& list, const CommPtr& comm)
    : comm_(comm), first_factor_(list.get<double>("first factor")),
      filter_(list.get<double>("filter")), update_growth_(list.get<double>("update growth")),
      reused_steps_(list.get<int>("reused steps")) {}

// Columns of this step come in front of those of earlier ones.
void IqnIls::begin_step() {
  is_first_ = true;
  columns_of_step_.push_front(0);
}

// V ← [r_k − r_{k−1}, V],   W ← [d̃_k − d̃_{k−1}, W]: differences within a step only, since the
// wall's answer to the same d is another in the next.
void IqnIls::remember(const InterfaceVector& answer, const InterfaceVector& residual) {
  if (!is_first_) {
    V_.push_front(difference(residual, last_residual_));
    W_.push_front(difference(answer, last_answer_));
    ++columns_of_step_.front();
  }
  is_first_ = false;
  last_residual_ = residual;
  last_answer_ = answer;
}

InterfaceVector IqnIls::next(const InterfaceVector& d, const InterfaceVector& residual) {
  // d̃ = d + r
  InterfaceVector answer(d);
  for (std::size_t i = 0; i < d.size(); ++i) answer[i] += residual[i];
  const double last_update = is_first_ ? 0.0 : length(difference(d, last_d_));
  remember(answer, residual);
  last_d_ = d;
  // −c = argmin |V c − r|, over all ranks and the newest columns first
  const algebra::LeastSquares fit = algebra::solve_least_squares(*comm_, V_, residual, filter_);
  columns_ = 0;
  // d_next = d − (W − V) c + ω P (r − V c), c the least-squares solution of V c ≈ r
  InterfaceVector next_d(d), left(residual);
  for (std::size_t j = 0; j < W_.size(); ++j) {
    columns_ += fit.is_kept[j];
    for (std::size_t i = 0; i < d.size(); ++i) {
      next_d[i] -= fit.coefficients[j] * (W_[j][i] - V_[j][i]);
      left[i] -= fit.coefficients[j] * V_[j][i];
    }
  }
  // P takes what the model leaves; without a model that is all of r, and is relaxed.
  relaxation_ = columns_ > 0 ? 1.0 : first_factor_;
  const InterfaceVector z = preconditioned(left);
  for (std::size_t i = 0; i < d.size(); ++i) next_d[i] += relaxation_ * z[i];
  if (last_update > 0.0 && update_growth_ > 0.0) bound(d, update_growth_ * last_update, next_d);
  return next_d;
}

double IqnIls::length(const InterfaceVector& x) const {
  return std::sqrt(inner_product(*comm_, x, x));
}

// d + s (next − d),   s = min(1, most/|next − d|)
void IqnIls::bound(const InterfaceVector& d, double most, InterfaceVector& next_d) {
  const InterfaceVector update = difference(next_d, d);
  const double part = most / length(update);
  if (!(part < 1.0)) return;
  relaxation_ *= part;
  for (std::size_t i = 0; i < d.size(); ++i) next_d[i] = d[i] + part * update[i];
}

void IqnIls::end_step() { keep_steps(reused_steps_); }

void IqnIls::forget() { keep_steps(0); }

void IqnIls::save(fields::State& state) const {
  state.numbers["columns of steps"] = {columns_of_step_.begin(), columns_of_step_.end()};
  state.arrays["V"] = packed(V_);
  state.arrays["W"] = packed(W_);
}

void IqnIls::restore(const fields::State& state) {
  const std::vector<double>& counts = state.number_list("columns of steps");
  columns_of_step_.assign(counts.begin(), counts.end());
  // Each vector has three columns, one for each component.
  const int columns = 3 * std::accumulate(columns_of_step_.begin(), columns_of_step_.end(), 0);
  V_ = unpacked(state.array("V", columns));
  W_ = unpacked(state.array("W", columns));
  keep_steps(reused_steps_);  // the case may reuse fewer than before
}

// The oldest step stands last, and so do its columns in V and W.
void IqnIls::keep_steps(int most) {
  while (static_cast<int>(columns_of_step_.size()) > most) {
    for (int j = 0; j < columns_of_step_.back(); ++j) {
      V_.pop_back();
      W_.pop_back();
    }
    columns_of_step_.pop_back();
  }
}

params::Table iqn_ils_table() {
  params::Table table("interface quasi-Newton with a least-squares model");
  table
      .number("first factor", 1.0, params::Range{0.0, 1.0, true, false}, "1",
              "relaxation factor as long as there is no column")
      .number("filter", 1e-7, params::Range{0.0, 1.0, false, true}, "1",
              "drop a column if less than this part of its length is linearly independent of the "
              "newer ones")
      .number("update growth", 4.0, params::non_negative(), "1",
              "an update is at most this many times the last one of its step, since the first "
              "columns overestimate; 0: no limit")
      .integer("reused steps", 8, params::between(0, 100),
               "number of earlier time steps whose columns are reused");
  return table;
}

}  // namespace tunica::coupling
