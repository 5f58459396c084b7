#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "helpers.hpp"
#include "lumens.hpp"
#include "tunica/io/hdf5_arrays.hpp"
#include "tunica/mesh/wall/grow.hpp"

using namespace tunica;
using namespace tunica::mesh;

namespace {

TEUCHOS_UNIT_TEST(mesh_wall_input, layers_are_read) {
  const auto layers = wall::layers_from_text("media=0.26:2,adventitia=0.13");
  TEST_EQUALITY(layers.size(), 2u);
  TEST_EQUALITY(layers[0].name, "media");
  TEST_EQUALITY(layers[0].thickness, 0.26);
  TEST_EQUALITY(layers[0].elements, 2);
  TEST_EQUALITY(layers[1].elements, 0);  // to be chosen
}

TEUCHOS_UNIT_TEST(mesh_wall_input, bad_layers_are_named) {
  const auto fails = [&](const std::string& text, const std::string& part) {
    return fails_with(part, out, [&] { wall::layers_from_text(text); });
  };
  TEST_ASSERT(fails("", "no name"));
  TEST_ASSERT(fails("media", "no \"=\""));
  TEST_ASSERT(fails("=0.2:1", "no name"));
  TEST_ASSERT(fails("media=0.2:2,", "layer \"\""));
  TEST_ASSERT(fails("media=thick:2", "\"thick\" is no number"));
  TEST_ASSERT(fails("media=-0.2:2", "not positive"));
  TEST_ASSERT(fails("media=nan:2", "not positive"));
  TEST_ASSERT(fails("media=0.2:two", "\"two\" is no integer"));
  TEST_ASSERT(fails("media=0.2:0", "0 elements"));
}

TEUCHOS_UNIT_TEST(mesh_wall_input, bad_options_are_named) {
  const Mesh lumen = make_tube(lumen_tube());
  const auto fails = [&](const std::string& part, auto change) {
    wall::Options options = on_interface();
    change(options);
    return fails_with(part, out, [&] { wall::grow(lumen, options); });
  };
  using Options = wall::Options;
  TEST_ASSERT(fails("no surface \"lumen_wall\"", [](Options& o) { o.surfaces = {"lumen_wall"}; }));
  TEST_ASSERT(fails("no surface is named", [](Options& o) { o.surfaces.clear(); }));
  TEST_ASSERT(fails("thickness is -0.4", [](Options& o) { o.thickness.uniform = -0.4; }));
  TEST_ASSERT(fails("radius is 0", [](Options& o) { o.thickness.fraction = 0.0; }));
  TEST_ASSERT(fails("given in 2 ways", [](Options& o) {
    o.thickness.uniform = 0.4;
    o.thickness.fraction = 0.1;
  }));
  TEST_ASSERT(fails("a region \"fluid\" already", [](Options& o) { o.layers[0].name = "fluid"; }));
  TEST_ASSERT(fails("two surfaces are named \"inlet\"", [](Options& o) { o.interface = "inlet"; }));
  TEST_ASSERT(fails("no layers", [](Options& o) { o.layers.clear(); }));
}

TEUCHOS_UNIT_TEST(mesh_wall_input, mesh_with_a_wall_is_refused) {
  TEST_ASSERT(fails_with("between two tetrahedra", out,
                         [] { wall::grow(make_tube(smallest_tube()), on_interface()); }));
}

TEUCHOS_UNIT_TEST(mesh_wall_input, vessels_that_all_but_touch_are_refused_with_the_place) {
  const Mesh lumen = two_of(make_tube(lumen_tube()), {2.0 * 1.43 + 1e-4, 0.0, 0.0});
  TEST_ASSERT(
      fails_with("no wall can grow at (1.43, 0,", out, [&] { wall::grow(lumen, on_interface()); }));
}

/// Thickness that grows along the tube, at the vertices of its surface.
double rising(const Vec3& x) { return 0.2 + 0.02 * x[2]; }

bool follows(const Mesh& lumen, const std::string& file) {
  const wall::LumenSurface surface = wall::lumen_surface(lumen, {"interface"});
  wall::Thickness rule;
  rule.file = file;
  const std::vector<double> found = wall::wall_thickness(surface, on_interface().layers, rule);
  for (int v = 0; v < surface.vertices(); ++v)
    if (std::abs(found[v] - rising(surface.x[v])) > 1e-6) return false;
  return true;
}

TEUCHOS_UNIT_TEST(mesh_wall_input, thickness_comes_from_files) {
  const Mesh lumen = make_tube(lumen_tube());
  const wall::LumenSurface surface = wall::lumen_surface(lumen, {"interface"});
  const TemporaryFile text("thickness.txt"), hdf5("thickness.h5");
  std::ostringstream lines;
  lines.precision(17);
  lines << "# x y z thickness\n";
  std::vector<double> values;
  for (const Vec3& x : surface.x) {
    lines << x[0] << " " << x[1] << " " << x[2] << " " << rising(x) << "\n";
    values.push_back(rising(x));
  }
  text.fill(lines.str());
  io::Hdf5Writer writer(hdf5.path);
  writer.write("points", surface.x[0].data(), surface.x.size(), 3);
  writer.write("thickness", values.data(), values.size());
  writer.save();
  TEST_ASSERT(follows(lumen, text.path));
  TEST_ASSERT(follows(lumen, hdf5.path));
}

TEUCHOS_UNIT_TEST(mesh_wall_input, bad_files_are_named) {
  wall::Options options = on_interface();
  const TemporaryFile text("thickness-bad.txt");
  options.thickness.file = text.path;
  const auto fails = [&](const std::string& content, const std::string& part) {
    text.fill(content);
    return fails_with(part, out, [&] { wall::grow(make_tube(lumen_tube()), options); });
  };
  TEST_ASSERT(fails("# nothing\n", "no points"));
  TEST_ASSERT(fails("0 0 0 0.3\n1 2 3 -0.3\n", "thickness at (1, 2, 3) is -0.3"));
  TEST_ASSERT(fails("0 0 0 0.3\n1 2 3\n", "the thickness at the point"));
}

}  // namespace
