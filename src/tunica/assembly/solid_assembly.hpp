#pragma once
#include <cstdint>
#include <vector>

#include "tunica/assembly/block_assembler.hpp"
#include "tunica/assembly/element_geometry.hpp"
#include "tunica/kernels/solid_up.hpp"

namespace tunica::assembly {

/// Common data of the elements of a layer.
struct SolidLayer {
  const materials::WallLaw* law = nullptr;
  double density = 0.0;                       ///< ρ [mg/mm³]
  kernels::SolidCoefficients coefficients{};  ///< but for τ
};

/// Data of the wall's elements that are constant during a run.
struct SolidElements {
  ElementGeometry geometry;  ///< where the wall is free of stress
  std::vector<SolidLayer> layers;
  std::vector<std::int16_t> layer_number;    ///< per element
  std::vector<double> tau;                   ///< τ per element [mm²/kPa]
  std::vector<materials::Frame> frames;      ///< empty where no law has fibres
  const fields::SplitMesh* split = nullptr;  ///< carries the pressures where it is not null
  int past_width = 0;                        ///< numbers that an element's law may remember
  std::vector<double> past = {};             ///< those before the present step, rows of elements
  double step = 0.0;  ///< Δt for laws that remember, zero in equilibrium [ms]

  const SolidLayer& layer(std::size_t e) const { return layers[layer_number[e]]; }
  kernels::SolidCoefficients coefficients(std::size_t e) const {
    kernels::SolidCoefficients c = layer(e).coefficients;
    c.tau = tau[e];
    return c;
  }
  const materials::Frame& frame(std::size_t e) const {
    static constexpr materials::Frame none;
    return frames.empty() ? none : frames[e];
  }
  materials::Past past_of(std::size_t e) const {
    if (past_width == 0) return {};
    return {past.data() + past_width * e, step};
  }
  /// The displacement that kernels use for the displacement d from the mesh, measured from the
  /// stress-free element: D_a = d_a + x_a − X_a, so that F = I + Σ D_a ⊗ Gᵀ∇N_a = (I + ∇d) G.
  std::array<Vec3, 4> displacement(std::size_t e, const std::array<Vec3, 4>& d) const {
    std::array<Vec3, 4> D = geometry.from_stress_free(e);
    for (int a = 0; a < 4; ++a) D[a] += d[a];
    return D;
  }
};

/// Nodal state of the wall on owned and ghost nodes; the pressures where they stand.
struct SolidFields {
  std::vector<Vec3> d;  ///< from the mesh
  std::vector<double> p;
  std::vector<Vec3> r;  ///< inertia history of kernels::SolidState for unit density [mm/ms²]
  std::vector<Vec3> subscale_r = {};  ///< that of the subscales, per element; empty without inertia
  std::vector<Vec3> stress_force =
      {};  ///< of stress_residual.hpp; empty where subscales do without
};

/// The local element of smallest det F and its value. d: from the mesh.
struct WorstElement {
  double determinant;
  int element;
};
WorstElement worst_solid_element(const fields::FieldMesh& mesh, const SolidElements& elements,
                                 const std::vector<Vec3>& d);

/// The subscales d' of the new time, per element [mm].
std::vector<Vec3> solid_subscales(const fields::FieldMesh& mesh, const SolidElements& elements,
                                  const SolidFields& state);

/// History of the laws for a step that ends at d: rows of elements.
std::vector<double> remembered_by_laws(const fields::FieldMesh& mesh, const SolidElements& elements,
                                       const std::vector<Vec3>& d);

/// Adds the element residuals, and the Jacobians where K is not null.
void assemble_solid(const fields::FieldMesh& mesh, const SolidElements& elements,
                    const SolidFields& state, NodalResidual& R, BlockAssembler* K);

/// Adds to the Jacobian of assemble_solid() at d = 0 what makes it the derivative of the residual
/// by s in G ← (I + sym ∇s) G, where the wall stays on the mesh. See
/// kernels::prestretch_jacobian().
void assemble_prestretch(const fields::FieldMesh& mesh, const SolidElements& elements,
                         const std::vector<materials::Frame>& frames, const SolidFields& state,
                         BlockAssembler& K);

}  // namespace tunica::assembly
