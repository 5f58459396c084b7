#pragma once
#include <vector>

#include "tunica/mesh/wall/lumen_surface.hpp"
#include "tunica/mesh/wall/thickness.hpp"

namespace tunica::mesh::wall {

/// Flatness of an element: the width of the triangle under it over its height. Above this one
/// solvers take more iterations, and stress is spread over the angles of a few degrees.
constexpr double flattest = 10.0;

/// Width of a triangle, the root of twice its area: the sides of a right-angled one are as long
/// [mm].
double width(const LumenSurface& surface, int triangle);

/// Gives layers with elements = 0 a number of elements: as many as make them four times as wide as
/// high, and in a wall where all are chosen at least three through it, for it to bend, but none
/// flatter than 1 : 10. thickness: of the wall at the vertices.
void choose_elements(const LumenSurface& surface, const std::vector<double>& thickness,
                     std::vector<Layer>& layers);

}  // namespace tunica::mesh::wall
