#include "tunica/assembly/viscous_residual.hpp"

#include "tunica/assembly/gather.hpp"
#include "tunica/kernels/deformation.hpp"
#include "tunica/kernels/viscosity.hpp"

namespace tunica::assembly {

namespace {

/// (μ/μ_r) ε of an element, in the order of Sym3, μ_r the viscosity at high rates.
Sym3 relative_stress(const kernels::Tet4& T, const std::array<Vec3, 4>& u,
                     const materials::ViscosityLaw& viscosity) {
  const Mat3 G = kernels::gradient(T, u);
  const double relative = kernels::viscosity_at(viscosity, G).value / viscosity.reference();
  Sym3 rate{G[0][0],
            G[1][1],
            G[2][2],
            0.5 * (G[0][1] + G[1][0]),
            0.5 * (G[1][2] + G[2][1]),
            0.5 * (G[2][0] + G[0][2])};
  for (double& of : rate) of *= relative;
  return rate;
}

/// s_a = Σ_e V_e s_e / Σ_e V_e, s = (μ/μ_r) ε, over the elements around each vertex, on owned and
/// ghost nodes.
std::vector<Sym3> nodal_stresses(const fields::FieldMesh& mesh, const ElementGeometry& geometry,
                                 const materials::ViscosityLaw& viscosity,
                                 const std::vector<Vec3>& u) {
  std::vector<Sym3> sums(mesh.n_nodes(), Sym3{});
  std::vector<double> volumes(mesh.n_nodes(), 0.0);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const kernels::Tet4 T = geometry[e];
    const double V = T.volume;
    const Sym3 rate = relative_stress(T, gather(u, mesh.tets[e]), viscosity);
    for (const int a : mesh.tets[e]) {
      volumes[a] += V;
      for (int k = 0; k < 6; ++k) sums[a][k] += V * rate[k];
    }
  }
  // Sums are whole at owned nodes alone; ghosts get the owners' means.
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
                                 const materials::ViscosityLaw& viscosity,
                                 const std::vector<Vec3>& u) {
  const std::vector<Sym3> stresses = nodal_stresses(mesh, geometry, viscosity, u);
  // μ_r is taken out of the averages: with a constant viscosity they are those of ε alone.
  const double twice = 2.0 * viscosity.reference();
  std::vector<Vec3> forces(mesh.tets.size(), Vec3{});
  for (std::size_t e = 0; e < forces.size(); ++e) {
    const kernels::Tet4 T = geometry[e];
    for (int a = 0; a < 4; ++a)  // div 2με = 2μ_r Σ_a s_a ∇N_a
      forces[e] += twice * kernels::apply(stresses[mesh.tets[e][a]], T.grad_N[a]);
  }
  return forces;
}

}  // namespace tunica::assembly
