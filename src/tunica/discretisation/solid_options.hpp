#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tunica/boundary/registry.hpp"
#include "tunica/materials/registry.hpp"
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::discretisation {

/// Material of one layer of the wall.
struct Layer {
  std::string region;
  std::string law;
  materials::Constants constants;
  double bulk_modulus;            ///< κ [kPa]
  double density;                 ///< ρ in the reference configuration [mg/mm³]
  double viscous_fraction = 0.0;  ///< β of materials::Viscoelastic; 0: elastic
  double relaxation_time = 0.0;   ///< τ of it [ms]

  bool has_material_of(const Layer& other) const {
    return law == other.law && constants == other.constants &&
           viscous_fraction == other.viscous_fraction && relaxation_time == other.relaxation_time;
  }
};

/// Options of the discretisation in a resolved "Wall" list.
struct SolidOptions {
  std::vector<Layer> layers;
  bool has_dynamic_subscales;  ///< those of PSPG have inertia of their own
  bool has_inertia_in_tau;     ///< τ = 1/(4μ_l/h² + α) instead of the paper's h²/(4μ_l)
  bool is_static;              ///< a sequence of equilibria
  bool has_stress_residual;    ///< subscales see div σ'
  double modulus_factor;       ///< multiplies μ_l in τ
  bool has_doubled_pressure;   ///< one for each material at a vertex
  double layer_factor;         ///< else: multiplies τ at the boundary of two materials
  double volumetric_factor;    ///< τ_v of the volumetric subscale in parts of μ_l
  bool has_prestress;          ///< in its mesh
  Vec3 body_force;             ///< per mass [mm/ms²]
  std::vector<boundary::Condition> conditions;
  std::function<std::unique_ptr<stepping::TimeScheme>()> make_scheme;

  std::vector<std::string> regions() const;
};

/// The options of the same wall in equilibrium.
SolidOptions in_statics(SolidOptions options);

std::unique_ptr<materials::WallLaw> law_of(const Layer& layer);
/// True where a layer of the wall has fibres, which need frames.
bool has_fibres(const SolidOptions& options);

/// Adds the keys of a "Wall" list that its discretisation has: those of its layers, and behind
/// those of the fibre frame the others.
void add_layer_keys(params::Table& table);
void add_solid_keys(params::Table& table);
SolidOptions solid_options(const Teuchos::ParameterList& list);

}  // namespace tunica::discretisation
