#include "tunica/observe/wall_field.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/error.hpp"
#include "tunica/kernels/deformation.hpp"
#include "tunica/kernels/principal_axes.hpp"
#include "tunica/kernels/wall_stress.hpp"
#include "tunica/observe/arrays.hpp"

namespace tunica::observe {

namespace {

constexpr const char* wall_arrays_key = "wall arrays";
constexpr const char* length = "wall displacement";
constexpr const char* radial = "radial displacement";

double distance_from_axis(const Vec3& x) { return std::hypot(x[0], x[1]); }

/// One of the wall's elements as it is deformed.
struct Strained {
  materials::Frame frame;
  std::vector<Vec3> fibres;  ///< directions in the deformed wall, as long as they are stretched
  Mat3 F;                    ///< deformation gradient
  Sym3 sigma;                ///< Cauchy stress [kPa]
};

using Numbers = std::vector<double>;

template <class Values>
void append(const Values& values, Numbers& array) {
  array.insert(array.end(), values.begin(), values.end());
}

void stress(const Strained& element, Numbers& array) { append(element.sigma, array); }
void von_mises(const Strained& element, Numbers& array) {
  array.push_back(kernels::von_mises(element.sigma));
}
void principal_stress(const Strained& element, Numbers& array) {
  append(kernels::principal_values(element.sigma), array);
}
void principal_stretch(const Strained& element, Numbers& array) {
  for (const double squared : kernels::principal_values(kernels::right_cauchy_green(element.F)))
    array.push_back(std::sqrt(squared));
}
void circumferential(const Strained& element, Numbers& array) {
  append(element.frame.circumferential, array);
}
void axial(const Strained& element, Numbers& array) { append(element.frame.axial, array); }
/// Zero where a layer has none.
template <std::size_t f>
void fibre(const Strained& element, Numbers& array) {
  append(f < element.fibres.size() ? element.fibres[f] : Vec3{}, array);
}
template <std::size_t f>
void fibre_stress(const Strained& element, Numbers& array) {
  const Vec3 along = f < element.fibres.size() ? element.fibres[f] : Vec3{};
  const double squared = dot(along, along);
  array.push_back(squared > 0.0 ? dot(along, kernels::apply(element.sigma, along)) / squared : 0.0);
}

/// An array with values per element of the wall.
struct WallArray {
  const char* name;
  const char* kind;  ///< the word of "wall arrays" that asks for it
  int components;
  void (*append)(const Strained&, Numbers&);
  bool needs_frames = false;
};

/// In their order in files.
const std::vector<WallArray>& registered_wall_arrays() {
  static const std::vector<WallArray> all = {
      {"cauchy_stress", "stress", 6, stress},
      {"von_mises", "stress", 1, von_mises},
      {"principal_stress", "principal", 3, principal_stress},
      {"principal_stretch", "principal", 3, principal_stretch},
      {"circumferential", "fibres", 3, circumferential, true},
      {"axial", "fibres", 3, axial, true},
      {"fibre_1", "fibres", 3, fibre<0>, true},
      {"fibre_2", "fibres", 3, fibre<1>, true},
      {"fibre_stress_1", "fibres", 1, fibre_stress<0>, true},
      {"fibre_stress_2", "fibres", 1, fibre_stress<1>, true},
  };
  return all;
}

std::vector<std::string> kinds_of_wall_arrays() {
  std::vector<std::string> kinds;
  for (const WallArray& array : registered_wall_arrays())
    if (std::find(kinds.begin(), kinds.end(), array.kind) == kinds.end())
      kinds.push_back(array.kind);
  return kinds;
}

}  // namespace

void add_wall_array_keys(params::Table& table) {
  table
      .names(wall_arrays_key, kinds_of_wall_arrays(),
             "arrays in fields.h5 for the elements of the wall: stress (cauchy_stress, von_mises), "
             "principal (principal_stress, principal_stretch, the largest first), fibres (fibre_1, "
             "fibre_2 in the deformed wall, as long as they are stretched; fibre_stress_1, "
             "fibre_stress_2 along them; circumferential and axial in the unloaded one); and at "
             "the nodes, for each layer separately, the stress recovered from the elements around "
             "them: recovered_stress, recovered_von_mises, recovered_principal_stress, "
             "recovered_fibre_stress_1, recovered_fibre_stress_2, with stress_error, the root mean "
             "square of the difference between it and the stress of the elements")
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        const std::vector<std::string> kinds = kinds_of_wall_arrays();
        for (const auto& kind : list.get<Teuchos::Array<std::string>>(wall_arrays_key))
          TUNICA_CHECK(std::find(kinds.begin(), kinds.end(), kind) != kinds.end(),
                       path + ": \"" + wall_arrays_key + "\" holds \"" + kind +
                           "\", expected stress, principal or fibres.");
      });
}

std::vector<Quantity> wall_quantities() {
  std::vector<Quantity> all{{length, "mm"}, {radial, "mm"}};
  for (const char* i : {" x", " y", " z"}) all.push_back({std::string(length) + i, "mm"});
  return all;
}

std::vector<std::string> wall_arrays_in(const Teuchos::ParameterList& output) {
  if (!output.isParameter(wall_arrays_key)) return {};
  return output.get<Teuchos::Array<std::string>>(wall_arrays_key).toVector();
}

WallField::WallField(problems::SolidProblem& wall, std::vector<std::string> kinds)
    : wall_(&wall), recovery_(wall), kinds_(std::move(kinds)) {}

