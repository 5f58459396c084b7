#pragma once
#include <array>
#include <string>
#include <vector>

#include "tunica/mesh/excerpt.hpp"

namespace tunica::mesh {

/// Checks everything mesh.hpp promises: lengths and ranges of the arrays, unique tags, no
/// repeated vertices, no inverted or degenerate tetrahedra, no vertex without tetrahedron,
/// every boundary face covered by exactly one triangle. Triangles between tetrahedra are
/// permitted, at most one per face. Throws Error that begins with name and gives the place.
void validate(const Mesh& mesh, const std::string& name);

/// Checks that fluid and wall fit together: every triangle of the interface surfaces has one
/// fluid and one wall tetrahedron, every face between fluid and wall is such a triangle, and
/// fluid and wall share no other vertices. All arguments are names. Throws Error; an interface
/// of two meshes that do not share their vertices is named as such.
void check_interface(const Mesh& mesh, const std::vector<std::string>& fluid,
                     const std::vector<std::string>& wall,
                     const std::vector<std::string>& interface);

/// The check for the part of one rank, in steps; faults that several ranks may have are counted
/// over all of them by the caller. regions_beside: those on the two sides of each triangle, -1 for
/// none.
class InterfaceCheck {
public:
  /// Throws Error if a name is none of the mesh's or a region is both.
  InterfaceCheck(const Excerpt& part, const std::vector<std::array<int, 2>>& regions_beside,
                 const std::vector<std::string>& fluid, const std::vector<std::string>& wall,
                 const std::vector<std::string>& interface);

  /// Throws Error on a triangle between other regions.
  void check_neighbours() const;
  /// Where no triangle is alone on any rank: throws Error on a face or a vertex where fluid and
  /// wall meet outside the interface.
  void check_elsewhere() const;
  /// Triangles of the interface that have a tetrahedron on one side only, out of how many.
  long long alone() const { return alone_; }
  long long triangles() const { return static_cast<long long>(triangles_.size()); }
  /// On the first of them, where that many are alone.
  std::string nonconforming(long long count, long long of) const;

private:
  enum class Field { other, fluid, wall };
  Field field(int region) const { return region < 0 ? Field::other : fields_[region]; }
  std::string region(int r) const { return part_.mesh.regions[r].name; }
  std::string place(int triangle) const;
  void check_complete() const;
  void check_vertices() const;

  const Excerpt& part_;
  const std::vector<std::array<int, 2>>& beside_;
  std::vector<std::string> names_;
  std::vector<Field> fields_;       ///< per region
  std::vector<char> is_interface_;  ///< per surface
  std::vector<int> triangles_;      ///< of the interface's surfaces
  long long alone_ = 0;
  int first_alone_ = -1;
};

/// Index into mesh.regions. Throws Error that names the nearest valid name, or all.
int region_index(const Mesh& mesh, const std::string& name);

/// Index into mesh.surfaces. Throws Error that names the nearest valid name, or all.
int surface_index(const Mesh& mesh, const std::string& name);

}  // namespace tunica::mesh
