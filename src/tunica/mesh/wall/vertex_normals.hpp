#pragma once
#include <vector>

#include "tunica/mesh/wall/lumen_surface.hpp"

namespace tunica::mesh::wall {

/// Where the wall grows to from each vertex, and how far for a unit of thickness.
struct Growth {
  std::vector<Vec3> along;      ///< unit vectors; at openings in the plane of the cap
  std::vector<double> stretch;  ///< of the thickness along it, 1 where it leaves at a right angle
};

/// Mean of the triangles' normals, weighted by their angles at the vertex, then smoothed over about
/// three times the thickness of the wall (twice the radius of the lumen at most): in the fork of a
/// vessel they fan out instead of crossing.
///
/// Smoothing takes cotangent weights, so that it does not turn the normals of a regular surface.
/// Where a triangle would hardly see the direction, it is turned to where all see it best.
/// stretch makes up for directions that lean, in valleys and in the planes of caps: the end is as
/// far from the surface as the wall is thick, unless that took more than twice the length. Throws
/// Error where no direction leaves the surface, or where a cap is nearly tangential to it.
Growth growth_directions(const LumenSurface& surface, const std::vector<double>& thickness);

/// Lengthens what leans or stands in a valley, until its end is as far from the surface as the wall
/// is thick. What comes near another part of the surface is left to limit.hpp.
void reach_thickness(const LumenSurface& surface, const std::vector<double>& thickness,
                     Growth& growth);

/// The least cosine between the direction and the normals of the triangles of the vertex.
double visibility(const LumenSurface& surface, int vertex, const Vec3& along);

/// The nearest direction in the planes of the caps that the vertex touches, not of unit length.
Vec3 in_caps(const LumenSurface& surface, int vertex, const Vec3& along);

}  // namespace tunica::mesh::wall
