#include "tunica/app/probes.hpp"

#include <Teuchos_Array.hpp>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"

namespace tunica::app {

namespace {

constexpr const char* fluid_pressure = "fluid pressure";
constexpr const char* wall_displacement = "wall displacement";
constexpr const char* radial_displacement = "radial displacement";

/// Owned node nearest to the position over all ranks: its local number on one rank, -1 on the
/// others.
int nearest_node(const fields::FieldMesh& mesh, const Vec3& position) {
  double distance = 1e300;
  int nearest = -1;
  for (int a = 0; a < mesh.n_owned; ++a)
    if (const double r = norm(mesh.x[a] - position); r < distance) {
      distance = r;
      nearest = a;
    }
  const double smallest = global_min(*mesh.comm, distance);
  const double rank = distance == smallest ? mesh.comm->getRank() : mesh.comm->getSize();
  return global_min(*mesh.comm, rank) == mesh.comm->getRank() ? nearest : -1;
}

double distance_from_axis(const Vec3& x) { return std::hypot(x[0], x[1]); }

double wall_value(const std::string& quantity, const Vec3& x, const Vec3& d) {
  if (quantity == wall_displacement) return norm(d);
  return distance_from_axis(x + d) - distance_from_axis(x);
}

}  // namespace

params::Table probe_table(bool has_fluid, bool has_wall) {
  std::vector<std::string> quantities;
  if (has_fluid) quantities.push_back(fluid_pressure);
  if (has_wall) quantities.insert(quantities.end(), {wall_displacement, radial_displacement});
  params::Table table("A point whose value becomes a column of steps.csv.");
  table
      .choice("quantity", std::nullopt, quantities,
              "fluid pressure [kPa], length of the wall's displacement, or change of the "
              "distance from the z axis [mm]")
      .numbers("position", std::nullopt, params::any(), 3, "mm",
               "the nearest vertex of the undeformed mesh is taken");
  return table;
}

Probes::Probes(const Teuchos::ParameterList& list, const fields::FieldMesh* fluid,
               const fields::FieldMesh* wall) {
  for (auto it = list.begin(); it != list.end(); ++it) {
    const std::string& name = list.name(it);
    const Teuchos::ParameterList& entry = list.sublist(name);
    const auto& x = entry.get<Teuchos::Array<double>>("position");
    Probe probe{name, entry.get<std::string>("quantity"), {x[0], x[1], x[2]}, -1};
    const fields::FieldMesh* mesh = probe.quantity == fluid_pressure ? fluid : wall;
    TUNICA_ASSERT(mesh != nullptr, "probe_table() permits only quantities of the case's fields");
    probe.node = nearest_node(*mesh, probe.position);
    if (probe.node >= 0) probe.position = mesh->x[probe.node];
    probes_.push_back(probe);
  }
}

discretisation::Observables Probes::observe(const problems::FluidProblem* fluid,
                                            const problems::SolidProblem* wall) const {
  discretisation::Observables found;
  const std::vector<Vec3> d = wall != nullptr ? wall->displacement() : std::vector<Vec3>{};
  for (const Probe& probe : probes_) {
    std::string column =
        probe.quantity + "_" + probe.name + (probe.quantity == fluid_pressure ? "_kPa" : "_mm");
    for (char& c : column)
      if (c == ' ') c = '_';
    double value = 0.0;
    if (probe.node >= 0)
      value = probe.quantity == fluid_pressure
                  ? fluid->state()[1].getLocalViewHost(read_only)(probe.node, 0)
                  : wall_value(probe.quantity, probe.position, d[probe.node]);
    const Comm& comm = fluid != nullptr ? *fluid->mesh().comm : *wall->mesh().comm;
    found.push_back({column, global_sum(comm, value)});
  }
  return found;
}

}  // namespace tunica::app
