#pragma once
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/params/table.hpp"
#include "tunica/stepping/newmark.hpp"
#include "tunica/stepping/time_function.hpp"

namespace tunica::problems {

/// What one layer of the wall is made of.
struct Layer {
  std::string region;
  std::string law;
  std::vector<std::pair<std::string, double>> constants;
  double bulk_modulus;  ///< κ [kPa]
  double density;       ///< ρ in the reference configuration [mg/mm³]

  bool has_material_of(const Layer& other) const {
    return law == other.law && constants == other.constants;
  }
};

/// What happens on one surface of the wall.
struct WallCondition {
  std::string surface;
  std::string kind;             ///< "clamped", "held", "traction", "pressure", "interface"
  std::vector<int> components;  ///< held: the displacement components that are zero
  Vec3 traction{};              ///< dead, per undeformed area [kPa]
  double pressure = 0.0;        ///< follows the deformed surface, pushes against it [kPa]
  stepping::TimeFunction amplitude;
};

struct SolidOptions {
  std::vector<Layer> layers;
  std::vector<WallCondition> conditions;
  bool is_static;
  double beta, gamma;       ///< Newmark
  bool has_inertia_in_tau;  ///< τ = 1/(4μ_l/h² + α) instead of the paper's h²/(4μ_l)
  double modulus_factor;    ///< multiplies μ_l in τ
  double layer_factor;      ///< multiplies τ at the boundary of two materials
  std::vector<std::string> frame_surfaces;  ///< that the fibre frame is made from

  std::vector<std::string> regions() const;
  std::vector<std::string> interface_surfaces() const;
};

params::Table solid_table();
/// The keys of its "Linear Solver". Incomplete factors by default: on walls of some elements'
/// thickness they are faster than the block preconditioner, whose iterations, in turn, do not
/// grow. As the mesh gets finer A turns from mass to elasticity, for which the cycles need more
/// sweeps than those of the fluid.
params::Table solid_solver_table();
SolidOptions solid_options(const Teuchos::ParameterList& list);

}  // namespace tunica::problems
