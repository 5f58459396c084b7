#include "tunica/output/stored_fields.hpp"

#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/output/field_files.hpp"

namespace tunica::output {

namespace {

struct Written {
  int step;
  double time;
};

/// The finished steps, in their order.
std::vector<Written> written_steps(const io::Hdf5Reader& file) {
  std::vector<Written> steps;
  const std::string prefix = "step_";
  for (const std::string& name : file.names("/"))
    if (name.rfind(prefix, 0) == 0 && file.has_attribute(time_name, name))
      steps.push_back({std::stoi(name.substr(prefix.size())), file.number(time_name, name)});
  return steps;
}

std::string times_text(const std::vector<Written>& steps) {
  constexpr std::size_t shown = 8;
  std::string text;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (k == shown / 2 && steps.size() > shown) {
      text += ", ...";
      k = steps.size() - shown / 2;
    }
    text += (text.empty() ? "" : ", ") + formatted("%g", steps[k].time);
  }
  return text;
}

const Written& chosen(const std::vector<Written>& steps, std::optional<double> time,
                      const std::string& path) {
  TUNICA_CHECK(!steps.empty(), path + ": it holds no finished step.");
  if (!time) return steps.back();
  for (const Written& step : steps)
    if (std::abs(step.time - *time) <= 1e-9 * std::max(1.0, std::abs(*time))) return step;
  throw Error(path + formatted(": it holds no fields at %g ms, but at ", *time) +
              times_text(steps) + " ms.");
}

}  // namespace

StoredFields::StoredFields(const std::string& folder, std::optional<double> time)
    : path_(folder + "/" + hdf5_name), file_(path_) {
  const std::vector<Written> steps = written_steps(file_);
  const Written& step = chosen(steps, time, path_);
  step_ = step.step;
  time_ = step.time;
}

StoredFields::Mesh StoredFields::mesh(const std::string& grid) const {
  Mesh mesh;
  const std::vector<double> points = file_.reals(grid + "/points", 3);
  for (std::size_t k = 0; k < points.size(); k += 3)
    mesh.x.push_back({points[k], points[k + 1], points[k + 2]});
  const std::vector<int> tets = file_.integers(grid + "/tets", 4);
  const int n = static_cast<int>(mesh.x.size());
  for (const int v : tets)
    TUNICA_CHECK(v >= 0 && v < n, path_ + ": " + grid + "/tets names points that do not exist.");
  for (std::size_t k = 0; k < tets.size(); k += 4)
    mesh.tets.push_back({tets[k], tets[k + 1], tets[k + 2], tets[k + 3]});
  TUNICA_CHECK(!mesh.tets.empty(), path_ + ": " + grid + " has no tetrahedra.");
  mesh.region = file_.integers(grid + "/region");
  TUNICA_CHECK(mesh.region.size() == mesh.tets.size(),
               path_ + ": " + grid + "/region is not of the length of the tetrahedra.");
  mesh.regions = file_.strings(grid + "/region_names");
  return mesh;
}

std::vector<double> StoredFields::values(const std::string& grid, const std::string& array,
                                         int columns) const {
  const std::string name = step_group(step_) + "/" + grid + "/" + array;
  if (!file_.has(name)) return {};
  const std::vector<double> found = file_.reals(name, columns);
  TUNICA_CHECK(found.size() == file_.rows(grid + "/points", 3) * columns,
               path_ + ": " + name + " is not of the length of the points.");
  return found;
}

}  // namespace tunica::output
