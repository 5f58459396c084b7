#include "tunica/boundary/traction.hpp"

#include <Teuchos_Array.hpp>

#include "tunica/assembly/gather.hpp"
#include "tunica/kernels/surface_tri3.hpp"

namespace tunica::boundary {

Traction::Traction(const Teuchos::ParameterList& list, bool on_undeformed)
    : on_undeformed_(on_undeformed), is_normal_(list.isParameter("pressure")),
      amplitude_(list.sublist("Amplitude")) {
  if (is_normal_) {
    pressure_ = list.get<double>("pressure");
  } else {
    const auto& t = list.get<Teuchos::Array<double>>("traction");
    traction_ = {t[0], t[1], t[2]};
  }
}

kernels::SurfaceResidual Traction::load(const Surroundings& s, const fields::Face& face) const {
  const auto x = assembly::gather(on_undeformed_ ? *s.reference : *s.position, face.nodes);
  Vec3 t = traction_;
  if (is_normal_) {
    const Vec3 n = kernels::area_normal(x);
    t = -pressure_ / norm(n) * n;
  }
  return kernels::dead_traction(x, amplitude_(s.time) * t);
}

void Traction::add(const Surroundings& s, const fields::Face& face, assembly::NodalResidual& R,
                   assembly::BlockAssembler*) const {
  R.add(*s.mesh, face, load(s, face));
}

void Traction::observe(const Surroundings& s, const fields::Face& face,
                       std::map<std::string, double>& sums) const {
  const auto R = load(s, face);
  for (int a = 0; a < 3; ++a) sums[traction_power] -= dot(R.u[a], (*s.u)[face.nodes[a]]);
}

}  // namespace tunica::boundary
