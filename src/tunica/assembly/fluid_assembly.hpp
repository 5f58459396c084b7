#pragma once
#include "tunica/assembly/block_assembler.hpp"
#include "tunica/assembly/element_geometry.hpp"
#include "tunica/kernels/fluid_up.hpp"

namespace tunica::assembly {

/// The fluid's elements on the current mesh; constant during a Newton solve.
struct FluidElements {
  ElementGeometry geometry;
  std::vector<double> tau;
  std::vector<double> viscosity;  ///< in τ: that which the steps before let expect [kPa ms]
  kernels::FluidCoefficients coefficients;
};

/// Nodal state of the fluid on owned and ghost nodes.
struct FluidFields {
  std::vector<Vec3> u;
  std::vector<double> p;
  std::vector<Vec3> u_old;
  std::vector<Vec3> w;
  std::vector<Vec3> f;
  std::vector<double> on_wall = {};  ///< ω, see kernels/fluid_up.cpp; empty: 0 everywhere
  std::vector<Vec3> subscale = {};   ///< ũ' per element; empty where subscales have no inertia
  std::vector<Vec3> viscous = {};    ///< q per element; empty where it is left out
};

/// State of one element.
kernels::FluidState state_of(const FluidFields& s, const fields::FieldMesh& mesh, std::size_t e);

/// Adds the element residuals, and the Jacobians where K is not null.
void assemble_fluid(const fields::FieldMesh& mesh, const FluidElements& elements,
                    const FluidFields& state, NodalResidual& R, BlockAssembler* K);

/// The viscosity of each element where the nodes flow with u [kPa ms].
std::vector<double> fluid_viscosities(const fields::FieldMesh& mesh, const FluidElements& elements,
                                      const std::vector<Vec3>& u);

/// The stabilisation parameters where the nodes flow with u and the mesh moves with w.
std::vector<double> fluid_taus(const fields::FieldMesh& mesh, const FluidElements& elements,
                               const std::vector<Vec3>& u, const std::vector<Vec3>& w);

/// The subscales u' of the new time, per element [mm/ms].
std::vector<Vec3> fluid_subscales(const fields::FieldMesh& mesh, const FluidElements& elements,
                                  const FluidFields& state);

/// Power that the stabilisation takes out in the elements that the rank counts [kPa mm³/ms].
double stabilisation_power(const fields::FieldMesh& mesh, const FluidElements& elements,
                           const FluidFields& state);

}  // namespace tunica::assembly
