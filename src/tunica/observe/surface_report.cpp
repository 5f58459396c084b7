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

SurfaceReport::SurfaceReport(const std::vector<std::string>& wanted, std::vector<ForceGroup> groups,
                             const std::vector<std::unique_ptr<Field>>& fields)
    : groups_(std::move(groups)) {
  for (const auto& field : fields) fields_.emplace_back(field.get(), chosen(wanted, field->mesh()));
  if (groups_.empty()) return;
  for (const auto& [field, surfaces] : fields_) {
    if (field->name() != "fluid") continue;
    fluid_ = field;
    for (const int s : chosen(surfaces_of(groups_), field->mesh()))
      if (std::find(surfaces.begin(), surfaces.end(), s) == surfaces.end())
        more_of_fluid_.push_back(s);
  }
}

discretisation::Observables SurfaceReport::observe() const {
  discretisation::Observables found;
  for (const auto& [field, surfaces] : fields_) {
    if (surfaces.empty()) continue;
    for (const discretisation::Observable& o : field->observe_surfaces(surfaces))
      found.push_back(o);
  }
  if (groups_.empty()) return found;
  discretisation::Observables all(found);
  if (!more_of_fluid_.empty())
    for (const discretisation::Observable& o : fluid_->observe_surfaces(more_of_fluid_))
      all.push_back(o);
  for (const discretisation::Observable& o : summed_forces(groups_, all)) found.push_back(o);
  return found;
}

}  // namespace tunica::observe
