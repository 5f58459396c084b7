#include "tunica/boundary/held.hpp"

#include <Teuchos_Array.hpp>
#include <cmath>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/boundary/surface_geometry.hpp"

namespace tunica::boundary {

using Names = Teuchos::Array<std::string>;

void check_components(const Teuchos::ParameterList& list, const std::string& path) {
  if (!list.isParameter("components")) return;  // another condition
  TUNICA_CHECK(!list.get<Names>("components").empty(),
               path + ": \"components\" is empty, expected x, y or z.");
  for (const auto& c : list.get<Names>("components"))
    TUNICA_CHECK(c == "x" || c == "y" || c == "z",
                 path + ": \"components\" holds \"" + c + "\", expected x, y or z.");
}

std::vector<int> components_of(const Teuchos::ParameterList& list) {
  std::vector<int> components;
  for (const auto& c : list.get<Names>("components")) components.push_back(c[0] - 'x');
  return components;
}

ConditionEntry clamped() {
  return {Field::wall, "clamped", params::Table("no displacement"),
          [](const Teuchos::ParameterList&, const fields::FieldMesh&, int) {
            return terms(std::make_unique<Held>(std::vector<int>{0, 1, 2}));
          },
          drives_nothing};
}

namespace {

constexpr const char* normal = "normal";

bool is_along_normal(const Teuchos::ParameterList& list) {
  return list.get<Names>("components") == Names(1, normal);
}

void check_held_components(const Teuchos::ParameterList& list, const std::string& path) {
  if (!list.isParameter("components") || is_along_normal(list)) return;
  for (const auto& c : list.get<Names>("components"))
    TUNICA_CHECK(c != normal, path +
                                  ": \"components\" holds \"normal\" beside others, expected it "
                                  "alone.");
  check_components(list, path);
}

/// Its unit normal. Throws Error where the surface is no plane. Collective.
Vec3 normal_of_plane(const fields::FieldMesh& mesh, int surface) {
  const SurfaceGeometry plane = surface_geometry(mesh, surface);
  const double to_degrees = 180.0 / std::acos(-1.0);
  std::ostringstream message;
  message << "Surfaces / " << mesh.surfaces[surface]
          << ": it is held along its normal, but is not a plane: its normals are up to "
          << plane.bend * to_degrees << " degrees off their mean, expected at most "
          << flat * to_degrees << ". Give each plane a surface of its own, or hold components.";
  TUNICA_CHECK(plane.bend <= flat, message.str());
  return plane.normal;
}

ConditionEntry held_in(Field field, const std::string& sentence) {
  params::Table table;
  table.names("components", std::nullopt, sentence).check(check_held_components);
  return {field, "held", table,
          [](const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int surface) {
            if (!is_along_normal(list)) return terms(std::make_unique<Held>(components_of(list)));
            const std::vector<Vec3> directions{normal_of_plane(mesh, surface)};
            return terms(std::make_unique<Held>(std::vector<int>(), directions));
          },
          drives_nothing};
}

}  // namespace

ConditionEntry held() {
  return held_in(Field::wall,
                 "components of the displacement, of x, y and z, that are zero; or \"normal\" "
                 "alone: the component along the normal of a plane, in which the wall slides");
}

ConditionEntry held_velocity() {
  return held_in(Field::fluid,
                 "components of the velocity, of x, y and z, that are zero; or \"normal\" alone: "
                 "the component along the normal of a plane, as on a plane of symmetry");
}

ConditionEntry loaded_by_fluid() {
  return {Field::wall, interface_condition, params::Table("loaded by the fluid"),
          [](const Teuchos::ParameterList&, const fields::FieldMesh&, int) { return Terms(); },
          drives_nothing};
}

}  // namespace tunica::boundary
