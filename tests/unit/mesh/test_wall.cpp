#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <set>

#include "helpers.hpp"
#include "lumens.hpp"
#include "overlaps.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/info.hpp"
#include "tunica/mesh/validate.hpp"
#include "tunica/mesh/wall/grow.hpp"
#include "tunica/mesh/wall/local_radius.hpp"

using namespace tunica;
using namespace tunica::mesh;

namespace {

std::set<int> vertices_of(const Mesh& mesh, const std::string& surface) {
  std::set<int> result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.triangle_surface[t] == surface_index(mesh, surface))
      result.insert(mesh.triangles[t].begin(), mesh.triangles[t].end());
  return result;
}

const Info::Region& region(const Info& info, const std::string& name) {
  for (const Info::Region& each : info.regions)
    if (each.name == name) return each;
  throw Error("no region " + name);
}

double from_axis(const Vec3& x) { return std::hypot(x[0], x[1]); }

/// Everything that holds of every wall.
bool is_sound(const wall::Grown& grown, const wall::Options& options) {
  std::vector<std::string> layers;
  for (const auto& layer : options.layers) layers.push_back(layer.name);
  validate(grown.mesh, "wall");
  check_interface(grown.mesh, {"fluid"}, layers, {options.interface});
  return count_overlaps(grown.mesh) == 0 && grown.report.least_angle > 0.5;
}

TEUCHOS_UNIT_TEST(mesh_wall, around_a_straight_tube_is_the_ring_of_polygons) {
  const Tube t = lumen_tube();
  const wall::Options options = on_interface();
  const wall::Grown grown = wall::grow(make_tube(t), options);
  TEST_ASSERT(is_sound(grown, options));
  const Info info = inspect(grown.mesh);
  const auto ring = [&](double inner, double outer) {
    return t.length * 0.5 * t.around * std::sin(2.0 * pi / t.around) *
           (outer * outer - inner * inner);
  };
  const double r = t.radius;
  TEST_FLOATING_EQUALITY(region(info, "fluid").volume, ring(0.0, r), 1e-12);
  TEST_FLOATING_EQUALITY(region(info, "media").volume, ring(r, r + 0.26), 1e-10);
  TEST_FLOATING_EQUALITY(region(info, "adventitia").volume, ring(r + 0.26, r + 0.39), 1e-10);
  TEST_EQUALITY(info.euler(), 1);
  TEST_EQUALITY(info.pieces, 1);
  TEST_EQUALITY(grown.report.limited_vertices, 0);
  TEST_FLOATING_EQUALITY(grown.report.layers[0].least, 0.26, 1e-12);
  TEST_FLOATING_EQUALITY(grown.report.layers[1].most, 0.13, 1e-12);
  TEST_FLOATING_EQUALITY(grown.report.least_thickness, 0.39, 1e-12);
}

// Right-angled triangles with sides of 2 r sin(π/16) and 0.6 mm.

const double tube_width = std::sqrt(2.0 * lumen_tube().radius * std::sin(pi / 16.0) * 0.6);

TEUCHOS_UNIT_TEST(mesh_wall, chooses_elements_by_the_width_of_triangles) {
  wall::Options options = on_interface();
  const auto chosen = [&](const std::string& layers) {
    options.layers = wall::layers_from_text(layers);
    std::vector<int> elements;
    for (const auto& layer : wall::grow(make_tube(lumen_tube()), options).report.layers)
      elements.push_back(layer.elements);
    return elements;
  };
  TEST_ASSERT((chosen("media=0.26,adventitia=0.13") == std::vector<int>{2, 1}));
  TEST_ASSERT((chosen("media=0.26,adventitia=0.13:3") == std::vector<int>{2, 3}));
  TEST_ASSERT((chosen("media=0.9,adventitia=0.3") == std::vector<int>{6, 2}));
  TEST_ASSERT((chosen("media=0.2,adventitia=0.1") == std::vector<int>{2, 1}));  // to bend
  TEST_ASSERT((chosen("media=0.05,adventitia=0.05") == std::vector<int>{1, 1}));
}

