#include "tunica/problems/prestress.hpp"

#include <Teuchos_Array.hpp>

#include "tunica/problems/prestress_search.hpp"

namespace tunica::problems {

PrestressOptions prestress_options(const Teuchos::ParameterList& list) {
  PrestressOptions options;
  options.pressure = list.get<double>("pressure");
  if (options.pressure != 0.0)
    options.surfaces = list.get<Teuchos::Array<std::string>>("surfaces").toVector();
  options.is_by_shape = list.get<std::string>("method") == "stress-free shape";
  options.may_lean = list.get<std::string>("tissue") == "where needed";
  options.load_steps = list.get<int>("load steps");
  options.max_iterations = list.get<int>("max iterations");
  options.tolerance = list.get<double>("tolerance");
  options.linear_tolerance = list.get<double>("linear tolerance");
  return options;
}

Result<Prestress> find_prestress(const SolidSettings& settings, const SolidProblem& wall,
                                 const PrestressWatch& watch, const PrestressPoint& from) {
  return PrestressSearch(settings, wall, watch, from).run();
}

params::Table prestress_table() {
  params::Table table("Stress of the wall in the geometry of the mesh, as it was imaged.");
  table
      .number("pressure", 0.0, params::any(), "kPa",
              "pressure in the lumen when the vessel was imaged; 0: the mesh is stress-free. 80 "
              "mmHg are 10.67 kPa")
      .names("surfaces", std::vector<std::string>{"interface"},
             "surfaces that bear this pressure; pressures that the case itself prescribes there "
             "begin with the run")
      .choice("method", "deformation gradient", {"deformation gradient", "stress-free shape"},
              "unknown of the search: a deformation gradient for each element, which need not "
              "belong to any shape; or a stress-free shape, which does not exist for soft forks")
      .choice("tissue", "where needed", {"where needed", "relaxed"},
              "springs of the tissue in the geometry of the mesh: relaxed, so that the wall alone "
              "bears the loads; or stretched where it cannot, so that they hold the rest")
      .integer("load steps", 8, params::Range{1.0, 1000.0},
               "initial number of load increments; an increment that fails is halved, and after a "
               "success the next one is larger")
      .number("tolerance", 1e-3, params::Range{0.0, 0.1, true, false}, "1",
              "permitted distance of the wall from the mesh, relative to the radius of the vessel: "
              "the largest step of the search")
      .number("linear tolerance", 1e-3, params::Range{0.0, 1.0, true, true}, "1",
              "relative tolerance of the linear system in each step of the search; the remaining "
              "residual is out of balance in the next one")
      .integer("max iterations", 100, params::Range{1.0, 10000.0}, "cap on the steps at full load");
  return table;
}

}  // namespace tunica::problems
