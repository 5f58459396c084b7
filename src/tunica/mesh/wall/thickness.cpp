#include "tunica/mesh/wall/thickness.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/io/hdf5_arrays.hpp"
#include "tunica/mesh/formats/text_scanner.hpp"
#include "tunica/mesh/text.hpp"
#include "tunica/mesh/wall/box_tree.hpp"
#include "tunica/mesh/wall/local_radius.hpp"

namespace tunica::mesh::wall {
namespace {

constexpr int most_elements = 1000;

template <typename Number>
bool read_number(const std::string& text, Number& value) {
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc() && end == text.data() + text.size();
}

Layer layer_from_text(const std::string& word) {
  const auto fail = [&](const std::string& what) {
    throw Error(
        "wall: layer \"" + word + "\": " + what +
        ". Expected NAME=THICKNESS:ELEMENTS, for instance media=0.26:2, or NAME=THICKNESS.");
  };
  const std::size_t equals = word.find('='), colon = word.find(':', equals);
  if (equals == std::string::npos || equals == 0) fail("it has no name or no \"=\"");
  Layer layer{word.substr(0, equals), 0.0, 0};
  const std::string number = word.substr(equals + 1, colon - equals - 1);
  if (!read_number(number, layer.thickness)) fail("its thickness \"" + number + "\" is no number");
  if (!(layer.thickness > 0.0) || !std::isfinite(layer.thickness))
    fail("its thickness is " + number + ", not positive");
  if (colon != std::string::npos && !read_number(word.substr(colon + 1), layer.elements))
    fail("its number of elements \"" + word.substr(colon + 1) + "\" is no integer");
  if (colon != std::string::npos && (layer.elements < 1 || layer.elements > most_elements))
    fail("it has " + std::to_string(layer.elements) + " elements through it, not 1.." +
         std::to_string(most_elements));
  return layer;
}

/// Thickness at points.
struct Samples {
  std::vector<Vec3> points;
  std::vector<double> values;
};

Samples read_hdf5_samples(const std::string& path) {
  const io::Hdf5Reader in(path);
  const std::vector<double> points = in.reals("points", 3);
  Samples samples{{}, in.reals("thickness", 1)};
  for (std::size_t i = 0; i + 2 < points.size(); i += 3)
    samples.points.push_back({points[i], points[i + 1], points[i + 2]});
  TUNICA_CHECK(samples.points.size() == samples.values.size(),
               path + ": /thickness has " + std::to_string(samples.values.size()) +
                   " values, expected " + std::to_string(samples.points.size()) +
                   " as /points has rows");
  return samples;
}

Samples read_text_samples(const std::string& path) {
  TextScanner in(path, '#');
  Samples samples;
  while (!in.is_at_end()) {
    Vec3 point;
    for (double& x : point) x = in.real("the coordinates of a point");
    samples.points.push_back(point);
    samples.values.push_back(in.real("the thickness at the point"));
  }
  return samples;
}

Samples read_samples(const std::string& path) {
  const bool is_hdf5 = path.size() > 3 && path.compare(path.size() - 3, 3, ".h5") == 0;
  Samples samples = is_hdf5 ? read_hdf5_samples(path) : read_text_samples(path);
  TUNICA_CHECK(!samples.points.empty(), path + ": no points, expected \"x y z thickness\"");
  for (std::size_t i = 0; i < samples.values.size(); ++i)
    TUNICA_CHECK(samples.values[i] > 0.0 && std::isfinite(samples.values[i]),
                 path + ": the thickness at " + show(samples.points[i]) + " is " +
                     show(samples.values[i]) + ", expected a positive number");
  return samples;
}

/// Mean of the nearest samples, weighted by 1/distance².
double interpolate(const BoxTree& tree, const Samples& samples, const Vec3& x) {
  constexpr std::size_t most = 4;
  std::set<std::pair<double, int>> nearest;
  const auto reach = [&] {
    return nearest.size() < most ? std::numeric_limits<double>::max() : nearest.rbegin()->first;
  };
  tree.search(
      x, [&](const Box& box) { return box.distance2(x) <= reach(); },
      [&](int i) {
        const Vec3 d = samples.points[i] - x;
        nearest.insert({dot(d, d), i});
        if (nearest.size() > most) nearest.erase(std::prev(nearest.end()));
      });
  double sum = 0.0, weights = 0.0;
  for (const auto& [distance2, i] : nearest) {
    const double weight = 1.0 / std::max(distance2, 1e-20);
    sum += weight * samples.values[i];
    weights += weight;
  }
  return sum / weights;
}

std::vector<double> from_file(const LumenSurface& surface, const std::string& path) {
  const Samples samples = read_samples(path);
  std::vector<Box> boxes;
  for (const Vec3& point : samples.points) boxes.push_back({point, point});
  const BoxTree tree(boxes);
  std::vector<double> thickness;
  for (const Vec3& x : surface.x) thickness.push_back(interpolate(tree, samples, x));
  return thickness;
}

void check_positive(double value, const std::string& what) {
  TUNICA_CHECK(value > 0.0 && std::isfinite(value),
               "wall: " + what + " is " + show(value) + ", expected a positive number");
}

}  // namespace

std::vector<Layer> layers_from_text(const std::string& text) {
  std::vector<Layer> layers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    layers.push_back(layer_from_text(text.substr(at, end - at)));
    at = end + 1;
  }
  return layers;
}

std::vector<double> wall_thickness(const LumenSurface& surface, const std::vector<Layer>& layers,
                                   const Thickness& rule) {
  const int given =
      int(rule.uniform.has_value()) + int(rule.fraction.has_value()) + int(!rule.file.empty());
  TUNICA_CHECK(given <= 1, "wall: the thickness is given in " + std::to_string(given) +
                               " ways, expected one of uniform, fraction and file");
  if (!rule.file.empty()) return from_file(surface, rule.file);
  if (rule.fraction) {
    check_positive(*rule.fraction, "the fraction of the lumen's radius");
    std::vector<double> thickness = local_radius(surface);
    for (double& value : thickness) value *= *rule.fraction;
    return thickness;
  }
  double uniform = 0.0;
  for (const Layer& layer : layers) uniform += layer.thickness;
  if (rule.uniform) uniform = *rule.uniform;
  check_positive(uniform, "the thickness");
  return std::vector<double>(surface.x.size(), uniform);
}

}  // namespace tunica::mesh::wall
