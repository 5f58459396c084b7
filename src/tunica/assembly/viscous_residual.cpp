#include "tunica/assembly/viscous_residual.hpp"

#include "tunica/assembly/gather.hpp"
#include "tunica/kernels/deformation.hpp"

namespace tunica::assembly {

namespace {

/// ε of an element, in the order of Sym3.
Sym3 strain_rate(const kernels::Tet4& T, const std::array<Vec3, 4>& u) {
  const Mat3 G = kernels::gradient(T, u);
  return {G[0][0],
          G[1][1],
          G[2][2],
          0.5 * (G[0][1] + G[1][0]),
          0.5 * (G[1][2] + G[2][1]),
          0.5 * (G[2][0] + G[0][2])};
}

/// ε_a = Σ_e V_e ε_e / Σ_e V_e over the elements around each vertex, on owned and ghost nodes.
std::vector<Sym3> nodal_strain_rates(const fields::FieldMesh& mesh, const ElementGeometry& geometry,
                                     const std::vector<Vec3>& u) {
  std::vector<Sym3> sums(mesh.n_nodes(), Sym3{});
  std::vector<double> volumes(mesh.n_nodes(), 0.0);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const kernels::Tet4 T = geometry[e];
    const double V = T.volume;
    const Sym3 rate = strain_rate(T, gather(u, mesh.tets[e]));
    for (const int a : mesh.tets[e]) {
      volumes[a] += V;
      for (int k = 0; k < 6; ++k) sums[a][k] += V * rate[k];
    }
  }
  MultiVector owned(mesh.node_map, 6), all(mesh.ghosted_map, 6);
  {
    const auto view = owned.getLocalViewHost(overwrite_all);
    for (int a = 0; a < mesh.n_owned; ++a)
      for (int k = 0; k < 6; ++k) view(a, k) = sums[a][k] / volumes[a];
  }
  all.doImport(owned, *mesh.import, insert);
  const auto view = all.getLocalViewHost(read_only);
  for (int a = 0; a < mesh.n_nodes(); ++a)
    for (int k = 0; k < 6; ++k) sums[a][k] = view(a, k);
  return sums;
}

}  // namespace

std::vector<Vec3> viscous_forces(const fields::FieldMesh& mesh, const ElementGeometry& geometry,
                                 double viscosity, const std::vector<Vec3>& u) {
  const std::vector<Sym3> rates = nodal_strain_rates(mesh, geometry, u);
  std::vector<Vec3> forces(mesh.tets.size(), Vec3{});
  for (std::size_t e = 0; e < forces.size(); ++e) {
    const kernels::Tet4 T = geometry[e];
    for (int a = 0; a < 4; ++a)  // div 2με = 2μ Σ_a ε_a ∇N_a
      forces[e] += 2.0 * viscosity * kernels::apply(rates[mesh.tets[e][a]], T.grad_N[a]);
  }
  return forces;
}

}  // namespace tunica::assembly
