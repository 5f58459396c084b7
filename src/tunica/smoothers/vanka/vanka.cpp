#include "tunica/smoothers/vanka/vanka.hpp"

#include <stdexcept>

#include "tunica/algebra/columns.hpp"
#include "tunica/algebra/independent_set.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/smoothers/vanka/patch_rows.hpp"
#include "tunica/smoothers/vanka/patch_solver.hpp"

namespace tunica::smoothers {

namespace {

class PatchVanka final : public Vanka {
public:
  PatchVanka(const CrsMatrix& K, const MixedRows& mixed, const VankaOptions& options)
      : K_(&K), mixed_(mixed), options_(options), rows_(make_patch_rows(K, mixed.is_pressure)) {
    update_b2_pattern(K, mixed_.is_pressure, reaches_);
    std::string problem;
    try {
      find_patches();
    } catch (const std::invalid_argument& error) {
      problem = error.what();
    }
    throw_if_any<std::invalid_argument>(*K.getComm(), problem);
  }

  void refresh() override {
    // Of the values patches depend on the zeros of B2 alone.
    if (update_b2_pattern(*K_, mixed_.is_pressure, reaches_)) find_patches();
    rows_->refresh();
    std::string singular;
    if (const int patch = solver_->refresh(); patch >= 0)
      singular =
          "the patch of the pressure in" + name(patches_.rows[patches_.start[patch + 1] - 1]);
    if (const int row = refresh_uncovered_rows(); row >= 0 && singular.empty())
      singular = "the diagonal of the velocity in" + name(row);
    if (!singular.empty()) singular = "Vanka: " + singular + " is singular.";
    throw_if_any<std::runtime_error>(*K_->getComm(), singular);
  }

  void smooth(const MultiVector& b, MultiVector& x) const override {
    algebra::for_each_column("Vanka", b, x,
                             [&](const auto& b_c, auto& x_c) { smooth_column(b_c, x_c); });
  }

  double bytes() const override {
    const double numbers = static_cast<double>(patches_.rows.size() +
                                               patches_.column_of_row.size() + mixed_.place.size());
    return rows_->bytes() + solver_->bytes() + sizeof(int) * numbers +
           static_cast<double>(sizeof(std::size_t) * patches_.start.size() +
                               sizeof(double) * share_.size() + reaches_.size() +
                               mixed_.is_pressure.size());
  }

private:
  struct Scratch {
    Scratch(std::size_t patch, std::size_t all) : residual(patch), correction(patch), sums(all) {}
    std::vector<double> residual, correction;  ///< of one patch at a time
    std::vector<double> sums;                  ///< of the corrections of all
  };

  void smooth_column(const MultiVector& b, MultiVector& x) const {
    MultiVector all(K_->getColMap(), 1);  // own and ghost values
    Scratch scratch(patches_.largest(), options_.is_additive ? share_.size() : 0);
    for (int sweep = 0; sweep < options_.sweeps; ++sweep) {
      // Ghosts keep these values during the sweep: between ranks it is additive.
      algebra::fetch_columns(*K_, x, all);
      const auto rhs = b.getLocalViewHost(read_only);
      {
        const auto inside = all.getLocalViewHost(read_write);
        sweep_patches(rhs.data(), inside.data(), scratch);
      }
      const auto from = all.getLocalViewHost(read_only);
      const auto to = x.getLocalViewHost(overwrite_all);
      for (std::size_t i = 0; i < to.extent(0); ++i) to(i, 0) = from(patches_.column_of_row[i], 0);
    }
  }

  void find_patches() {
    if (options_.patch == "full")
      patches_ = make_vanka_patches(*K_, mixed_.is_pressure);
    else if (options_.patch == "diagonal")
      patches_ = make_nodal_patches(*K_, mixed_);
    else
      patches_ = make_pair_patches(*K_, mixed_);
    solver_.reset();  // its memory first
    solver_ = options_.is_single ? solver<float>() : solver<double>();
    // W of the additive sweep: 1 over the number of patches that have the row
    share_.assign(mixed_.is_pressure.size(), 0.0);
    for (const int row : patches_.rows) share_[row] += 1.0;
    for (double& share : share_)
      if (share > 0.0) share = 1.0 / share;
  }

