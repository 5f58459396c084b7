#include "tunica/boundary/traction.hpp"

#include <Teuchos_Array.hpp>

#include "tunica/assembly/gather.hpp"
#include "tunica/boundary/backflow.hpp"
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

void Traction::add_shape(const Surroundings& s, const fields::Face& face,
                         assembly::FluidShapeMatrix& S) const {
  const auto x = assembly::gather(*s.position, face.nodes);
  kernels::SurfaceResidual R;
  kernels::SurfaceJacobian K;
  if (is_normal_)
    kernels::follower_pressure_jacobian(x, amplitude_(s.time) * pressure_, R, K);
  else
    kernels::dead_traction_shape(x, amplitude_(s.time) * traction_, K);
  S.add(face, K);
}

void Traction::observe(const Surroundings& s, const fields::Face& face,
                       std::map<std::string, double>& sums) const {
  const auto R = load(s, face);
  for (int a = 0; a < 3; ++a) sums[traction_power] -= dot(R.u[a], (*s.u)[face.nodes[a]]);
}

namespace {

params::Table traction_table(const std::string& sentence) {
  params::Table table;
  return table.numbers("traction", std::nullopt, params::any(), 3, "kPa", sentence);
}

Drive drive_of(const Teuchos::ParameterList& list) {
  if (list.isParameter("pressure")) return {Drive::Kind::pressure, list.get<double>("pressure")};
  return {Drive::Kind::traction, length_of(list, "traction")};
}

/// A surface that the fluid may pass under a load.
ConditionEntry open_surface(const std::string& name, params::Table table) {
  add_backflow_key(table);
  table.sublist("Amplitude", stepping::time_function_table());
  const auto make = [](const Teuchos::ParameterList& list, const fields::FieldMesh&, int) {
    Terms all = terms(std::make_unique<Traction>(list, false));
    const double beta = list.get<double>("backflow stabilisation");
    if (beta != 0.0) all.push_back(std::make_unique<Backflow>(beta));
    return all;
  };
  return {Field::fluid, name, table, make, drive_of};
}

}  // namespace

ConditionEntry open_traction() {
  return open_surface("traction",
                      traction_table("traction σ n on the surface; zero is a free outlet"));
}

ConditionEntry open_pressure() {
  params::Table table;
  table.number("pressure", std::nullopt, params::any(), "kPa", "p of the traction -p n");
  return open_surface("pressure", table);
}

ConditionEntry dead_traction() {
  params::Table table = traction_table("dead load per undeformed area, its direction fixed");
  table.sublist("Amplitude", stepping::time_function_table());
  return {Field::wall, "traction", table,
          [](const Teuchos::ParameterList& list, const fields::FieldMesh&, int) {
            return terms(std::make_unique<Traction>(list, true));
          },
          drive_of};
}

}  // namespace tunica::boundary
