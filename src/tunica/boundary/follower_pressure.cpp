#include "tunica/boundary/follower_pressure.hpp"

#include "tunica/assembly/gather.hpp"

namespace tunica::boundary {

FollowerPressure::FollowerPressure(const Teuchos::ParameterList& list)
    : pressure_(list.get<double>("pressure")), amplitude_(list.sublist("Amplitude")) {}

void FollowerPressure::add(const Surroundings& s, const fields::Face& face,
                           assembly::NodalResidual& R, assembly::BlockAssembler* K) const {
  auto x = assembly::gather(*s.reference, face.nodes);
  for (int a = 0; a < 3; ++a) x[a] += (*s.u)[face.nodes[a]];  // x = X + d
  const double pressure = amplitude_(s.time) * pressure_;
  kernels::SurfaceResidual Re;
  if (K == nullptr || !s.follows) {
    Re = kernels::follower_pressure(x, pressure);
  } else {
    kernels::SurfaceJacobian Ke;
    kernels::follower_pressure_jacobian(x, pressure, Re, Ke);
    K->add(face, Ke);
  }
  R.add(*s.mesh, face, Re);
}

ConditionEntry follower_pressure() {
  params::Table table;
  table
      .number("pressure", std::nullopt, params::any(), "kPa",
              "pressure that follows the deformed surface")
      .sublist("Amplitude", stepping::time_function_table());
  return {Field::wall, "pressure", table,
          [](const Teuchos::ParameterList& list, const fields::FieldMesh&, int) {
            return terms(std::make_unique<FollowerPressure>(list));
          },
          [](const Teuchos::ParameterList& list) {
            return Drive{Drive::Kind::pressure, list.get<double>("pressure")};
          }};
}

}  // namespace tunica::boundary