TEUCHOS_UNIT_TEST(mesh_wall, names_flat_layers_and_their_cure) {
  wall::Options options = on_interface();
  const auto grown = [&](const std::string& layers) {
    options.layers = wall::layers_from_text(layers);
    return wall::grow(make_tube(lumen_tube()), options).report;
  };
  const auto has = [&](const wall::Report& report, const std::string& words) {
    return to_text(report).find(words) != std::string::npos;
  };
  wall::Report report = grown("media=0.2:8,adventitia=0.2:1");
  TEST_FLOATING_EQUALITY(report.mean_width, tube_width, 1e-12);
  TEST_FLOATING_EQUALITY(report.layers[0].mean_flatness, tube_width / 0.025, 1e-10);
  TEST_FLOATING_EQUALITY(report.layers[1].most_flatness, tube_width / 0.2, 1e-10);
  TEST_EQUALITY(report.layers[0].flat_part, 1.0);
  TEST_EQUALITY(report.layers[1].flat_part, 0.0);
  TEST_ASSERT(has(report, "\"media\" are flatter than 1 : 10"));
  TEST_ASSERT(has(report, "Give it 3 elements through it (media=THICKNESS:3)"));
  TEST_ASSERT(!has(report, "\"adventitia\" are"));
  report = grown("media=0.2:2,adventitia=0.03:1");
  TEST_ASSERT(has(report, "\"adventitia\" are flatter"));
  TEST_ASSERT(has(report, "tunica-mesh refine --times 1"));
}

TEUCHOS_UNIT_TEST(mesh_wall, has_names_and_flat_ends) {
  const Tube t = lumen_tube();
  const Mesh mesh = wall::grow(make_tube(t), on_interface()).mesh;
  TEST_ASSERT((names(mesh.regions) == std::set<std::string>{"fluid", "media", "adventitia"}));
  TEST_ASSERT(
      (names(mesh.surfaces) == std::set<std::string>{"inlet", "outlet", "interface", "layer",
                                                     "outer", "wall_inlet", "wall_outlet"}));
  for (const int v : vertices_of(mesh, "wall_inlet"))
    TEST_FLOATING_EQUALITY(1.0 + mesh.vertices[v][2], 1.0, 1e-13);
  for (const int v : vertices_of(mesh, "wall_outlet"))
    TEST_FLOATING_EQUALITY(mesh.vertices[v][2], t.length, 1e-13);
  for (const int v : vertices_of(mesh, "outer"))
    TEST_FLOATING_EQUALITY(from_axis(mesh.vertices[v]), t.radius + 0.39, 1e-10);
}

TEUCHOS_UNIT_TEST(mesh_wall, keeps_the_lumen_as_it_is) {
  const Mesh lumen = with_vectors(make_tube(lumen_tube()));
  const Mesh mesh = wall::grow(lumen, on_interface()).mesh;
  TEST_ASSERT(std::equal(lumen.vertices.begin(), lumen.vertices.end(), mesh.vertices.begin()));
  TEST_ASSERT(std::equal(lumen.tets.begin(), lumen.tets.end(), mesh.tets.begin()));
  TEST_ASSERT(std::equal(lumen.triangles.begin(), lumen.triangles.end(), mesh.triangles.begin()));
  TEST_EQUALITY(mesh.tet_vectors[0].values.size(), mesh.tets.size());
  TEST_ASSERT(mesh.tet_vectors[0].values.front() == lumen.tet_vectors[0].values.front());
  TEST_EQUALITY(norm(mesh.tet_vectors[0].values.back()), 0.0);
}

TEUCHOS_UNIT_TEST(mesh_wall, names_between_three_layers_are_theirs) {
  wall::Options options = on_interface();
  options.layers = wall::layers_from_text("intima=0.1,media=0.2:2,adventitia=0.1:1");
  options.interface = "endothelium";
  const Mesh mesh = wall::grow(make_tube(lumen_tube()), options).mesh;
  const std::set<std::string> found = names(mesh.surfaces);
  TEST_EQUALITY(found.count("intima-media") + found.count("media-adventitia"), 2u);
  TEST_EQUALITY(found.count("endothelium"), 1u);
  TEST_EQUALITY(found.count("layer") + found.count("interface"), 0u);
}

TEUCHOS_UNIT_TEST(mesh_wall, ends_in_the_plane_of_an_oblique_cap) {
  const auto sheared = [](const Vec3& x) { return Vec3{x[0], x[1], x[2] + 0.5 * x[0]}; };
  const Mesh lumen = moved(make_tube(lumen_tube()), sheared);
  const wall::Options options = on_interface();
  const wall::Grown grown = wall::grow(lumen, options);
  TEST_ASSERT(is_sound(grown, options));
  const Mesh& mesh = grown.mesh;
  for (const int v : vertices_of(mesh, "wall_inlet"))
    TEST_COMPARE(std::abs(mesh.vertices[v][2] - 0.5 * mesh.vertices[v][0]), <, 1e-12);
  for (const int v : vertices_of(mesh, "outer"))
    TEST_FLOATING_EQUALITY(from_axis(mesh.vertices[v]), lumen_tube().radius + 0.39, 0.05);
}