  template <class Real>
  std::unique_ptr<PatchSolver> solver() const {
    if (options_.patch != "diagonal") return make_dense_solver<Real>(*K_, patches_);
    return make_diagonal_solver<Real>(*K_, patches_, mixed_);
  }

  std::string name(int row) const {
    return " row " + std::to_string(K_->getRowMap()->getGlobalElement(row)) + " of " +
           std::to_string(K_->getGlobalNumRows()) + " unknowns";
  }

  /// One without diagonal, or -1.
  int refresh_uncovered_rows() {
    int singular = -1;
    uncovered_factor_.resize(patches_.uncovered_rows.size());
    const auto K = K_->getLocalMatrixHost();
    for (std::size_t l = 0; l < patches_.uncovered_rows.size(); ++l) {
      const auto row = K.rowConst(patches_.uncovered_rows[l]);
      double diagonal = 0.0;
      for (int k = 0; k < row.length; ++k)
        if (row.colidx(k) == patches_.column_of_row[patches_.uncovered_rows[l]])
          diagonal = row.value(k);
      if (diagonal == 0.0 && singular < 0) singular = patches_.uncovered_rows[l];
      uncovered_factor_[l] = 1.0 / diagonal;
    }
    return singular;
  }

  /// One sweep on the own and ghost values x.
  void sweep_patches(const double* b, double* x, Scratch& scratch) const {
    for (std::size_t l = 0; l < patches_.uncovered_rows.size(); ++l) {
      const int row = patches_.uncovered_rows[l];
      double r = 0.0;
      rows_->residual(&row, 1, b, x, &r, {});
      x[patches_.column_of_row[row]] += uncovered_factor_[l] * r;  // x_i += r_i / K_ii
    }
    if (options_.is_additive) return sweep_patches_at_once(b, x, scratch);
    // x += ω K_P⁻¹ (b − K x)_P, patch by patch
    const auto relax = [&](int patch) {
      solve(patch, b, x, scratch, [&](int row, double correction) {
        x[patches_.column_of_row[row]] += options_.damping * correction;
      });
    };
    const int n = patches_.n_patches();
    if (options_.order != "backward")
      for (int p = 0; p < n; ++p) relax(p);
    if (options_.order != "forward")
      for (int p = n - 1; p >= 0; --p) relax(p);
  }

  void sweep_patches_at_once(const double* b, double* x, Scratch& scratch) const {
    // x += ω Σ_P W K_P⁻¹ (b − K x)_P, W the share of each row
    scratch.sums.assign(share_.size(), 0.0);
    for (int p = 0; p < patches_.n_patches(); ++p)
      solve(p, b, x, scratch,
            [&](int row, double correction) { scratch.sums[row] += share_[row] * correction; });
    for (std::size_t i = 0; i < share_.size(); ++i)
      x[patches_.column_of_row[i]] += options_.damping * scratch.sums[i];
  }

  /// Gives every row of a patch what solves the patch for the present residual. What the solver
  /// reads comes from far while the processor works on the residual.
  template <class Give>
  void solve(int patch, const double* b, const double* x, Scratch& scratch,
             const Give& give) const {
    const int n = patches_.size(patch);
    const int* const rows = patches_.rows.data() + patches_.start[patch];
    rows_->residual(rows, n, b, x, scratch.residual.data(), solver_->memory(patch));
    solver_->solve(patch, scratch.residual.data(), scratch.correction.data());
    for (int a = 0; a < n; ++a) give(rows[a], scratch.correction[a]);
  }

  const CrsMatrix* K_;
  MixedRows mixed_;
  std::vector<char> reaches_;  ///< of the entries of pressure rows
  VankaOptions options_;
  VankaPatches patches_;
  std::unique_ptr<PatchRows> rows_;
  std::unique_ptr<PatchSolver> solver_;
  std::vector<double> share_;             ///< 1 / number of patches of a row
  std::vector<double> uncovered_factor_;  ///< 1 / diagonal of each uncovered row
};

}  // namespace

std::unique_ptr<Vanka> make_vanka(const CrsMatrix& K, const MixedRows& mixed,
                                  const VankaOptions& options) {
  return std::make_unique<PatchVanka>(K, mixed, options);
}

}  // namespace tunica::smoothers
