#pragma once
#include <string>

#include "tunica/base/types.hpp"
#include "tunica/mesh/checks.hpp"

namespace tunica::mesh {

/// A mesh of which each rank holds an equal portion of rows, in the order of the file: vertices,
/// tetrahedra and triangles, each for itself. Vertices are at most 2³¹ − 1, which is
/// some 12·10⁹ tetrahedra: their numbers, most of what a mesh takes, are short.
struct Slab {
  CommPtr comm;
  Mesh rows;  ///< elements have numbers of the whole; all tags
  long long vertices = 0, tets = 0, triangles = 0;  ///< of the whole

  Place place() const;
};

/// Reads a mesh as mesh::read() does. Each rank reads its rows of tunica's own files; rank 0 reads
/// other files in pieces and distributes them. Checks all that rows show by themselves: numbers in
/// range, finite, tags. Throws Error on all ranks alike. Collective.
Slab read_slab(const std::string& path, const CommPtr& comm);

/// Hands out a mesh that rank 0 has. Collective.
Slab slab_of(const Mesh& whole_on_root, const CommPtr& comm);

/// The whole mesh on rank 0, the tags alone on others. Collective.
Mesh gathered(const Slab& slab);

/// Writes tunica's own file, all ranks together, without compression. A failed write leaves what
/// was there. Throws MachineFault on all ranks. Collective.
void write_slab(const Slab& slab, const std::string& path);

/// The lengths of the box around it. Collective.
Vec3 extent(const Slab& slab);

/// Digits that change with positions, elements, tags' places and names, and vectors, and not with
/// the number of ranks. Collective.
std::string fingerprint(const Slab& slab);

/// Flags for the fields that each vertex of the rank's rows belongs to.
constexpr char in_fluid = 1, in_wall = 2;
/// Throws Error that begins with name on all ranks alike where a vertex belongs to no tetrahedron.
/// Collective.
std::vector<char> vertex_fields(const Slab& slab, const std::vector<bool>& region_is_fluid,
                                const std::string& name);

}  // namespace tunica::mesh
