#pragma once
#include <algorithm>
#include <cmath>
#include <random>

#include "tunica/mesh/block.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/tube.hpp"
#include "tunica/mesh/wall/grow.hpp"

/// Lumens for walls to grow on; their walls' surface is called interface.
namespace tunica::mesh {

inline Tube lumen_tube() {
  Tube tube;
  tube.with_wall = false;
  tube.around = 16;
  tube.axial = 10;
  tube.length = 6.0;
  return tube;
}

inline Tube patient_tube() {
  Tube tube = lumen_tube();
  tube.around = 24;
  tube.axial = 30;
  tube.length = 10.0;
  return tube;
}

inline wall::Options on_interface() {
  wall::Options options;
  options.surfaces = {"interface"};
  return options;
}

template <typename Map>
Mesh moved(Mesh mesh, const Map& map) {
  for (Vec3& x : mesh.vertices) x = map(x);
  return mesh;
}

/// The z axis becomes a circle of this radius about the y axis.
inline Mesh bent(const Mesh& tube, double radius) {
  return moved(tube, [&](const Vec3& x) {
    const double angle = x[2] / radius, r = radius + x[0];
    return Vec3{r * std::cos(angle), x[1], r * std::sin(angle)};
  });
}

/// Radii changed by up to this part: long waves as of a patient's vessel, and noise from vertex to
/// vertex of a tenth of that, as of a segmentation.
inline Mesh rough(const Mesh& tube, unsigned seed, double part) {
  std::mt19937 random(seed);
  const auto number = [&](double low, double high) {
    return low + (high - low) * (random() / 4294967295.0);
  };
  struct Wave {
    double around, along, phase;
  };
  std::vector<Wave> waves;
  for (int i = 0; i < 8; ++i)
    waves.push_back({std::floor(number(0.0, 4.0)), number(-3.0, 3.0), number(0.0, 6.3)});
  return moved(tube, [&](const Vec3& x) {
    double sum = 0.1 * number(-1.0, 1.0);
    for (const Wave& w : waves)
      sum += 0.5 * std::cos(w.around * std::atan2(x[1], x[0]) + w.along * x[2] + w.phase);
    const double s = 1.0 + part * std::clamp(sum, -1.0, 1.0);
    return Vec3{s * x[0], s * x[1], x[2]};
  });
}

/// The mesh and a copy of it elsewhere.
inline Mesh two_of(const Mesh& one, const Vec3& shift) {
  Mesh both = one;
  const int first = static_cast<int>(one.vertices.size());
  for (const Vec3& x : one.vertices) both.vertices.push_back(x + shift);
  for (auto tet : one.tets) {
    for (int& v : tet) v += first;
    both.tets.push_back(tet);
  }
  for (auto triangle : one.triangles) {
    for (int& v : triangle) v += first;
    both.triangles.push_back(triangle);
  }
  both.tet_region.insert(both.tet_region.end(), one.tet_region.begin(), one.tet_region.end());
  both.triangle_surface.insert(both.triangle_surface.end(), one.triangle_surface.begin(),
                               one.triangle_surface.end());
  return both;
}

/// A block of 4 × 2 × 3 mm with a slot of 0.5 mm at x = 2, 1.5 mm deep: sharp edges of both signs.
/// Its floor is the inlet, the rest interface.
inline Mesh notched_block() {
  Block block;
  block.size = {4.0, 2.0, 3.0};
  block.cells = {16, 4, 6};
  const Mesh whole = make_block(block);
  Mesh mesh;
  mesh.regions = {{1, "fluid"}};
  mesh.surfaces = {{1, "inlet"}, {2, "interface"}};
  std::vector<int> number(whole.vertices.size(), -1);
  for (auto tet : whole.tets) {
    Vec3 middle{};
    for (const int v : tet) middle += 0.25 * whole.vertices[v];
    if (std::abs(middle[0] - 2.0) < 0.25 && middle[2] > 1.5) continue;
    for (int& v : tet) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(whole.vertices[v]);
      }
      v = number[v];
    }
    mesh.tets.push_back(tet);
    mesh.tet_region.push_back(0);
  }
  for (const Face& face : faces(mesh)) {
    if (!face.is_boundary()) continue;
    const bool is_floor = std::all_of(face.vertices.begin(), face.vertices.end(),
                                      [&](int v) { return mesh.vertices[v][2] < 1e-9; });
    mesh.triangles.push_back(face.vertices);
    mesh.triangle_surface.push_back(is_floor ? 0 : 1);
  }
  return mesh;
}

}  // namespace tunica::mesh
