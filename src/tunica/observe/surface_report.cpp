#include "tunica/observe/surface_report.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>

#include "tunica/base/error.hpp"

namespace tunica::observe {

namespace {

constexpr const char* surfaces_key = "surfaces";
constexpr const char* every = "all";
constexpr const char* none = "none";

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void check_names(const Teuchos::ParameterList& output, const std::string& path) {
  const std::vector<std::string> names = surfaces_in(output);
  for (const char* word : {every, none})
    TUNICA_CHECK(!holds(names, word) || names.size() == 1,
                 path + ": \"" + surfaces_key + "\" holds \"" + word +
                     "\" beside other names. Let it stand "
                     "alone, or name the surfaces.");
}

std::vector<int> chosen(const std::vector<std::string>& names, const fields::FieldMesh& mesh) {
  std::vector<int> surfaces;
  for (const int s : fields::bounding_surfaces(mesh))
    if (holds(names, every) || holds(names, mesh.surfaces[s])) surfaces.push_back(s);
  return surfaces;
}

}  // namespace

void add_surface_keys(params::Table& table) {
  table
      .names(surfaces_key, std::vector<std::string>{every},
             "surfaces whose area, flow, pressure, forces and displacement become columns of "
             "steps.csv; all or none")
      .check(check_names);
}

std::vector<std::string> surfaces_in(const Teuchos::ParameterList& output) {
  if (!output.isParameter(surfaces_key)) return {};
  return output.get<Teuchos::Array<std::string>>(surfaces_key).toVector();
}

std::vector<std::string> named_surfaces(const std::vector<std::string>& wanted) {
  return holds(wanted, every) || holds(wanted, none) ? std::vector<std::string>{} : wanted;
}

SurfaceReport::SurfaceReport(const std::vector<std::string>& wanted,
                             const std::vector<std::unique_ptr<Field>>& fields) {
  for (const auto& field : fields) fields_.emplace_back(field.get(), chosen(wanted, field->mesh()));
}

discretisation::Observables SurfaceReport::observe() const {
  discretisation::Observables found;
  for (const auto& [field, surfaces] : fields_) {
    if (surfaces.empty()) continue;
    for (const discretisation::Observable& o : field->observe_surfaces(surfaces))
      found.push_back(o);
  }
  return found;
}

}  // namespace tunica::observe
