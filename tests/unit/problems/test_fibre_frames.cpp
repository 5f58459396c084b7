#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/problems/fibre_frames.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "unit/mesh/helpers.hpp"
#include "unit/problems/lists.hpp"

namespace {

using namespace tunica;
using materials::Frame;
using test::SmallTube;

Teuchos::ParameterList options(const std::string& kind) {
  Teuchos::ParameterList list;
  list.set("kind", kind);
  return list;
}

std::vector<Frame> frames(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh) {
  return problems::fibre_frames(test::resolved(list, problems::fibre_frame_table()), mesh);
}

std::string complaint(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh) {
  try {
    frames(list, mesh);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

double degrees(const Vec3& a, const Vec3& b) {
  return std::atan2(norm(cross(a, b)), dot(a, b)) * 180.0 / std::acos(-1.0);
}

/// The largest angle between the directions of two sets of frames.
double largest_angle(const std::vector<Frame>& a, const std::vector<Frame>& b) {
  double largest = 0.0;
  for (std::size_t e = 0; e < a.size(); ++e)
    largest = std::max({largest, degrees(a[e].radial, b[e].radial),
                        degrees(a[e].circumferential, b[e].circumferential),
                        degrees(a[e].axial, b[e].axial)});
  return global_max(*test::world(), largest);
}

/// The wall of a tube with the given divisions of the circumference.
fields::FieldMesh wall_of(int around) {
  mesh::Tube tube = SmallTube::options();
  tube.around = around;
  tube.axial = around / 2;
  tube.media_layers = around / 8;
  const mesh::Mesh mesh = mesh::make_tube(tube);
  return fields::make_field_mesh(test::share_of(mesh, {true, false, false}), {1, 2});
}

TEUCHOS_UNIT_TEST(fibre_frames, frames_of_a_tube_are_those_of_cylinder_coordinates) {
  const SmallTube tube;
  const auto found = frames(options("tube"), tube.wall);
  for (std::size_t e = 0; e < found.size(); ++e) {
    Vec3 x{};
    for (const int a : tube.wall.tets[e]) x += 0.25 * tube.wall.x[a];
    const double r = std::hypot(x[0], x[1]);
    TEST_COMPARE(norm(found[e].radial - Vec3{x[0] / r, x[1] / r, 0}), <, 1e-14);
    TEST_COMPARE(norm(found[e].circumferential - Vec3{-x[1] / r, x[0] / r, 0}), <, 1e-14);
    TEST_COMPARE(norm(found[e].axial - Vec3{0, 0, 1}), <, 1e-14);
  }
}

TEUCHOS_UNIT_TEST(fibre_frames, an_axis_anywhere_is_followed) {
  SmallTube tube;
  const auto expected = frames(options("tube"), tube.wall);
  const Vec3 shift{3.0, -1.0, 2.0};
  const auto turn = [](const Vec3& x) { return Vec3{x[2], x[0], x[1]}; };  // z becomes x
  for (Vec3& x : tube.wall.x) x = turn(x) + shift;
  auto list = options("tube");
  test::set_vector(list, "axis point", shift + Vec3{5.0, 0, 0});
  test::set_vector(list, "axis direction", {2.5, 0, 0});
  auto found = frames(list, tube.wall);
  for (std::size_t e = 0; e < found.size(); ++e) {
    TEST_COMPARE(norm(found[e].radial - turn(expected[e].radial)), <, 1e-13);
    TEST_COMPARE(norm(found[e].circumferential - turn(expected[e].circumferential)), <, 1e-13);
    TEST_COMPARE(norm(found[e].axial - turn(expected[e].axial)), <, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(fibre_frames, harmonic_frames_of_a_tube_approach_its_own) {
  std::vector<double> angle;
  for (const int around : {8, 16, 32}) {
    const fields::FieldMesh wall = wall_of(around);
    angle.push_back(largest_angle(frames(options("laplace"), wall), frames(options("tube"), wall)));
    out << around << " around: " << angle.back() << " degrees\n";
  }
  TEST_COMPARE(angle[0], <, 2.0);
  TEST_COMPARE(angle[1], <, 1.0);
  TEST_COMPARE(angle[2], <, 0.6 * angle[1]);
}

TEUCHOS_UNIT_TEST(fibre_frames, harmonic_frames_follow_a_bent_vessel) {
  constexpr double bend = 6.0;  // radius of the arc that the axis becomes
  fields::FieldMesh wall = wall_of(16);
  const auto straight = frames(options("tube"), wall);
  std::vector<Frame> expected;
  const auto turned = [](const Vec3& v, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return Vec3{c * v[0] - s * v[2], v[1], s * v[0] + c * v[2]};
  };
  for (std::size_t e = 0; e < wall.tets.size(); ++e) {
    double z = 0.0;
    for (const int a : wall.tets[e]) z += 0.25 * wall.x[a][2];
    const Frame& f = straight[e];
    expected.push_back({turned(f.radial, z / bend), turned(f.circumferential, z / bend),
                        turned(f.axial, z / bend)});
  }
  for (Vec3& x : wall.x) x = turned({bend + x[0], x[1], 0.0}, x[2] / bend);
  const double angle = largest_angle(frames(options("laplace"), wall), expected);
  out << angle << " degrees\n";
  TEST_COMPARE(angle, <, 3.0);
}

TEUCHOS_UNIT_TEST(fibre_frames, frames_are_orthonormal_and_right_handed) {
  const SmallTube tube;
  for (const Frame& f : frames(options("laplace"), tube.wall)) {
    TEST_FLOATING_EQUALITY(det(Mat3{f.radial, f.circumferential, f.axial}), 1.0, 1e-13);
    TEST_COMPARE(std::abs(dot(f.radial, f.axial)), <, 1e-13);
    TEST_FLOATING_EQUALITY(norm(f.radial), 1.0, 1e-13);
    TEST_FLOATING_EQUALITY(norm(f.axial), 1.0, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(fibre_frames, harmonic_frames_follow_the_order_of_the_surfaces) {
  const SmallTube tube;
  const auto given = frames(options("laplace"), tube.wall);
  auto list = options("laplace");
  const auto one = [](const char* name) { return Teuchos::Array<std::string>(1, name); };
  list.set("inner surfaces", one("outer")).set("outer surfaces", one("interface"));
  list.set("start surfaces", one("struct_out")).set("end surfaces", one("struct_in"));
  list.sublist("Linear Solver").set("method", std::string("direct"));
  const auto turned = frames(list, tube.wall);
  for (std::size_t e = 0; e < given.size(); ++e) {
    TEST_COMPARE(norm(given[e].radial + turned[e].radial), <, 1e-8);
    TEST_COMPARE(norm(given[e].axial + turned[e].axial), <, 1e-8);
    TEST_COMPARE(norm(given[e].circumferential - turned[e].circumferential), <, 1e-8);
  }
}

TEUCHOS_UNIT_TEST(fibre_frames, frames_do_not_depend_on_the_ranks) {
  const SmallTube many, one(test::alone());
  auto direct = options("laplace");
  direct.sublist("Linear Solver").set("method", std::string("direct"));
  const auto expected = frames(direct, one.wall);
  const auto found = frames(options("laplace"), many.wall);
  double largest = 0.0;
  for (std::size_t e = 0; e < found.size(); ++e) {
    const auto& numbers = one.wall.tet_number;
    const auto same = std::find(numbers.begin(), numbers.end(), many.wall.tet_number[e]);
    const Frame& f = expected[same - numbers.begin()];
    largest = std::max({largest, norm(found[e].radial - f.radial), norm(found[e].axial - f.axial)});
  }
  TEST_COMPARE(largest, <, 1e-9);
}

TEUCHOS_UNIT_TEST(fibre_frames, an_element_without_directions_is_named_by_all_ranks_alike) {
  const SmallTube many, one(test::alone());
  const auto says = [](const std::string& text, const std::string& word) {
    return text.find(word) != std::string::npos;
  };
  Vec3 centre{};
  for (const int a : one.wall.tets[70]) centre += 0.25 * one.wall.x[a];
  auto on_axis = options("tube");
  test::set_vector(on_axis, "axis point", centre);
  const std::string text = complaint(on_axis, many.wall);
  TEST_ASSERT(says(
      text, "Wall / Fibre Frame: element " + std::to_string(one.wall.tet_number[70]) + " at ("));
  TEST_ASSERT(says(text, "no radial direction"));
  TEST_EQUALITY(text, complaint(on_axis, one.wall));

  auto parallel = options("laplace");  // both functions run along the tube
  parallel.set("inner surfaces", Teuchos::Array<std::string>(1, "struct_in"));
  parallel.set("outer surfaces", Teuchos::Array<std::string>(1, "struct_out"));
  TEST_ASSERT(says(complaint(parallel, many.wall), "no radial direction"));
}

/// A tube whose mesh has directions of its own on the elements.
struct TubeWithVectors {
  TubeWithVectors() {
    mesh::Mesh mesh = mesh::make_tube(SmallTube::options());
    mesh.tet_vectors = {{"out", {}}, {"fibres along", {}}};
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const Vec3 centre = mesh::centroid(mesh, t);
      mesh.tet_vectors[0].values.push_back({3.0 * centre[0], 3.0 * centre[1], 0.5});
      mesh.tet_vectors[1].values.push_back({0.0, 0.0, 2.0 + centre[2]});
    }
    wall = fields::make_field_mesh(test::share_of(mesh, {true, false, false}), {1, 2});
  }
  fields::FieldMesh wall;
};

TEUCHOS_UNIT_TEST(fibre_frames, vectors_of_the_mesh_are_taken_on_any_rank) {
  const TubeWithVectors tube;
  auto list = options("mesh");
  list.set("axial vectors", std::string("fibres along"));
  list.set("radial vectors", std::string("out"));
  TEST_COMPARE(largest_angle(frames(list, tube.wall), frames(options("tube"), tube.wall)), <, 1e-5);
}

TEUCHOS_UNIT_TEST(fibre_frames, vectors_that_the_mesh_does_not_have_are_named) {
  TubeWithVectors tube;
  auto list = options("mesh");
  list.set("axial vectors", std::string("fibres alon"));
  list.set("radial vectors", std::string("out"));
  TEST_ASSERT(complaint(list, tube.wall).find("\"fibres along\"") != std::string::npos);
  TEST_ASSERT(complaint(options("mesh"), SmallTube().wall).find("none at all") !=
              std::string::npos);
  list.set("axial vectors", std::string("out"));
  TEST_ASSERT(complaint(list, tube.wall).find("has no radial direction") != std::string::npos);
}

TEUCHOS_UNIT_TEST(fibre_frames, bad_input_is_refused) {
  const SmallTube tube;
  const auto refused = [&](Teuchos::ParameterList list, const std::string& word) {
    return complaint(list, tube.wall).find(word) != std::string::npos;
  };
  auto flat = options("tube");
  test::set_vector(flat, "axis direction", {0, 0, 0});
  TEST_ASSERT(refused(flat, "\"axis direction\" is zero"));
  auto unknown = options("laplace");
  unknown.set("outer surfaces", Teuchos::Array<std::string>(1, "outr"));
  TEST_ASSERT(refused(unknown, "Did you mean \"outer\"?"));
  auto both = options("laplace");
  both.set("outer surfaces", Teuchos::Array<std::string>(1, "interface"));
  TEST_ASSERT(refused(both, "\"interface\" is in both"));
  auto empty = options("laplace");
  empty.set("end surfaces", Teuchos::Array<std::string>());
  TEST_ASSERT(refused(empty, "\"end surfaces\" is empty"));
  TEST_ASSERT(refused(options("tub"), "tube"));
}

TEUCHOS_UNIT_TEST(fibre_frames, a_law_with_fibres_needs_a_frame_and_others_get_none) {
  const SmallTube tube;
  auto list = test::wall_list();
  list.sublist("Layers").sublist("media").set("law", std::string("holzapfel"));
  std::string text;
  try {
    test::resolved(list, problems::solid_table());
  } catch (const Error& error) {
    text = error.what();
  }
  TEST_ASSERT(text.find("has fibres") != std::string::npos);
  list.sublist("Fibre Frame").set("kind", std::string("tube"));
  const problems::SolidProblem with(test::resolved(list, problems::solid_table()), tube.wall);
  TEST_EQUALITY(with.field().elements().frames.size(), tube.wall.tets.size());
  list.sublist("Layers").sublist("media").set("law", std::string("neo-hookean"));
  const problems::SolidProblem without(test::resolved(list, problems::solid_table()), tube.wall);
  TEST_ASSERT(without.field().elements().frames.empty());
}

// All vertices of a single layer lie on one of its sides: nothing is left to solve between them.
TEUCHOS_UNIT_TEST(fibre_frames, one_layer_of_elements_is_enough) {
  mesh::Tube shape = SmallTube::options();
  shape.around = 24;
  shape.axial = 12;
  const mesh::Mesh mesh = mesh::make_tube(shape);
  const auto wall = fields::make_field_mesh(test::share_of(mesh, {true, false, false}), {1});
  auto list = options("laplace");
  list.set("outer surfaces", Teuchos::Array<std::string>({"layer"}));
  TEST_COMPARE(largest_angle(frames(list, wall), frames(options("tube"), wall)), <, 10.0);
}

}  // namespace
