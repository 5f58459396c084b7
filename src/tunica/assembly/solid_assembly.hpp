#pragma once
#include "tunica/assembly/block_assembler.hpp"
#include "tunica/assembly/element_geometry.hpp"
#include "tunica/kernels/solid_up.hpp"

namespace tunica::assembly {

/// What stays constant of the wall's elements during a run.
struct SolidElements {
  ElementGeometry geometry;  ///< undeformed
  std::vector<const materials::HyperelasticLaw*> law;
  std::vector<double> density;  ///< ρ [mg/mm³]
  std::vector<kernels::SolidCoefficients> coefficients;
  std::vector<materials::Frame> frames;      ///< empty where no law has fibres
  const fields::SplitMesh* split = nullptr;  ///< carries the pressures where it is not null

  const materials::Frame& frame(std::size_t e) const {
    static constexpr materials::Frame none;
    return frames.empty() ? none : frames[e];
  }
};

/// Nodal state of the wall on owned and ghost nodes; the pressures where they stand.
struct SolidFields {
  std::vector<Vec3> d;
  std::vector<double> p;
  std::vector<Vec3> r;  ///< inertia history of kernels::SolidState for unit density [mm/ms²]
  std::vector<Vec3> subscale_r = {};  ///< that of the subscales, per element; empty without inertia
};

/// The local element of smallest det F and its value.
struct WorstElement {
  double determinant;
  int element;
};
WorstElement worst_solid_element(const fields::FieldMesh& mesh, const SolidElements& elements,
                                 const std::vector<Vec3>& d);

/// The subscales d' of the new time, per element [mm].
std::vector<Vec3> solid_subscales(const fields::FieldMesh& mesh, const SolidElements& elements,
                                  const SolidFields& state);

/// Adds the element residuals, and the Jacobians where K is not null.
void assemble_solid(const fields::FieldMesh& mesh, const SolidElements& elements,
                    const SolidFields& state, NodalResidual& R, BlockAssembler* K);

}  // namespace tunica::assembly
