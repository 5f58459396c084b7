#include "tunica/coupling/added_mass.hpp"

#include <algorithm>

#include "tunica/assembly/scalar_matrix.hpp"

namespace tunica::coupling {

namespace {

/// P need only be near: a relative residual of the Laplace problem up to this is good enough.
constexpr double usable = 0.1;

/// Zero where the interface is folded so that its areas cancel.
Vec3 direction(const Vec3& area) {
  const double size = norm(area);
  return size > 0.0 ? 1.0 / size * area : Vec3{};
}

}  // namespace

// With linear elements, and masses lumped on the interface,
//
//   (L + W C) p = W n·r,   L_ab = ∫ ∇N_a·∇N_b dV in the fluid as it lies,   p = 0 on open surfaces
//
//   W   diag(m A_a), zero where p is given        kPa      A_a   area of a node     mm²
//   C   diag(c_a)                              mm/kPa
//
// c ≥ 0 makes this symmetric and positive definite, as conjugate gradients need it.
AddedMass::AddedMass(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh,
                     const fields::NodeGraph& graph, const fields::InterfaceTransfer& interface,
                     const AddedMassModel& model)
    : interface_(&interface), compliance_(model.compliance), right_side_(mesh.node_map, 1),
      p_(mesh.node_map, 1) {
  std::vector<char> is_open(mesh.n_nodes());
  for (int a = 0; a < mesh.n_nodes(); ++a) is_open[a] = mesh.is_on_any(a, model.open_surfaces);
  const Teuchos::RCP<CrsMatrix> K = assembly::laplacian(mesh, model.positions, graph, is_open);
  K->resumeFill();
  for (int k = 0; k < interface.n_owned(); ++k) {
    const int a = interface.fluid_nodes[k];
    normal_.push_back(direction(model.area[a]));
    weight_.push_back(is_open[a] ? 0.0 : model.fluid_inertia * norm(model.area[a]));
    K->sumIntoLocalValues(a, Teuchos::tuple(a), Teuchos::tuple(weight_[k] * compliance_[k]));
  }
  K->fillComplete(mesh.node_map, mesh.node_map);
  solver_ = linear::make_scalar_solver(list, K);
}

InterfaceVector AddedMass::apply(const InterfaceVector& residual) {
  const auto normal_part = [&](int k) {
    return dot(normal_[k], {residual[3 * k], residual[3 * k + 1], residual[3 * k + 2]});
  };
  // (L + W C) p = W n·r, then z = r − C p n
  right_side_.putScalar(0.0);
  {
    const auto b = right_side_.getLocalViewHost(read_write);
    for (int k = 0; k < interface_->n_owned(); ++k)
      b(interface_->fluid_nodes[k], 0) = weight_[k] * normal_part(k);
  }
  p_.putScalar(0.0);
  InterfaceVector result(residual);
  // Without an answer P is the identity: more iterations, and the same solution.
  if (!(solver_->solve(right_side_, p_) < usable)) {
    has_failed_ = true;
    return result;
  }
  const auto p = p_.getLocalViewHost(read_only);
  for (int k = 0; k < interface_->n_owned(); ++k) {
    const double taken_back = compliance_[k] * p(interface_->fluid_nodes[k], 0);
    for (int i = 0; i < 3; ++i) result[3 * k + i] -= taken_back * normal_[k][i];
  }
  return result;
}

// C_k = n_k·d_k, d the wall's linear answer to the pressure 1
Result<std::vector<double>> wall_compliance(const fields::InterfaceTransfer& interface,
                                            const std::vector<Vec3>& area,
                                            problems::SolidProblem& wall) {
  // The pressure 1 loads node k with its area times normal.
  const InterfaceVector areas = interface.from_fluid(area);
  const auto answer = wall.solve_linearised(interface.to_wall(areas));
  if (answer.is_failure()) return Result<std::vector<double>>::failure(answer.reason());
  const InterfaceVector d = interface.from_wall(answer.value());
  std::vector<double> compliance;
  for (std::size_t k = 0; k < d.size(); k += 3)
    // A wall that moves against the pressure somewhere gets c = 0 there.
    compliance.push_back(std::max(0.0, dot(direction({areas[k], areas[k + 1], areas[k + 2]}),
                                           Vec3{d[k], d[k + 1], d[k + 2]})));
  return compliance;
}

}  // namespace tunica::coupling
