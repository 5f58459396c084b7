#pragma once
#include <Teuchos_ParameterList.hpp>
#include <optional>

namespace tunica::problems {

/// A resolved "Mesh Motion" list.
struct MeshMotionSettings {
  MeshMotionSettings(const Teuchos::ParameterList& list);  // NOLINT: a list is what is not decoded

  std::optional<double> poisson_ratio;  ///< of the elastic law; none: the harmonic one
  double stiffening;                    ///< power of mean volume over volume
  Teuchos::ParameterList linear_solver;
};

}  // namespace tunica::problems
