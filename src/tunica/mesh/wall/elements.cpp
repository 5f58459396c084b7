#include "tunica/mesh/wall/elements.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tunica::mesh::wall {

double width(const LumenSurface& surface, int triangle) {
  return std::sqrt(2.0 * norm(surface.area_vector(triangle)));
}

void choose_elements(const LumenSurface& surface, const std::vector<double>& thickness,
                     std::vector<Layer>& layers) {
  constexpr double usual = 4.0;
  constexpr int fewest_of_wall = 3;
  double mean_width = 0.0, shares = 0.0;
  const int n = static_cast<int>(surface.triangles.size());
  for (int t = 0; t < n; ++t) mean_width += width(surface, t) / n;
  const double mean_thickness =
      std::accumulate(thickness.begin(), thickness.end(), 0.0) / double(thickness.size());
  for (const Layer& layer : layers) shares += layer.thickness;
  const auto flatness = [&](const Layer& layer, int elements) {
    return elements * mean_width * shares / (layer.thickness * mean_thickness);
  };

  std::vector<Layer*> chosen;
  int of_wall = 0;
  for (Layer& layer : layers) {
    if (layer.elements == 0) {
      layer.elements = std::max(1, static_cast<int>(std::lround(usual / flatness(layer, 1))));
      chosen.push_back(&layer);
    }
    of_wall += layer.elements;
  }
  if (chosen.size() < layers.size()) return;
  for (; of_wall < fewest_of_wall; ++of_wall) {
    // where one more is least flat
    Layer* const next =
        *std::min_element(chosen.begin(), chosen.end(), [&](const Layer* a, const Layer* b) {
          return flatness(*a, a->elements + 1) < flatness(*b, b->elements + 1);
        });
    if (flatness(*next, next->elements + 1) > flattest) return;
    ++next->elements;
  }
}

}  // namespace tunica::mesh::wall
