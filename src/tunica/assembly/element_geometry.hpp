#pragma once
#include "tunica/assembly/gather.hpp"
#include "tunica/fields/field_mesh.hpp"
#include "tunica/kernels/tet4.hpp"

namespace tunica::assembly {

/// Geometry of every local tetrahedron where owned and ghost nodes lie at x [mm]. It is computed
/// whenever it is asked for: 104 bytes an element are not stored, for which residuals take up to a
/// fifth longer and Jacobians up to a twentieth.
///
/// With a prestretch each element has vertices of its own, where it is free of stress:
///
///   X_a = x_0 + G⁻¹ (x_a − x_0)      G  deformation gradient from there to x, a tensor per element
///
/// Neighbours need not fit together there. Volume and gradients are those of X, V/det G and Gᵀ∇N.
class ElementGeometry {
public:
  ElementGeometry() = default;
  /// mesh and x must outlive the object, which sees x as it is at present.
  ElementGeometry(const fields::FieldMesh& mesh, const std::vector<Vec3>& x)
      : mesh_(&mesh), x_(&x) {}
  /// prestretch: G per local element; empty where x is free of stress. It must outlive the object.
  ElementGeometry(const fields::FieldMesh& mesh, const std::vector<Vec3>& x,
                  const std::vector<Mat3>& prestretch)
      : mesh_(&mesh), x_(&x), prestretch_(&prestretch) {}

  std::size_t size() const { return mesh_->tets.size(); }
  bool is_prestretched() const { return prestretch_ != nullptr && !prestretch_->empty(); }
  std::array<Vec3, 4> vertices(std::size_t e) const {
    const std::array<Vec3, 4> x = gather(*x_, mesh_->tets[e]);
    return is_prestretched() ? stress_free(x, (*prestretch_)[e]) : x;
  }
  /// x_a − X_a; zero without prestretch.
  std::array<Vec3, 4> from_stress_free(std::size_t e) const {
    if (!is_prestretched()) return {};
    std::array<Vec3, 4> moved = gather(*x_, mesh_->tets[e]);
    const std::array<Vec3, 4> X = stress_free(moved, (*prestretch_)[e]);
    for (int a = 0; a < 4; ++a) moved[a] += -1.0 * X[a];
    return moved;
  }
  kernels::Tet4 operator[](std::size_t e) const { return kernels::make_tet4(vertices(e)); }

private:
  static std::array<Vec3, 4> stress_free(const std::array<Vec3, 4>& x, const Mat3& G) {
    const Mat3 adj = adjugate(G);
    const double inv_J = 1.0 / det(G);
    std::array<Vec3, 4> X;
    for (int a = 0; a < 4; ++a) X[a] = x[0] + inv_J * (adj * (x[a] - x[0]));
    return X;
  }

  const fields::FieldMesh* mesh_ = nullptr;
  const std::vector<Vec3>* x_ = nullptr;
  const std::vector<Mat3>* prestretch_ = nullptr;
};

}  // namespace tunica::assembly
