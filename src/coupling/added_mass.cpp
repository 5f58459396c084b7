#include "coupling/added_mass.hpp"

#include <algorithm>

#include "assembly/gather.hpp"
#include "assembly/scalar_matrix.hpp"
#include "base/error.hpp"
#include "kernels/laplace_p1.hpp"
#include "problems/surface_geometry.hpp"

namespace tunica::coupling {

namespace {

std::vector<char> nodes_on(const fields::FieldMesh& mesh, const std::vector<int>& surfaces) {
  std::vector<char> is_on(mesh.n_nodes(), 0);
  for (int a = 0; a < mesh.n_nodes(); ++a)
    for (const int s : surfaces)
      if (mesh.is_on(a, s)) is_on[a] = 1;
  return is_on;
}

Teuchos::RCP<CrsMatrix> laplacian(const fields::FieldMesh& mesh,
                                  const std::vector<char>& is_fixed) {
  const auto element = [&mesh](std::size_t e) {
    return kernels::laplace_p1(kernels::make_tet4(assembly::gather(mesh.x, mesh.tets[e])));
  };
  return assembly::scalar_matrix(mesh, fields::make_node_graph(mesh), element, is_fixed);
}

}  // namespace

AddedMass::AddedMass(const Teuchos::ParameterList& list, const fields::FieldMesh& fluid,
                     const fields::Interface& interface, const std::vector<int>& open_surfaces,
                     const std::vector<double>& compliance, double fluid_inertia)
    : interface_(&interface), compliance_(compliance), right_side_(fluid.node_map, 1),
      p_(fluid.node_map, 1) {
  const std::vector<char> is_open = nodes_on(fluid, open_surfaces);
  const std::vector<Vec3> area = problems::nodal_areas(fluid, interface.surfaces);
  const Teuchos::RCP<CrsMatrix> K = laplacian(fluid, is_open);
  K->resumeFill();
  for (int k = 0; k < interface.n_owned(); ++k) {
    const int a = interface.fluid_nodes[k];
    const double size = norm(area[a]);
    normal_.push_back(1.0 / size * area[a]);
    weight_.push_back(is_open[a] ? 0.0 : fluid_inertia * size);
    K->sumIntoLocalValues(a, Teuchos::tuple(a), Teuchos::tuple(weight_[k] * compliance[k]));
  }
  K->fillComplete(fluid.node_map, fluid.node_map);
  solver_ = linear::make_scalar_solver(list, K);
}

InterfaceVector AddedMass::apply(const InterfaceVector& residual) {
  const auto normal_part = [&](int k) {
    return dot(normal_[k], {residual[3 * k], residual[3 * k + 1], residual[3 * k + 2]});
  };
  right_side_.putScalar(0.0);
  {
    const auto b = right_side_.getLocalViewHost(read_write);
    for (int k = 0; k < interface_->n_owned(); ++k)
      b(interface_->fluid_nodes[k], 0) = weight_[k] * normal_part(k);
  }
  p_.putScalar(0.0);
  solver_->solve(right_side_, p_);
  InterfaceVector result(residual);
  const auto p = p_.getLocalViewHost(read_only);
  for (int k = 0; k < interface_->n_owned(); ++k) {
    const double taken_back = compliance_[k] * p(interface_->fluid_nodes[k], 0);
    for (int i = 0; i < 3; ++i) result[3 * k + i] -= taken_back * normal_[k][i];
  }
  return result;
}

std::vector<double> wall_compliance(const stepping::Clock& clock, const fields::FieldMesh& fluid,
                                    const fields::Interface& interface,
                                    problems::SolidProblem& wall) {
  const std::vector<Vec3> area = problems::nodal_areas(fluid, interface.surfaces);
  std::vector<Vec3> force(wall.mesh().n_owned);
  for (int k = 0; k < interface.n_owned(); ++k)
    force[interface.wall_nodes[k]] = area[interface.fluid_nodes[k]];
  const problems::SolidProblem::Response response = wall.respond(clock, force);
  TUNICA_CHECK(response.solve.is_converged,
               "Coupling: the wall's linear solver (" + response.solve.method +
                   ") fails for the wall at rest under unit pressure, which \"preconditioner\" = "
                   "\"added mass\" asks for. See that the wall is held; \"none\" does without.");
  std::vector<double> compliance;
  for (int k = 0; k < interface.n_owned(); ++k) {
    const Vec3& A = area[interface.fluid_nodes[k]];
    const double moved = dot(A, response.displacement[interface.wall_nodes[k]]) / norm(A);
    compliance.push_back(std::max(moved, 0.0));
  }
  return compliance;
}

}  // namespace tunica::coupling
