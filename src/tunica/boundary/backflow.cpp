#include "tunica/boundary/backflow.hpp"

#include "tunica/assembly/gather.hpp"

namespace tunica::boundary {

void Backflow::add(const Surroundings& s, const fields::Face& face, assembly::NodalResidual& R,
                   assembly::BlockAssembler* K) const {
  const auto x = assembly::gather(*s.position, face.nodes), u = assembly::gather(*s.u, face.nodes),
             w = assembly::gather(*s.w, face.nodes);
  kernels::SurfaceResidual Re;
  if (K == nullptr) {
    Re = kernels::backflow(x, u, w, beta_ * s.density);
  } else {
    kernels::SurfaceJacobian Ke;
    kernels::backflow_jacobian(x, u, w, beta_ * s.density, Re, Ke);
    K->add(face, Ke);
  }
  R.add(*s.mesh, face, Re);
}

void Backflow::add_shape(const Surroundings& s, const fields::Face& face,
                         assembly::FluidShapeMatrix& S) const {
  const auto x = assembly::gather(*s.position, face.nodes), u = assembly::gather(*s.u, face.nodes),
             w = assembly::gather(*s.w, face.nodes);
  kernels::SurfaceJacobian K;
  kernels::backflow_shape(x, u, w, beta_ * s.density, s.mesh_rate, K);
  S.add(face, K);
}

void Backflow::observe(const Surroundings& s, const fields::Face& face,
                       std::map<std::string, double>& sums) const {
  const auto x = assembly::gather(*s.position, face.nodes), u = assembly::gather(*s.u, face.nodes),
             w = assembly::gather(*s.w, face.nodes);
  const auto brake = kernels::backflow(x, u, w, beta_ * s.density);
  for (int a = 0; a < 3; ++a) sums[backflow_power] += dot(brake.u[a], u[a]);
}

void add_backflow_key(params::Table& table) {
  table.number("backflow stabilisation", 0.0, params::non_negative(), "1",
               "factor β of the term that removes the energy that inflow through an open surface "
               "brings in; 0 is the paper's choice, 0.2 is safe");
}

}  // namespace tunica::boundary
