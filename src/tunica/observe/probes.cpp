#include "tunica/observe/probes.hpp"

#include <Teuchos_Array.hpp>
#include <cmath>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"

namespace tunica::observe {

namespace {

constexpr const char* fluid_pressure = "fluid pressure";
constexpr const char* fluid_velocity = "fluid velocity";
constexpr const char* wall_displacement = "wall displacement";
constexpr const char* radial_displacement = "radial displacement";

/// A probe may lie outside the mesh by no more than this part of the nearest element's edge. It is
/// then moved to the surface.
constexpr double tolerance = 1e-3;

std::string braces(const Vec3& x) {
  std::ostringstream text;
  text << "{" << x[0] << ", " << x[1] << ", " << x[2] << "}";
  return text.str();
}

void check_place(const fields::Place& place, const Vec3& position, const std::string& name,
                 const std::string& field) {
  std::ostringstream text;
  text << "Probes / " << name << ": \"position\" " << braces(position) << " lies " << place.distance
       << " mm outside the undeformed " << field << ". The nearest point in it is "
       << braces(place.position) << ".";
  TUNICA_CHECK(place.distance <= tolerance * place.element_length, text.str());
}

double distance_from_axis(const Vec3& x) { return std::hypot(x[0], x[1]); }

bool is_velocity(const std::string& quantity) { return quantity.rfind(fluid_velocity, 0) == 0; }
bool is_of_fluid(const std::string& quantity) {
  return quantity == fluid_pressure || is_velocity(quantity);
}

std::string unit_of(const std::string& quantity) {
  return quantity == fluid_pressure ? "_kPa" : is_velocity(quantity) ? "_mm_per_ms" : "_mm";
}

/// Of a quantity that ends in the name of a component.
double component(const std::string& quantity, const Vec3& v) { return v[quantity.back() - 'x']; }

double wall_value(const std::string& quantity, const Vec3& x, const Vec3& d) {
  if (quantity == wall_displacement) return norm(d);
  if (quantity == radial_displacement) return distance_from_axis(x + d) - distance_from_axis(x);
  return component(quantity, d);
}

}  // namespace

params::Table probe_table(bool has_fluid, bool has_wall) {
  std::vector<std::string> quantities;
  const auto add_components = [&](const std::string& of) {
    for (const char* i : {" x", " y", " z"}) quantities.push_back(of + i);
  };
  if (has_fluid) quantities.push_back(fluid_pressure);
  if (has_wall) quantities.insert(quantities.end(), {wall_displacement, radial_displacement});
  if (has_fluid) add_components(fluid_velocity);
  if (has_wall) add_components(wall_displacement);
  params::Table table("A point whose value becomes a column of steps.csv.");
  table
      .choice(
          "quantity", std::nullopt, quantities,
          "fluid pressure [kPa], length of the wall's displacement, change of the distance from "
          "the z axis [mm], or a component of the fluid's velocity [mm/ms] or of the wall's "
          "displacement [mm]")
      .numbers("position", std::nullopt, params::any(), 3, "mm",
               "in the undeformed field, where the value is interpolated");
  return table;
}

Probes::Probes(const Teuchos::ParameterList& list, const fields::FieldMesh* fluid,
               const fields::FieldMesh* wall) {
  for (auto it = list.begin(); it != list.end(); ++it) {
    const std::string& name = list.name(it);
    const Teuchos::ParameterList& entry = list.sublist(name);
    const auto& x = entry.get<Teuchos::Array<double>>("position");
    const Vec3 position{x[0], x[1], x[2]};
    const auto& quantity = entry.get<std::string>("quantity");
    const bool is_fluid = is_of_fluid(quantity);
    const fields::FieldMesh* mesh = is_fluid ? fluid : wall;
    TUNICA_ASSERT(mesh != nullptr, "probe_table() permits only quantities of the case's fields");
    probes_.push_back({name, quantity, fields::locate(*mesh, position)});
    check_place(probes_.back().place, position, name, is_fluid ? "fluid" : "wall");
  }
}

discretisation::Observables Probes::observe(const problems::FluidProblem* fluid,
                                            const problems::SolidProblem* wall) const {
  if (probes_.empty()) return {};
  std::vector<double> p;
  std::vector<Vec3> u, d;
  if (fluid != nullptr) u = fields::ghosted_vectors(fluid->mesh(), fluid->state()["velocity"]);
  if (fluid != nullptr) p = fields::ghosted_scalars(fluid->mesh(), fluid->state()["pressure"]);
  if (wall != nullptr) d = fields::ghosted_vectors(wall->mesh(), wall->state()["displacement"]);
  const Comm& comm = fluid != nullptr ? *fluid->mesh().comm : *wall->mesh().comm;
  discretisation::Observables found;
  for (const Probe& probe : probes_) {
    std::string column = probe.quantity + "_" + probe.name + unit_of(probe.quantity);
    for (char& c : column)
      if (c == ' ') c = '_';
    const fields::Place& at = probe.place;
    double value = 0.0;
    if (at.is_here && probe.quantity == fluid_pressure)
      value = at.value(p);
    else if (at.is_here && is_velocity(probe.quantity))
      value = component(probe.quantity, at.value(u));
    else if (at.is_here)
      value = wall_value(probe.quantity, at.value(wall->mesh().x), at.value(d));
    found.push_back({column, global_sum(comm, value)});
  }
  return found;
}

}  // namespace tunica::observe
