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

ConditionEntry velocity_condition() {
  params::Table table;
  table
      .numbers("velocity", std::nullopt, params::any(), 3, "mm/ms",
               "velocity, at the centre if the profile is parabolic")
      .choice("profile", "uniform", {"uniform", "parabolic"},
              "uniform, or parabolic with zero at the rim of a round surface")
      .sublist("Amplitude", stepping::time_function_table());
  return {Field::fluid, "velocity", table,
          [](const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int surface) {
            return terms(std::make_unique<PrescribedVelocity>(list, mesh, surface));
          },
          [](const Teuchos::ParameterList& list) {
            const bool is_parabolic = list.get<std::string>("profile") == "parabolic";
            return Drive{Drive::Kind::velocity,
                         (is_parabolic ? 0.5 : 1.0) * length_of(list, "velocity")};
          }};
}

ConditionEntry no_slip() {
  return {Field::fluid, "no slip", params::Table("no velocity"),
          [](const Teuchos::ParameterList&, const fields::FieldMesh&, int) {
            return terms(std::make_unique<NoSlip>());
          },
          drives_nothing};
}

ConditionEntry moves_with_wall() {
  return {Field::fluid, interface_condition, params::Table("moves with the wall"),
          [](const Teuchos::ParameterList&, const fields::FieldMesh&, int) {
            return terms(std::make_unique<InterfaceVelocity>());
          },
          drives_nothing};
}

}  // namespace tunica::boundary
