#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_Core.hpp>
#include <cmath>

#include "tunica/nonlinear/newton.hpp"

namespace {

using namespace tunica;

/// x³ = c_b in every unknown of block b: as many blocks as are asked for, and no mesh.
class CubeRoots final : public nonlinear::NonlinearProblem, public linear::LinearSolver {
public:
  explicit CubeRoots(const std::vector<double>& cubes) : cubes_(cubes) {
    std::vector<algebra::Block> blocks;
    for (std::size_t b = 0; b < cubes.size(); ++b)
      blocks.push_back({"block " + std::to_string(b),
                        Teuchos::rcp(new Map(7 * (b + 1), 0, Tpetra::getDefaultComm())), 1});
    space_ = std::make_shared<const algebra::BlockSpace>(blocks);
    slope_ = algebra::BlockVector(space_);
  }

  const algebra::BlockSpacePtr& space() const override { return space_; }
  Outcome residual(const algebra::BlockVector& x, algebra::BlockVector& F) override {
    for (int b = 0; b < space_->n_blocks(); ++b) {
      F[b].putScalar(-cubes_[b]);
      const auto to = F[b].getLocalViewHost(read_write);
      const auto from = x[b].getLocalViewHost(read_only);
      for (std::size_t i = 0; i < from.extent(0); ++i) to(i, 0) += std::pow(from(i, 0), 3);
    }
    return Outcome::success();
  }
  void jacobian(const algebra::BlockVector& x) override {
    for (int b = 0; b < space_->n_blocks(); ++b)
      slope_[b].elementWiseMultiply(3.0, x[b], x[b], 0.0);
  }
  void apply_jacobian(const algebra::BlockVector& x, algebra::BlockVector& y) const override {
    for (int b = 0; b < space_->n_blocks(); ++b)
      y[b].elementWiseMultiply(1.0, slope_[b], x[b], 0.0);
  }
  linear::LinearSolver& linear_solver() override { return *this; }
  double increment_norm(const algebra::BlockVector& dx) override {
    double sum = 0.0;
    for (int b = 0; b < dx.n_blocks(); ++b) sum += std::pow(dx[b].norm2(), 2);
    return std::sqrt(sum);
  }

  void matrix_changed() override {}
  void prepare() override {}
  void forget() override {}
  linear::SolveReport solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                            double tolerance) override {
    for (int k = 0; k < b.n_blocks(); ++k) {
      Vector inverse(b[k].getMap());
      inverse.reciprocal(slope_[k]);
      x[k].elementWiseMultiply(1.0, inverse, b[k], 0.0);
    }
    linear::SolveReport report;
    report.is_converged = true;
    report.tolerance = tolerance;
    return report;
  }

private:
  std::vector<double> cubes_;
  algebra::BlockSpacePtr space_;
  algebra::BlockVector slope_;
};

TEUCHOS_UNIT_TEST(newton, works_over_any_number_of_blocks) {
  Teuchos::ParameterList list;
  nonlinear::newton_table().resolve(list, "Newton", "");
  for (const std::vector<double>& cubes :
       {std::vector<double>{8.0}, {8.0, 27.0, 64.0}, {1.0, 8.0, 27.0, 64.0, 125.0}}) {
    CubeRoots problem(cubes);
    algebra::BlockVector x(problem.space());
    for (int b = 0; b < x.n_blocks(); ++b) x[b].putScalar(1.5 + b);
    const nonlinear::NewtonReport report =
        solve_newton(problem, nonlinear::newton_options(list), x);
    TEST_ASSERT(report.is_converged);
    for (int b = 0; b < x.n_blocks(); ++b)
      TEST_FLOATING_EQUALITY(x[b].normInf(), std::cbrt(cubes[b]), 1e-12);
  }
}

}  // namespace