TEUCHOS_UNIT_TEST(mesh_wall, around_a_bend_is_as_thick_as_wanted) {
  const double bend = 5.0;
  Tube t = lumen_tube();
  t.axial = 24;
  t.length = bend * 2.0 * pi / 3.0;
  const wall::Options options = on_interface();
  const wall::Grown grown = wall::grow(bent(make_tube(t), bend), options);
  TEST_ASSERT(is_sound(grown, options));
  TEST_EQUALITY(grown.report.limited_vertices, 0);
  for (const int v : vertices_of(grown.mesh, "outer")) {
    const Vec3& x = grown.mesh.vertices[v];
    const double from_centre = std::hypot(std::hypot(x[0], x[2]) - bend, x[1]);
    TEST_FLOATING_EQUALITY(from_centre, t.radius + 0.39, 0.01);
  }
}

TEUCHOS_UNIT_TEST(mesh_wall, closes_the_eye_of_a_tight_bend_only_partly) {
  // The eye has a radius of 0.17 mm, less than the wall wants.
  const double bend = 1.6;
  Tube t = lumen_tube();
  t.axial = 24;
  t.length = bend * pi * 1.25;
  const wall::Options options = on_interface();
  const wall::Grown grown = wall::grow(bent(make_tube(t), bend), options);
  TEST_ASSERT(is_sound(grown, options));
  TEST_COMPARE(grown.report.limited_vertices, >, 0);
  TEST_COMPARE(grown.report.least_thickness, <, 0.17);
}

TEUCHOS_UNIT_TEST(mesh_wall, radius_of_tubes_is_found) {
  const Mesh tube = make_tube(lumen_tube());
  for (const double radius : wall::local_radius(wall::lumen_surface(tube, {"interface"})))
    TEST_FLOATING_EQUALITY(radius, 1.43, 1e-10);
  const double length = lumen_tube().length;
  const Mesh cone = moved(tube, [&](const Vec3& x) {
    const double s = 1.0 - 0.3 * x[2] / length;
    return Vec3{s * x[0], s * x[1], x[2]};
  });
  const wall::LumenSurface surface = wall::lumen_surface(cone, {"interface"});
  const std::vector<double> radius = wall::local_radius(surface);
  for (int v = 0; v < surface.vertices(); ++v)
    TEST_FLOATING_EQUALITY(radius[v], from_axis(surface.x[v]), 0.06);
}

TEUCHOS_UNIT_TEST(mesh_wall, fraction_is_of_the_radius_and_layers_are_shares) {
  wall::Options options = on_interface();
  options.thickness.fraction = 0.2;
  options.layers = wall::layers_from_text("media=2:2,adventitia=1");
  const wall::Grown grown = wall::grow(make_tube(lumen_tube()), options);
  TEST_FLOATING_EQUALITY(grown.report.layers[0].mean, 0.2 * 1.43 * 2.0 / 3.0, 1e-10);
  TEST_FLOATING_EQUALITY(grown.report.layers[1].mean, 0.2 * 1.43 / 3.0, 1e-10);
}

TEUCHOS_UNIT_TEST(mesh_wall, around_rough_lumens_has_no_inverted_element) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Mesh lumen = rough(make_tube(patient_tube()), seed, 0.2);
    const wall::Options options = on_interface();
    const wall::Grown grown = wall::grow(lumen, options);
    TEST_ASSERT(is_sound(grown, options));
    TEST_COMPARE(grown.report.least_thickness, >, 0.1);
  }
}

TEUCHOS_UNIT_TEST(mesh_wall, around_a_notch_is_limited_and_says_where) {
  // A slot of 0.5 mm: two walls of 0.39 mm have no room in it.
  const wall::Options options = on_interface();
  const wall::Grown grown = wall::grow(notched_block(), options);
  TEST_ASSERT(is_sound(grown, options));
  TEST_COMPARE(grown.report.limited_vertices, >, 0);
  TEST_ASSERT(!grown.report.limited.empty());
  const auto& place = grown.report.limited.front();
  TEST_COMPARE(place.least_thickness, <, 0.25);
  TEST_COMPARE(std::abs(place.place[0] - 2.0), <, 0.3);  // the slot
  TEST_ASSERT(place.is_dense);
}

TEUCHOS_UNIT_TEST(mesh_wall, vessels_beside_one_another_do_not_touch) {
  const Tube t = lumen_tube();
  const double gap = 0.3, shift = 2.0 * t.radius + gap;
  const wall::Options options = on_interface();
  const wall::Grown grown = wall::grow(two_of(make_tube(t), {shift, 0.0, 0.3}), options);
  TEST_ASSERT(is_sound(grown, options));
  TEST_COMPARE(grown.report.limited_vertices, >, 0);
  TEST_ASSERT(grown.report.limited.front().is_dense);
  TEST_COMPARE(grown.report.least_thickness, <, 0.15);
}

}  // namespace
