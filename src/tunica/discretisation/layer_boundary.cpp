#include "tunica/discretisation/layer_boundary.hpp"

#include <algorithm>

namespace tunica::discretisation {

// Layers of the same law and constants share the number of the first of them.
std::vector<int> material_of_regions(const std::vector<Layer>& layers,
                                     const fields::FieldMesh& mesh) {
  std::vector<int> materials(mesh.regions.size(), -1);
  for (const Layer& layer : layers) {
    const auto region = std::find(mesh.regions.begin(), mesh.regions.end(), layer.region);
    const auto first = std::find_if(layers.begin(), layers.end(), [&layer](const Layer& other) {
      return other.has_material_of(layer);
    });
    materials[region - mesh.regions.begin()] = static_cast<int>(first - layers.begin());
  }
  return materials;
}

// A ghost node's elements are not all here: its owner says whether it lies on a boundary.
std::vector<char> at_layer_boundary(const fields::FieldMesh& mesh,
                                    const std::vector<int>& material) {
  std::vector<int> found(mesh.n_nodes(), -1);
  std::vector<Vec3> is_between(mesh.n_nodes());  // the first component is the flag
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    for (const int a : mesh.tets[e]) {
      const int here = material[mesh.region[e]];
      if (found[a] >= 0 && found[a] != here) is_between[a][0] = 1.0;
      found[a] = here;
    }
  is_between = fields::ghosted_vectors(mesh, is_between);
  std::vector<char> flags;
  for (const auto& nodes : mesh.tets)
    flags.push_back(
        std::any_of(nodes.begin(), nodes.end(), [&](int a) { return is_between[a][0] > 0.5; }));
  return flags;
}

}  // namespace tunica::discretisation
