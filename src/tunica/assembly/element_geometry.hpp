#pragma once
#include "tunica/assembly/gather.hpp"
#include "tunica/fields/field_mesh.hpp"
#include "tunica/kernels/tet4.hpp"

namespace tunica::assembly {

/// Geometry of every local tetrahedron where owned and ghost nodes lie at x [mm]. It is computed
/// whenever it is asked for: 104 bytes an element are not stored, for which residuals take up to a
/// fifth longer and Jacobians up to a twentieth.
class ElementGeometry {
public:
  ElementGeometry() = default;
  /// mesh and x must outlive the object, which sees x as it is at present.
  ElementGeometry(const fields::FieldMesh& mesh, const std::vector<Vec3>& x)
      : mesh_(&mesh), x_(&x) {}

  std::size_t size() const { return mesh_->tets.size(); }
  std::array<Vec3, 4> vertices(std::size_t e) const { return gather(*x_, mesh_->tets[e]); }
  kernels::Tet4 operator[](std::size_t e) const { return kernels::make_tet4(vertices(e)); }

private:
  const fields::FieldMesh* mesh_ = nullptr;
  const std::vector<Vec3>* x_ = nullptr;
};

}  // namespace tunica::assembly
