#pragma once
#include <cstdio>
#include <string>

#include "tunica/mesh/info.hpp"

/// One line on what was written, with the worst element.
inline void report(const tunica::mesh::Mesh& result, const std::string& path) {
  const tunica::mesh::Info info = tunica::mesh::inspect(result);
  std::printf("%s: %d vertices, %d tetrahedra, %d triangles, worst quality %.4f\n", path.c_str(),
              info.vertices, info.tets, info.triangles, info.worst_quality);
}
