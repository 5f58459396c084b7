#pragma once
#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/coupling/registry.hpp"
#include "tunica/problems/coupled_problem.hpp"
#include "unit/problems/lists.hpp"

namespace tunica::test {

/// A tube with both fields: pressure at the inlet, a windkessel at the outlet, a clamped wall.
struct CoupledTube {
  /// outer: the condition of the wall's outer surface.
  explicit CoupledTube(const std::string& geometry, const std::string& end = "clamped",
                       const CommPtr& comm = world(), const std::string& outer = "")
      : tube(comm), mesh(fields::make_field_mesh(tube.share, {0, 1, 2})),
        interface(tube.fluid, tube.wall, {tube.surface("interface")}),
        fluid(fluid_list(), tube.fluid), wall(wall_list(end, outer), tube.wall),
        motion(motion_list(), tube.fluid, {tube.surface("interface")},
               fluid.field().staying_surfaces(), fluid.time_scheme()),
        problem(coupling_list(geometry), {mesh, interface, fluid, wall, motion}) {}

  static Teuchos::ParameterList fluid_list() {
    auto list = test::fluid_list(1.0, 3.5e-3);
    auto& inlet = condition(list, "inlet", "pressure");
    inlet.set("pressure", 1.3);
    inlet.set("backflow stabilisation", 0.5);
    auto& outlet = condition(list, "outlet", "windkessel");
    outlet.set("proximal resistance", 2.0);
    outlet.set("distal resistance", 20.0);
    outlet.set("capacitance", 0.1);
    condition(list, "interface", "interface");
    return resolved(list, problems::fluid_table());
  }

  static Teuchos::ParameterList wall_list(const std::string& end, const std::string& outside = "") {
    auto list = test::wall_list();
    list.sublist("Layers").sublist("media").set("law", std::string("mooney-rivlin"));
    auto& outer = list.sublist("Layers").sublist("adventitia");
    outer.set("law", std::string("mooney-rivlin"));
    outer.set("c10", 5.0);
    const bool slides = end == "held";  // both ends, in their planes
    for (const auto& [name, kind] : {std::pair("struct_in", slides ? end : std::string("clamped")),
                                     std::pair("struct_out", end)}) {
      auto& surface = condition(list, name, kind);
      if (slides) surface.set("components", Teuchos::Array<std::string>(1, "normal"));
    }
    if (!outside.empty()) condition(list, "outer", outside);
    condition(list, "interface", "interface");
    return resolved(list, problems::solid_table());
  }

  static Teuchos::ParameterList motion_list() {
    Teuchos::ParameterList list;
    list.sublist("Linear Solver").set("method", std::string("direct"));
    return resolved(list, problems::mesh_motion_table());
  }

  static Teuchos::ParameterList coupling_list(const std::string& geometry) {
    Teuchos::ParameterList list;
    list.set("scheme", std::string("monolithic"));
    list.set("geometry", geometry);
    list.sublist("Linear Solver").set("method", std::string("direct"));
    return resolved(list, coupling::coupling_table());
  }

  /// Numbers without pattern, small enough that no element inverts, and zero at the
  /// ends, or along their normal.
  algebra::BlockVector point(int seed, bool slides = false) const {
    algebra::BlockVector x(problem.space());
    const auto y = x[0].getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (int a = 0; a < mesh.n_owned; ++a)
      for (int i = 0; i < 3; ++i)
        y(3 * a + i, 0) =
            is_held(mesh.x[a]) && (i == 2 || !slides) ? 0.0 : 0.1 * number(a, i, seed);
    const auto p = x[1].getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t a = 0; a < p.extent(0); ++a)
      p(a, 0) = scatter(31.7 * seed +
                        static_cast<double>(x[1].getMap()->getGlobalElement(static_cast<int>(a))));
    return x;
  }
  static bool is_held(const Vec3& x) { return x[2] == 0.0 || x[2] == SmallTube::options().length; }
  double number(int a, int i, int seed) const {
    return scatter(1000.0 * seed + 4.0 * mesh.vertex[a] + i);
  }

  SmallTube tube;
  fields::FieldMesh mesh;
  fields::InterfaceTransfer interface;
  problems::FluidProblem fluid;
  problems::SolidProblem wall;
  problems::MeshMotion motion;
  problems::CoupledProblem problem;
};

}  // namespace tunica::test
