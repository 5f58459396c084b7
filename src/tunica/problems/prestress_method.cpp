#include "tunica/problems/prestress_method.hpp"

#include <cmath>

#include "tunica/assembly/element_geometry.hpp"
#include "tunica/assembly/gather.hpp"

namespace tunica::problems {

namespace {

/// f(∇s) of each element, s on owned nodes.
template <class Function>
std::vector<Mat3> of_gradients(const std::vector<Vec3>& s, const fields::FieldMesh& mesh,
                               const Function& f) {
  // ∇s of an element between ranks takes s at ghosts, too.
  const std::vector<Vec3> all = fields::ghosted_vectors(mesh, s);
  const assembly::ElementGeometry geometry(mesh, mesh.x);
  std::vector<Mat3> values(mesh.tets.size());
  for (std::size_t e = 0; e < values.size(); ++e)
    values[e] = f(kernels::gradient(geometry[e], assembly::gather(all, mesh.tets[e])));
  return values;
}

/// By halves and Taylor's series.
Mat3 exponential(const Mat3& A) {
  // exp(A) = exp(A/2ⁿ)^(2ⁿ) with |A|/2ⁿ ≤ ¼, where ten terms of the series leave some 10⁻¹⁴
  double size = 0.0;
  for (const Vec3& row : A) size += dot(row, row);
  int halves = 0;
  for (size = std::sqrt(size); size > 0.25; size *= 0.5) ++halves;
  const double scale = std::ldexp(1.0, -halves);
  Mat3 sum = identity(), term = identity();
  for (int k = 1; k <= 10; ++k) {
    term = A * term;
    for (Vec3& row : term) row = scale / k * row;
    for (int i = 0; i < 3; ++i) sum[i] += term[i];
  }
  for (; halves > 0; --halves) sum = sum * sum;
  return sum;
}

// G ← exp(sym ∇s) G: short steps are (I + ε) G, and long ones invert no element.
class ByGradient final : public PrestressMethod {
public:
  explicit ByGradient(const fields::FieldMesh& mesh) : mesh_(&mesh) {}

  std::vector<Mat3> prestretch_after(const std::vector<Vec3>& s,
                                     const std::vector<Mat3>& present) override {
    std::vector<Mat3> G = of_gradients(
        s, *mesh_, [](const Mat3& gradient) { return exponential(symmetric_part(gradient)); });
    for (std::size_t e = 0; e < present.size(); ++e) G[e] = G[e] * present[e];
    return G;
  }

private:
  const fields::FieldMesh* mesh_;
};

// X ← X − s,  G⁻¹ = ∂X/∂x = I − ∇e,  e = x − X
class ByShape final : public PrestressMethod {
public:
  explicit ByShape(const fields::FieldMesh& mesh) : mesh_(&mesh), kept_(mesh.n_owned) {}

  std::vector<Mat3> prestretch_after(const std::vector<Vec3>& s,
                                     const std::vector<Mat3>& /*present*/) override {
    next_ = kept_;
    for (std::size_t a = 0; a < next_.size(); ++a) next_[a] += s[a];
    return of_gradients(next_, *mesh_, [](const Mat3& gradient) {
      Mat3 inverse = identity();
      for (int i = 0; i < 3; ++i) inverse[i] += -1.0 * gradient[i];
      Mat3 G = adjugate(inverse);
      const double J = det(inverse);  // where it is not positive, det G is not
      for (Vec3& row : G) row = 1.0 / J * row;
      return G;
    });
  }
  void keep() override { kept_ = next_; }
  void begin_load() override { before_ = kept_; }
  void undo_load() override { kept_ = before_; }
  std::vector<Vec3> shape() const override { return kept_; }
  void start_from(const std::vector<Vec3>& shape) override { kept_ = shape; }

private:
  const fields::FieldMesh* mesh_;
  std::vector<Vec3> kept_, next_, before_;  ///< e on owned nodes [mm]
};

}  // namespace

std::unique_ptr<PrestressMethod> make_prestress_method(bool is_by_shape,
                                                       const fields::FieldMesh& mesh) {
  if (is_by_shape) return std::make_unique<ByShape>(mesh);
  return std::make_unique<ByGradient>(mesh);
}

}  // namespace tunica::problems
