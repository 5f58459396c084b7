#pragma once
#include <cmath>
#include <functional>

#include "tunica/assembly/mass_norm.hpp"
#include "tunica/nonlinear/newton.hpp"
#include "unit/fields/small_tube.hpp"

namespace tunica::test {

/// u = 1 in each component, and f(p) = 0 at every node by itself: Newton's method does on each
/// pressure what it does on one number. Solves its diagonal systems up to the tolerance asked
/// for, always off by its full extent; or fails in a given solve.
class NodewiseProblem : public nonlinear::NonlinearProblem, public linear::LinearSolver {
public:
  using Function = std::function<double(double)>;

  NodewiseProblem(const fields::FieldMesh& mesh, Function f, Function slope)
      : mesh_(&mesh), geometry_(mesh, mesh.x), f_(f), slope_(slope),
        diagonal_(fields::zero_vector(mesh)) {}

  void refuse_where(std::function<bool(double)> refuses) { refuses_ = refuses; }
  void fail_in_solve(int number) { failing_ = number; }
  const std::vector<double>& tolerances() const { return tolerances_; }

  const algebra::BlockSpacePtr& space() const override { return diagonal_.space(); }
  Outcome residual(const algebra::BlockVector& x, algebra::BlockVector& F) override {
    const auto u = x[0].getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto p = x[1].getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto Fu = F[0].getLocalViewHost(Tpetra::Access::OverwriteAll);
    const auto Fp = F[1].getLocalViewHost(Tpetra::Access::OverwriteAll);
    bool is_admissible = true;
    for (std::size_t k = 0; k < u.extent(0); ++k) Fu(k, 0) = u(k, 0) - 1.0;
    for (std::size_t k = 0; k < p.extent(0); ++k) {
      is_admissible = is_admissible && !(refuses_ && refuses_(p(k, 0)));
      Fp(k, 0) = f_(p(k, 0));
    }
    return all_agree(*mesh_->comm, is_admissible) ? Outcome::success()
                                                  : Outcome::failure("p is out of range");
  }
  void jacobian(const algebra::BlockVector& x) override {
    diagonal_[0].putScalar(1.0);
    const auto p = x[1].getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto d = diagonal_[1].getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t k = 0; k < p.extent(0); ++k) d(k, 0) = slope_(p(k, 0));
  }
  void apply_jacobian(const algebra::BlockVector& x, algebra::BlockVector& y) const override {
    y[0].elementWiseMultiply(1.0, diagonal_[0], x[0], 0.0);
    y[1].elementWiseMultiply(1.0, diagonal_[1], x[1], 0.0);
  }
  linear::LinearSolver& linear_solver() override { return *this; }
  double increment_norm(const algebra::BlockVector& dx) override {
    return assembly::mass_norm(*mesh_, geometry_, dx);
  }

  void matrix_changed() override {}
  void prepare() override {}
  void forget() override {}
  linear::SolveReport solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                            double tolerance) override {
    tolerances_.push_back(tolerance);
    Vector inverse(mesh_->node_map);
    inverse.reciprocal(diagonal_[1]);
    x[0].update(1.0, b[0], 0.0);
    x[1].elementWiseMultiply(1.0 - tolerance, inverse, b[1], 0.0);
    linear::SolveReport report;
    report.method = "stub";
    report.is_converged = static_cast<int>(tolerances_.size()) != failing_;
    report.iterations = 3;
    report.tolerance = tolerance;
    report.true_residual = report.is_converged ? tolerance : 0.5;
    return report;
  }

private:
  const fields::FieldMesh* mesh_;
  assembly::ElementGeometry geometry_;
  Function f_, slope_;
  std::function<bool(double)> refuses_;
  algebra::BlockVector diagonal_;
  int failing_ = 0;
  std::vector<double> tolerances_;
};

inline NodewiseProblem square_root_of_two(const fields::FieldMesh& mesh) {
  return {mesh, [](double p) { return p * p - 2.0; }, [](double p) { return 2.0 * p; }};
}
inline NodewiseProblem logarithm(const fields::FieldMesh& mesh) {
  return {mesh, [](double p) { return std::log(p); }, [](double p) { return 1.0 / p; }};
}
inline NodewiseProblem arc_tangent(const fields::FieldMesh& mesh) {
  return {mesh, [](double p) { return std::atan(p); },
          [](double p) { return 1.0 / (1.0 + p * p); }};
}

/// The defaults, with linear solves that are as good as exact.
inline nonlinear::NewtonOptions options() {
  Teuchos::ParameterList list;
  nonlinear::newton_table().resolve(list, "Newton", "");
  auto found = nonlinear::newton_options(list);
  found.forcing.tolerance = 1e-12;
  return found;
}

inline algebra::BlockVector start(const fields::FieldMesh& mesh, double p) {
  return block_vector(mesh, [p](int, int i) { return i < 3 ? 1.0 : p; });
}

inline double worst_pressure(const algebra::BlockVector& x, double expected) {
  Vector difference(x[1], Teuchos::Copy);
  for (std::size_t k = 0; k < difference.getLocalLength(); ++k)
    difference.sumIntoLocalValue(static_cast<int>(k), -expected);
  return difference.normInf();
}

}  // namespace tunica::test
