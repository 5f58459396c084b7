#pragma once
#include <cmath>

#include "oracle/quadrature.hpp"
#include "tunica/problems/fluid_problem.hpp"

namespace tunica::verify {

/// What test_manufactured.cpp and test_moving_domain.cpp know of an exact flow at a point.
struct Flow {
  Vec3 u, dudt, laplacian, grad_p;
  Mat3 G{};  ///< ∇u
  double p;
};

/// f = ∂u/∂t + (u·∇)u − ν Δu + ∇p/ρ.
inline Vec3 body_force(const Flow& flow, double density, double viscosity) {
  return flow.dudt + flow.G * flow.u - viscosity / density * flow.laplacian +
         1.0 / density * flow.grad_p;
}

struct FlowErrors {
  double u, p;
};

/// L2 norms on the current mesh, exact(x) the Flow there; the mean of the pressure's error is
/// taken out.
template <class Exact>
FlowErrors flow_errors(const problems::FluidProblem& fluid, const Exact& exact) {
  const fields::FieldMesh& mesh = fluid.mesh();
  const auto u = fields::ghosted_vectors(mesh, fluid.state()[0]);
  const auto p = fields::ghosted_scalars(mesh, fluid.state()[1]);
  double volume = 0.0, u2 = 0.0, p1 = 0.0, p2 = 0.0;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (!mesh.is_owned[e]) continue;
    for (const oracle::TetPoint& point : oracle::tet_rule()) {
      Vec3 x{}, u_h{};
      double p_h = 0.0;
      for (int a = 0; a < 4; ++a) {
        const int node = mesh.tets[e][a];
        x += point.N[a] * fluid.field().positions()[node];
        u_h += point.N[a] * u[node];
        p_h += point.N[a] * p[node];
      }
      const Flow flow = exact(x);
      const double dV = point.weight * fluid.field().elements().geometry[e].volume;
      volume += dV;
      u2 += dV * dot(u_h - flow.u, u_h - flow.u);
      p1 += dV * (p_h - flow.p);
      p2 += dV * (p_h - flow.p) * (p_h - flow.p);
    }
  }
  const auto sum = [&mesh](double mine) { return global_sum(*mesh.comm, mine); };
  p1 = sum(p1);
  return {std::sqrt(sum(u2)), std::sqrt(sum(p2) - p1 * p1 / sum(volume))};
}

}  // namespace tunica::verify
