#include "tunica/mesh/wall/grow.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/validate.hpp"
#include "tunica/mesh/wall/elements.hpp"
#include "tunica/mesh/wall/limit.hpp"
#include "tunica/mesh/wall/report.hpp"

namespace tunica::mesh::wall {
namespace {

int next_id(const std::vector<Tag>& tags) {
  int id = 0;
  for (const Tag& tag : tags) id = std::max(id, tag.id);
  return id + 1;
}

void check_layers(const std::vector<Layer>& layers) {
  TUNICA_CHECK(!layers.empty(), "wall: no layers, expected at least one");
  for (const Layer& layer : layers)
    TUNICA_CHECK(!layer.name.empty() && layer.thickness > 0.0 && layer.elements >= 0,
                 "wall: layer \"" + layer.name + "\" has no name or no thickness");
}

/// Triangles of the lumen's boundary beside the wall.
std::vector<Corners> caps(const Mesh& lumen, const LumenSurface& surface) {
  const std::set<int> wall(surface.mesh_triangle.begin(), surface.mesh_triangle.end());
  std::vector<Corners> result;
  for (std::size_t t = 0; t < lumen.triangles.size(); ++t) {
    const auto& v = lumen.triangles[t];
    if (wall.count(static_cast<int>(t)) == 0)
      result.push_back({lumen.vertices[v[0]], lumen.vertices[v[1]], lumen.vertices[v[2]]});
  }
  return result;
}

/// Puts the planned wall behind the lumen.
class Assembly {
public:
  Assembly(const Mesh& lumen, const Plan& plan, const Options& options)
      : plan_(plan), options_(options), mesh_(lumen),
        first_(static_cast<int>(lumen.vertices.size())) {
    rename_interface();
    for (int level = 1; level <= plan.steps(); ++level)
      for (int v = 0; v < plan.surface.vertices(); ++v)
        mesh_.vertices.push_back(plan.place(v, plan.heights[level]));
    add_tets();
    add_level_surfaces();
    add_ends();
    for (TetVectors& vectors : mesh_.tet_vectors) vectors.values.resize(mesh_.tets.size(), Vec3{});
  }

  Mesh take() { return std::move(mesh_); }

private:
  /// From a number of the wall to one of the mesh: the lowest level is the lumen's.
  int vertex(int number) const {
    const int n = plan_.surface.vertices();
    return number < n ? plan_.surface.mesh_vertex[number] : first_ + number - n;
  }

  /// The interface takes the place of the first of the surfaces, the others go.
  void rename_interface() {
    std::vector<bool> is_wall(mesh_.surfaces.size(), false);
    for (const std::string& name : options_.surfaces) is_wall[surface_index(mesh_, name)] = true;
    std::vector<int> position;
    std::vector<Tag> kept;
    int interface = -1;
    for (std::size_t s = 0; s < mesh_.surfaces.size(); ++s) {
      const bool is_kept = !is_wall[s] || interface < 0;
      position.push_back(is_kept ? static_cast<int>(kept.size()) : interface);
      if (!is_kept) continue;
      kept.push_back(mesh_.surfaces[s]);
      if (!is_wall[s]) continue;
      interface = position.back();
      kept.back().name = options_.interface;
    }
    mesh_.surfaces = kept;
    for (int& surface : mesh_.triangle_surface) surface = position[surface];
    cap_position_ = position;
  }

  int add_tag(std::vector<Tag>& tags, const std::string& name, const std::string& kind) {
    for (const Tag& tag : tags)
      TUNICA_CHECK(tag.name != name, "wall: the lumen has a " + kind + " \"" + name +
                                         "\" already, which is the name of a part of the wall. "
                                         "Give a mesh of the lumen alone, or rename it.");
    tags.push_back({next_id(tags), name});
    return static_cast<int>(tags.size()) - 1;
  }

  void add_triangle(const std::array<int, 3>& numbers, int surface) {
    mesh_.triangles.push_back({vertex(numbers[0]), vertex(numbers[1]), vertex(numbers[2])});
    mesh_.triangle_surface.push_back(surface);
  }

  void add_tets() {
    std::vector<int> region;
    for (const Layer& layer : options_.layers)
      region.push_back(add_tag(mesh_.regions, layer.name, "region"));
    for (int level = 0; level < plan_.steps(); ++level)
      for (std::size_t t = 0; t < plan_.surface.triangles.size(); ++t)
        for (const auto& tet : prism(plan_.surface, static_cast<int>(t), level)) {
          mesh_.tets.push_back({vertex(tet[0]), vertex(tet[1]), vertex(tet[2]), vertex(tet[3])});
          mesh_.tet_region.push_back(region[plan_.layer[level]]);
        }
  }

  /// The outer side, and where one layer ends and the next begins.
  void add_level_surfaces() {
    const auto& layers = options_.layers;
    for (int level = 1; level <= plan_.steps(); ++level) {
      const bool is_outer = level == plan_.steps();
      if (!is_outer && plan_.layer[level] == plan_.layer[level - 1]) continue;
      const std::string name = is_outer             ? "outer"
                               : layers.size() == 2 ? "layer"
                                                    : layers[plan_.layer[level - 1]].name + "-" +
                                                          layers[plan_.layer[level]].name;
      const int surface = add_tag(mesh_.surfaces, name, "surface");
      const int low = level * plan_.surface.vertices();
      for (const auto& v : plan_.surface.triangles)
        add_triangle({low + v[0], low + v[1], low + v[2]}, surface);
    }
  }

  void add_ends() {
    std::map<int, int> end_of_cap;
    for (const auto& edge : plan_.surface.rim) {
      const int cap = cap_position_[edge.cap];
      if (end_of_cap.count(cap) == 0)
        end_of_cap[cap] = add_tag(mesh_.surfaces, "wall_" + mesh_.surfaces[cap].name, "surface");
      for (int level = 0; level < plan_.steps(); ++level)
        for (const auto& triangle : side(plan_.surface, edge.vertices, level))
          add_triangle(triangle, end_of_cap[cap]);
    }
  }

  const Plan& plan_;
  const Options& options_;
  Mesh mesh_;
  int first_;                      ///< number of the first vertex of the wall
  std::vector<int> cap_position_;  ///< of the lumen's surfaces among those of the result
};

}  // namespace

Grown grow(const Mesh& lumen, const Options& wanted) {
  check_layers(wanted.layers);
  const LumenSurface surface = lumen_surface(lumen, wanted.surfaces);
  const std::vector<double> thickness = wall_thickness(surface, wanted.layers, wanted.thickness);
  Options options = wanted;
  choose_elements(surface, thickness, options.layers);
  Plan plan(surface, options.layers, thickness);
  limit(plan, caps(lumen, surface));
  Mesh mesh = Assembly(lumen, plan, options).take();
  validate(mesh, "wall");
  Report report = make_report(mesh, plan, options);
  return {std::move(mesh), std::move(report)};
}

}  // namespace tunica::mesh::wall
