#include "tunica/assembly/gather.hpp"
#include "tunica/assembly/scalar_matrix.hpp"
#include "tunica/discretisation/fluid.hpp"
#include "tunica/kernels/laplace_p1.hpp"

namespace tunica::discretisation {

namespace {

constexpr const char* laplacian = "Schur Laplacian";
constexpr const char* mass = "Schur Mass";
constexpr const char* convection = "Schur Convection";

/// ∫ N_a c·∇N_b, c linear with the nodal values given.
assembly::ScalarElement convection_element(const kernels::Tet4& T, const std::array<Vec3, 4>& c) {
  // ∫ N_a c dV = V/20 (Σ_b c_b + c_a), and ∇N_b is constant
  const Vec3 sum = c[0] + c[1] + c[2] + c[3];
  assembly::ScalarElement C;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) C[a][b] = T.volume / 20.0 * dot(sum + c[a], T.grad_N[b]);
  return C;
}

}  // namespace

std::vector<std::string> Fluid::operator_names() const { return {laplacian, mass, convection}; }

// The parts of [LY1] eq:rpreschur with their coefficients, so that
//   S̃⁻¹ = L⁻¹ + M⁻¹ + M⁻¹ N L⁻¹,  L = Δt/ρ Dp,  M = 1/μ Mp,  N = Δt/μ Cp.
// L has zero Dirichlet values where the fluid leaves freely: there the pressure is known, and
// the velocity that it drives is not constrained.
Teuchos::RCP<const CrsMatrix> Fluid::assemble_operator(const std::string& name) const {
  const double dt = 1.0 / elements_.coefficients.inv_dt;
  const auto& geometry = elements_.geometry;
  std::vector<char> is_fixed(mesh_->n_nodes(), 0);
  if (name == mass)
    return assembly::scalar_matrix(
        *mesh_, scalar_graph(),
        [&](std::size_t e) {
          return assembly::mass_element(geometry[e].volume, 1.0 / elements_.viscosity[e]);
        },
        is_fixed);
  if (name == convection)
    return assembly::scalar_matrix(
        *mesh_, scalar_graph(),
        [&](std::size_t e) {
          std::array<Vec3, 4> c;
          for (int a = 0; a < 4; ++a) {
            const int node = mesh_->tets[e][a];
            c[a] = dt / elements_.viscosity[e] * (local_.u[node] - local_.w[node]);
          }
          return convection_element(geometry[e], c);
        },
        is_fixed);
  if (name != laplacian) return Teuchos::null;
  for (std::size_t s = 0; s < mesh_->surfaces.size(); ++s) {
    if (!is_open_[s]) continue;
    for (int a = 0; a < mesh_->n_nodes(); ++a)
      if (mesh_->is_on(a, static_cast<int>(s))) is_fixed[a] = 1;
  }
  return assembly::scalar_matrix(
      *mesh_, scalar_graph(),
      [&](std::size_t e) {
        auto K = kernels::laplace_p1(geometry[e]);
        for (auto& row : K)
          for (double& value : row) value *= dt / options_.density;
        return K;
      },
      is_fixed);
}

}  // namespace tunica::discretisation
