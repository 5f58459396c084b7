#pragma once
#include <memory>

#include "tunica/coupling/scheme.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/mesh_motion.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "tunica/run/domain.hpp"
#include "tunica/run/run_output.hpp"
#include "tunica/setup/case.hpp"

namespace tunica::run {

/// The fields that a case solves for, each with its kernels, blocks and solver, and the coupling if
/// there are two. Absent parts are null.
struct FieldProblems {
  /// The domain must outlive the object. Collective.
  FieldProblems(const setup::Case& what, const Domain& of_case);

  /// The fields before their first step: the wall with its prestress, and coupled. Where a signal
  /// ends the search for the prestress, RunOutput::stopped says so and nothing is coupled. Fails as
  /// take_prestress(). Collective.
  Outcome start(RunOutput& output);

  setup::Case the_case;
  const Domain* domain;
  std::unique_ptr<problems::FluidProblem> fluid;
  std::unique_ptr<problems::SolidProblem> wall;
  std::unique_ptr<problems::MeshMotion> motion;
  std::unique_ptr<coupling::Scheme> scheme;
};

}  // namespace tunica::run
