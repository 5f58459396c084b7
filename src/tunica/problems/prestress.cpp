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
  params::Table table("The stress that the wall has in the geometry of the mesh.");
  table
      .number(
          "pressure", 0.0, params::any(), "kPa",
          "in the lumen of the vessel when it was imaged; 0: the mesh is free of stress. 80 mmHg "
          "are 10.67 kPa")
      .names("surfaces", std::vector<std::string>{"interface"},
             "that bear this pressure; pressures that the case itself gives them begin with the "
             "run")
      .choice("method", "deformation gradient", {"deformation gradient", "stress-free shape"},
              "what is found: a deformation gradient for each element, which need not come from "
              "any shape; or that of a shape without stress, which soft forks do not have")
      .integer(
          "load steps", 8, params::Range{1.0, 1000.0},
          "in which the loads are raised at first; where one fails it is halved, where it does "
          "not the next is longer")
      .number("tolerance", 1e-3, params::Range{0.0, 0.1, true, false}, "1",
              "how far the wall may still be off the mesh, in parts of the vessel's radius: the "
              "largest step of the search")
      .number("linear tolerance", 1e-3, params::Range{0.0, 1.0, true, true}, "1",
              "reduction of the linear residual in each step of the search: what is left is out of "
              "balance in the next one")
      .integer("max iterations", 100, params::Range{1.0, 10000.0}, "at all of the load");
  return table;
}

}  // namespace tunica::problems
