#pragma once
#include "tunica/assembly/element_geometry.hpp"
#include "tunica/materials/viscosity_law.hpp"

namespace tunica::assembly {

/// div 2μ ε(u) of a velocity that is linear on each element, whose stresses have no divergence
/// there: that of 2μ ε averaged over the elements around each vertex by their volumes and taken for
/// linear in between. Per local element [kPa/mm].
///
/// geometry: per local element; u: velocity of local nodes. Second order inside; next to the
/// boundary, where averages lie on one side, it does not converge. Source: [JCWS99]. Collective.
std::vector<Vec3> viscous_forces(const fields::FieldMesh& mesh, const ElementGeometry& geometry,
                                 const materials::ViscosityLaw& viscosity,
                                 const std::vector<Vec3>& u);

}  // namespace tunica::assembly
