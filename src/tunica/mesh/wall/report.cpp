#include "tunica/mesh/wall/report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/base/formatted.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/info.hpp"
#include "tunica/mesh/text.hpp"
#include "tunica/mesh/validate.hpp"
#include "tunica/mesh/wall/elements.hpp"
#include "tunica/mesh/wall/surface_distance.hpp"

namespace tunica::mesh::wall {
namespace {

constexpr double whole = 0.95;  ///< from this part on the thickness is what was wanted
constexpr std::size_t most_places = 5;

/// Of the wall at each vertex: how far its end is from the surface.
std::vector<double> thickness_of(const Plan& plan) {
  const SurfaceDistance to_surface(plan.surface);
  std::vector<double> result;
  for (int v = 0; v < plan.surface.vertices(); ++v)
    result.push_back(to_surface.nearest(plan.place(v, 1.0), plan.left(v)).distance);
  return result;
}

/// Thickness of a layer at the vertices, by its share of the wall.
void measure_thickness(const std::vector<double>& thickness, const Plan& plan, double share,
                       Report::LayerReport& report) {
  report.least = std::numeric_limits<double>::max();
  for (int v = 0; v < plan.surface.vertices(); ++v) {
    const double here = share * thickness[v];
    report.least = std::min(report.least, here);
    report.most = std::max(report.most, here);
    report.mean += here / plan.surface.vertices();
  }
}

/// Of the prisms on the lumen's triangles, each at the mean thickness of its corners.
void measure_flatness(const std::vector<double>& thickness, const Plan& plan, double share,
                      Report::LayerReport& report) {
  const int n = static_cast<int>(plan.surface.triangles.size());
  int flat = 0;
  for (int t = 0; t < n; ++t) {
    const auto& v = plan.surface.triangles[t];
    const double height =
        share / report.elements * (thickness[v[0]] + thickness[v[1]] + thickness[v[2]]) / 3.0;
    const double ratio = width(plan.surface, t) / height;
    report.mean_flatness += ratio / n;
    report.most_flatness = std::max(report.most_flatness, ratio);
    if (ratio > flattest) ++flat;
  }
  report.flat_part = double(flat) / n;
}

void measure_elements(const Mesh& mesh, int region, Report& report, Report::LayerReport& layer) {
  layer.least_angle = 180.0;
  layer.worst_quality = 1.0;
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    if (mesh.tet_region[t] != region) continue;
    ++layer.tets;
    layer.worst_quality = std::min(layer.worst_quality, quality(mesh, t));
    const double angle = least_dihedral_angle(corners(mesh, t));
    layer.least_angle = std::min(layer.least_angle, angle);
    if (angle >= report.least_angle) continue;
    report.least_angle = angle;
    report.least_angle_place = corners(mesh, t)[0];
  }
}

/// The limited vertices that hang together with this one; they are marked.
Report::Limited place_around(const Plan& plan, const std::vector<double>& thickness, int first,
                             std::vector<bool>& is_seen) {
  const Lists& neighbours = plan.surface.neighbours_of;
  std::vector<int> members{first};
  is_seen[first] = true;
  int least = first;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const int v = members[i];
    if (thickness[v] < thickness[least]) least = v;
    for (int k = neighbours.begin[v]; k < neighbours.begin[v + 1]; ++k) {
      const int w = neighbours.items[k];
      if (is_seen[w] || thickness[w] >= whole * plan.thickness[w]) continue;
      is_seen[w] = true;
      members.push_back(w);
    }
  }
  return {static_cast<int>(members.size()), thickness[least], plan.thickness[least],
          plan.surface.x[least], plan.is_dense[least]};
}

void measure_limits(const Plan& plan, const std::vector<double>& thickness, Report& report) {
  report.surface_vertices = plan.surface.vertices();
  report.least_thickness = std::numeric_limits<double>::max();
  std::vector<bool> is_seen(plan.part.size(), false);
  for (int v = 0; v < plan.surface.vertices(); ++v) {
    report.least_thickness = std::min(report.least_thickness, thickness[v]);
    if (is_seen[v] || thickness[v] >= whole * plan.thickness[v]) continue;
    report.limited.push_back(place_around(plan, thickness, v, is_seen));
    report.limited_vertices += report.limited.back().vertices;
  }
  std::stable_sort(report.limited.begin(), report.limited.end(),
                   [](const Report::Limited& a, const Report::Limited& b) {
                     return a.least_thickness / a.wanted < b.least_thickness / b.wanted;
                   });
}

