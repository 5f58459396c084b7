#pragma once
#include <memory>
#include <vector>

#include "tunica/linear/linear_solver.hpp"
#include "tunica/systems/read_system.hpp"

namespace tunica::foreign {

/// Solves with all of K where some scalars border the part K₀ that another solver knows:
///
///   [K₀ B] [x]   [b]      λ   the border's scalars
///   [C  D] [λ] = [c]
///
///   x = K₀⁺ (b − B λ) + N α      N   what K₀ leaves undetermined, L the same of K₀ᵀ
///
///   [Lᵀ B         0  ] [λ]   [Lᵀ b       ]
///   [D − C K₀⁺ B  C N] [α] = [c − C K₀⁺ b]
///
/// Where L is not known, K₀⁺ is the inverse of K₀ + σ e eᵀ (hold_constants()), and the first
/// equation is that of eᵀ K₀⁺ (b − B λ) = 0.
///
/// K₀⁺ B takes a solve for each scalar of the border, once for a matrix. K₀ may be singular, as
/// that of a flow whose pressure is determined by the border alone.
class BorderedSolver final : public linear::LinearSolver {
public:
  /// of_inside: of K₀, which is the system's K. The system must outlive it.
  BorderedSolver(const systems::System& system, std::unique_ptr<LinearSolver> of_inside);

  void matrix_changed() override;
  void prepare() override { inside_->prepare(); }
  void forget() override { inside_->forget(); }
  /// The report is that of K₀⁺ b, with the costs of all.
  linear::SolveReport solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                            double tolerance) override;

private:
  void look_at_border();
  void find_inverse_of_columns(double tolerance, linear::SolveReport& costs);
  std::vector<double> border_of(const algebra::BlockVector& x) const;
  void set_border(const std::vector<double>& values, algebra::BlockVector& x) const;
  algebra::BlockVector solvable(const algebra::BlockVector& b) const;
  std::vector<double> small_solution(const algebra::BlockVector& b,
                                     const algebra::BlockVector& y) const;

  const systems::System* system_;
  std::unique_ptr<LinearSolver> inside_;
  std::vector<algebra::BlockVector> B_, C_, Z_;  ///< columns, rows, K₀⁺ B; zero in the border
  std::vector<std::vector<double>> D_;           ///< by columns
};

/// of_inside itself for a system without a border.
std::unique_ptr<linear::LinearSolver> with_border(const systems::System& system,
                                                  std::unique_ptr<linear::LinearSolver> of_inside);

}  // namespace tunica::foreign
