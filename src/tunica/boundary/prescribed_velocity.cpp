#include "tunica/boundary/prescribed_velocity.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>

namespace tunica::boundary {

PrescribedVelocity::PrescribedVelocity(const Teuchos::ParameterList& list,
                                       const fields::FieldMesh& mesh, int surface)
    : amplitude_(list.sublist("Amplitude")) {
  const auto& u = list.get<Teuchos::Array<double>>("velocity");
  velocity_ = {u[0], u[1], u[2]};
  if (list.get<std::string>("profile") == "parabolic") round_ = surface_geometry(mesh, surface);
}

Vec3 PrescribedVelocity::prescribed(const Surroundings& s, int node) const {
  if (s.velocity != nullptr) return (*s.velocity)((*s.position)[node], s.time);
  double factor = amplitude_(s.time);
  if (round_) {
    const double r = norm((*s.position)[node] - round_->centre) / round_->radius;
    factor *= std::max(0.0, 1.0 - r * r);  // 1 − (r/R)²
  }
  return factor * velocity_;
}

}  // namespace tunica::boundary