output::Grid WallField::grid() { return grid_of(recovery_.mesh(), "wall"); }

bool WallField::has(const std::string& kind) const {
  return std::find(kinds_.begin(), kinds_.end(), kind) != kinds_.end();
}

std::unique_ptr<problems::StepError> WallField::step_error(
    const problems::StepTolerance& tolerance) {
  return std::make_unique<problems::StepError>(*wall_, tolerance);
}

Sampler WallField::sampler() {
  return [d = fields::ghosted_vectors(wall_->mesh(), wall_->state()["displacement"]),
          mesh = &wall_->mesh()](const std::string& quantity, const fields::Place& at) {
    const Vec3 moved = at.value(d);
    if (quantity == length) return norm(moved);
    if (quantity != radial) return moved[quantity.back() - 'x'];
    const Vec3 x = at.value(mesh->x);
    return distance_from_axis(x + moved) - distance_from_axis(x);
  };
}

GridFields WallField::arrays() {
  // First what needs most room on the way.
  std::optional<problems::NodalStress> nodal;
  if (!kinds_.empty()) nodal = recovery_.recover();
  GridFields found{"wall", node_arrays(), cell_arrays()};
  if (nodal) add_recovered(*nodal, found);
  return found;
}

std::vector<output::Array> WallField::node_arrays() const {
  const fields::SplitMesh* split = recovery_.split();
  const int n_points = recovery_.mesh().n_owned;
  const auto at_points = [&](const std::vector<Vec3>& nodal) {
    std::vector<Vec3> values;
    for (int a = 0; a < n_points; ++a) values.push_back(nodal[fields::host_of(a, split)]);
    return values;
  };
  output::Array pressure = dof_array("pressure", 1, wall_->state()["pressure"]);
  if (split != wall_->split()) {  // continuous between layers
    const Numbers nodal = std::move(pressure.values);
    pressure.values.clear();
    for (int a = 0; a < n_points; ++a) pressure.values.push_back(nodal[split->node[a]]);
  }
  return {vector_array("displacement", at_points(wall_->displacement()), n_points), pressure,
          vector_array("velocity", at_points(wall_->velocity()), n_points)};
}

void WallField::add_recovered(const problems::NodalStress& nodal, GridFields& fields) const {
  output::Array stress{"recovered_stress", 6, {}}, size{"recovered_von_mises", 1, {}},
      principal{"recovered_principal_stress", 3, {}};
  for (const Sym3& sigma : nodal.stress) {
    append(sigma, stress.values);
    size.values.push_back(kernels::von_mises(sigma));
    append(kernels::principal_values(sigma), principal.values);
  }
  if (has("stress")) {
    output::Array error{"stress_error", 1, {}};
    for (std::size_t e = 0; e < nodal.error.size(); ++e)
      if (wall_->mesh().is_owned[e]) error.values.push_back(nodal.error[e]);
    fields.points.push_back(std::move(stress));
    fields.points.push_back(std::move(size));
    fields.cells.push_back(std::move(error));
  }
  if (has("principal")) fields.points.push_back(std::move(principal));
  if (!has("fibres")) return;
  for (std::size_t f = 0; f < nodal.fibres.size() && !nodal.fibres[f].empty(); ++f) {
    output::Array along{"recovered_fibre_stress_" + std::to_string(f + 1), 1, {}};
    for (std::size_t a = 0; a < nodal.stress.size(); ++a) {
      const Vec3& fibre = nodal.fibres[f][a];
      along.values.push_back(dot(fibre, kernels::apply(nodal.stress[a], fibre)));
    }
    fields.points.push_back(std::move(along));
  }
}

std::vector<output::Array> WallField::cell_arrays() const {
  const problems::SolidProblem& wall = *wall_;
  const fields::FieldMesh& mesh = wall.mesh();
  const auto d = fields::ghosted_vectors(mesh, wall.state()["displacement"]);
  const auto p = fields::ghosted_scalars(wall.scalar_mesh(), wall.state()["pressure"]);
  const auto n_elements =
      static_cast<std::size_t>(std::count(mesh.is_owned.begin(), mesh.is_owned.end(), 1));
  std::vector<const WallArray*> chosen;
  std::vector<output::Array> arrays;
  for (const WallArray& array : registered_wall_arrays()) {
    if (!has(array.kind) || (array.needs_frames && wall.field().elements().frames.empty()))
      continue;
    chosen.push_back(&array);
    arrays.push_back({array.name, array.components, {}});
    arrays.back().values.reserve(array.components * n_elements);
  }
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (!mesh.is_owned[e]) continue;
    const kernels::Tet4 T = wall.field().elements().geometry[e];
    const materials::WallLaw& law = *wall.field().elements().layer(e).law;
    const materials::Frame frame = wall.field().elements().frame(e);
    const auto d_e = wall.field().elements().displacement(e, assembly::gather(d, mesh.tets[e]));
    Strained element{frame, law.fibre_directions(frame), kernels::deformation_gradient(T, d_e),
                     kernels::cauchy_stress(T, d_e, assembly::gather(p, wall.scalar_mesh().tets[e]),
                                            law, frame, wall.field().elements().past_of(e))};
    for (Vec3& fibre : element.fibres) fibre = element.F * fibre;
    for (std::size_t k = 0; k < chosen.size(); ++k) chosen[k]->append(element, arrays[k].values);
  }
  return arrays;
}

}  // namespace tunica::observe