/// Part of the wall's thickness that a layer has.
double share_of(const Plan& plan, int layer) {
  double share = 0.0;
  for (int level = 0; level < plan.steps(); ++level)
    if (plan.layer[level] == layer) share += plan.heights[level + 1] - plan.heights[level];
  return share;
}

/// A line of text by printf's rules.
template <typename... Values>
std::string line(const char* format, Values... values) {
  return formatted(format, values...) + "\n";
}

/// What makes the elements of a layer no flatter than 1 : 10 on average: fewer of them, or smaller
/// triangles.
std::string cure(const Report& report, const Report::LayerReport& layer) {
  const int fewer = static_cast<int>(layer.elements * flattest / layer.mean_flatness);
  if (fewer >= layer.elements) return "";
  if (fewer >= 1)
    return ". Give it " + std::to_string(fewer) + (fewer == 1 ? " element" : " elements") +
           " through it (" + layer.name + "=THICKNESS:" + std::to_string(fewer) + ")";
  const double too_wide = layer.mean_flatness / layer.elements / flattest;
  const int times = static_cast<int>(std::ceil(std::log2(too_wide)));
  std::string text = layer.elements > 1 ? ". Give it 1 element through it, and" : ". Give";
  return text + " the lumen triangles " + show(report.mean_width / too_wide) +
         " wide in place of " + show(report.mean_width) +
         ", for instance by tunica-mesh refine --times " + std::to_string(times) +
         ", or join the layer to the one beside it";
}

std::string warnings_of_flat_elements(const Report& report) {
  constexpr double few = 0.01;
  std::string text;
  for (const auto& layer : report.layers)
    if (layer.flat_part > few)
      text += formatted(
                  "warning: %.0f %% of the elements of \"%s\" are flatter than 1 : %.0f, up to 1 : "
                  "%.1f",
                  100.0 * layer.flat_part, layer.name.c_str(), flattest, layer.most_flatness) +
              cure(report, layer) + ".\n";
  return text;
}

}  // namespace

Report make_report(const Mesh& mesh, const Plan& plan, const Options& options) {
  Report report{};
  report.least_angle = 180.0;
  const int triangles = static_cast<int>(plan.surface.triangles.size());
  for (int t = 0; t < triangles; ++t) report.mean_width += width(plan.surface, t) / triangles;
  const std::vector<double> thickness = thickness_of(plan);
  for (std::size_t l = 0; l < options.layers.size(); ++l) {
    const Layer& layer = options.layers[l];
    Report::LayerReport each{};
    each.name = layer.name;
    each.elements = layer.elements;
    const double share = share_of(plan, static_cast<int>(l));
    measure_thickness(thickness, plan, share, each);
    measure_flatness(thickness, plan, share, each);
    measure_elements(mesh, region_index(mesh, layer.name), report, each);
    report.layers.push_back(each);
  }
  measure_limits(plan, thickness, report);
  report.bent_caps = plan.surface.bent_caps;
  return report;
}

std::string to_text(const Report& report) {
  std::string text = line("%-16s %8s %9s  %-26s %16s %7s %9s", "layer", "elements", "tets",
                          "thickness min, mean, max", "width / height", "least", "worst");
  text += line("%-16s %8s %9s  %-26s %16s %7s %9s", "", "through", "", "", "mean, max", "angle",
               "quality");
  for (const auto& each : report.layers)
    text += line("%-16s %8d %9d  %-8.4g %-8.4g %-8.4g %8.1f %8.1f %6.1f %9.4f", each.name.c_str(),
                 each.elements, each.tets, each.least, each.mean, each.most, each.mean_flatness,
                 each.most_flatness, each.least_angle, each.worst_quality);
  text += line("least angle between two faces: %.1f degrees, at ", report.least_angle);
  text.back() = ' ';
  text += show(report.least_angle_place) + "\n";
  text += line("limited vertices: %d of %d", report.limited_vertices, report.surface_vertices);
  for (std::size_t i = 0; i < std::min(most_places, report.limited.size()); ++i) {
    const Report::Limited& each = report.limited[i];
    text +=
        "  " + std::to_string(each.vertices) + " around " + show(each.place) + ", down to " +
        show(each.least_thickness) + " of " + show(each.wanted) + ": " +
        (each.is_dense ? "another part is close" : "the curvature of the surface permits no more") +
        "\n";
  }
  if (report.limited.size() > most_places)
    text += "  and at " + std::to_string(report.limited.size() - most_places) + " places more\n";
  text += warnings_of_flat_elements(report);
  for (const std::string& cap : report.bent_caps)
    text += "the cap \"" + cap + "\" is not flat, and therefore the end of the wall is not\n";
  return text;
}

}  // namespace tunica::mesh::wall
