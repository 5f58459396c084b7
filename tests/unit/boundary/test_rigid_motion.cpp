#include <Teuchos_Array.hpp>
#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/boundary/rigid_motion.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using Names = std::vector<std::string>;

boundary::Condition condition(const std::string& surface, Teuchos::ParameterList list) {
  boundary::condition_table("", boundary::wall_conditions()).resolve(list, surface, "");
  return {surface, list};
}

boundary::Condition held(const std::string& surface, const Names& components) {
  Teuchos::ParameterList list;
  list.set("condition", "held").set("components", Teuchos::Array<std::string>(components));
  return condition(surface, list);
}

boundary::Condition support(const std::string& surface, const std::string& direction,
                            double stiffness) {
  Teuchos::ParameterList list;
  list.set("condition", "support").set("direction", direction).set("stiffness", stiffness);
  return condition(surface, list);
}

boundary::Condition one_word(const std::string& surface, const std::string& kind) {
  Teuchos::ParameterList list;
  list.set("condition", kind);
  return condition(surface, list);
}

TEUCHOS_UNIT_TEST(rigid_motion, what_nothing_holds_is_named) {
  const test::SmallTube tube;  // along z
  const auto free = [&](const std::vector<boundary::Condition>& conditions) {
    const boundary::SurfaceTerms terms(conditions, boundary::wall_conditions(), tube.wall);
    return boundary::free_rigid_motions(terms, tube.wall);
  };
  const std::string in_planes = "sliding in x and y, and turning about z";
  TEST_EQUALITY(free({}), "sliding in x, y and z, and turning about x, y and z");
  TEST_EQUALITY(free({one_word("interface", "interface"), one_word("struct_in", "clamped")}), "");
  TEST_EQUALITY(free({held("struct_in", {"normal"}), held("struct_out", {"normal"})}), in_planes);
  TEST_EQUALITY(free({held("struct_in", {"x", "z"}), held("struct_out", {"z"})}), "sliding in y");
  TEST_EQUALITY(free({held("struct_in", {"x", "y"}), held("struct_out", {"x", "y"})}),
                "sliding in z");
  TEST_EQUALITY(free({support("struct_in", "normal", 5.0)}), in_planes);
  TEST_EQUALITY(free({support("struct_in", "all", 5.0)}), "");
  TEST_EQUALITY(free({support("struct_in", "all", 0.0), held("struct_out", {"z"})}), in_planes);
  // An end that moves as one does not turn.
  TEST_EQUALITY(free({one_word("struct_in", "moves as one")}), "sliding in x, y and z");
  TEST_EQUALITY(free({one_word("struct_in", "moves as one"), held("struct_out", {"normal"})}),
                "sliding in x and y");
}

TEUCHOS_UNIT_TEST(rigid_motion, directions_across_the_axes_are_named_by_vectors) {
  const test::SmallTube tube;
  fields::FieldMesh turned = tube.wall;  // by 45 degrees about y: its axis lies along (1, 0, 1)
  const double c = std::sqrt(0.5);
  for (Vec3& x : turned.x) x = {c * (x[0] + x[2]), x[1], c * (x[2] - x[0])};
  const boundary::SurfaceTerms terms(
      {held("struct_in", {"normal"}), held("struct_out", {"x", "y"})}, boundary::wall_conditions(),
      turned);
  const std::string free = boundary::free_rigid_motions(terms, turned);
  TEST_EQUALITY(free, "");
  const boundary::SurfaceTerms one_end({held("struct_in", {"normal"})}, boundary::wall_conditions(),
                                       turned);
  const std::string along = boundary::free_rigid_motions(one_end, turned);
  out << along << "\n";
  TEST_INEQUALITY(along.find("turning about ("), std::string::npos);
  TEST_INEQUALITY(along.find("0.71"), std::string::npos);
}

}  // namespace
