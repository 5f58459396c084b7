#include "tunica/linear/solvers/fallbacks.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"
#include "tunica/params/nearest.hpp"

namespace tunica::linear {

namespace {

const std::vector<std::string> known_fallbacks = {"vanka", "ilu", direct_fallback};

std::vector<std::string> names_of_fallbacks(const Teuchos::ParameterList& list) {
  return list.get<Teuchos::Array<std::string>>("fallbacks").toVector();
}

void check_fallbacks(const Teuchos::ParameterList& list, const std::string& path) {
  if (!list.isParameter("fallbacks")) return;  // another method
  for (const std::string& name : names_of_fallbacks(list))
    TUNICA_CHECK(std::count(known_fallbacks.begin(), known_fallbacks.end(), name) == 1,
                 path + ": \"fallbacks\" names \"" + name + "\", expected " +
                     params::quoted(known_fallbacks) + ".");
}

}  // namespace

void add_fallback_keys(params::Table& table, const std::vector<std::string>& defaults) {
  table
      .names("fallbacks", defaults,
             "preconditioners that replace one that stagnates, fails or reaches \"max "
             "iterations\", in turn: vanka, multigrid with Vanka's smoother; ilu, incomplete "
             "factors with two levels of fill; direct, sparse LU; none: {}")
      .integer("direct unknowns", 300000, params::between(0, 1e9),
               "largest system for which the fallback \"direct\" is tried")
      .number("direct memory", 2.0, params::non_negative(), "GB",
              "largest factors, as estimated before they are made, for the fallback \"direct\"")
      .check(check_fallbacks);
}

// The list of the solver with another preconditioner in it: its method and its limits stay.
std::vector<Fallback> fallbacks_of(const Teuchos::ParameterList& options) {
  std::vector<Fallback> all;
  for (const std::string& name : names_of_fallbacks(options)) {
    if (name == options.get<std::string>("preconditioner")) continue;
    Teuchos::ParameterList list(options);
    if (name == direct_fallback) {
      list.set("preconditioner", "direct");
    } else if (name == "ilu") {
      list.set("preconditioner", "ilu").set("fill level", 2).set("overlap", 1);
    } else {
      // The same levels with a smoother that asks less of the matrix
      list.set("preconditioner", "multigrid").set("matrix", "merged");
      list.sublist("MueLu") = multigrid::vanka_cycle_list(1);
    }
    all.push_back({name, list});
  }
  return all;
}

}  // namespace tunica::linear
