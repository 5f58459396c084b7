#include "tunica/multigrid/muelu/matrix_kind.hpp"

#include <set>
#include <string>

#include "tunica/base/error.hpp"
#include "tunica/multigrid/muelu/factory_registry.hpp"

namespace tunica::multigrid {

namespace {

// Of MueLu's own factories; all others work on either.
const std::set<std::string> for_one_matrix{"RAPFactory"};
const std::set<std::string> for_blocks{"BlockedCoarseMapFactory",
                                       "BlockedDirectSolver",
                                       "BlockedGaussSeidelSmoother",
                                       "BlockedJacobiSmoother",
                                       "BlockedPFactory",
                                       "BlockedRAPFactory",
                                       "BraessSarazinSmoother",
                                       "IndefiniteBlockDiagonalSmoother",
                                       "ReorderBlockAFactory",
                                       "SchurComplementFactory",
                                       "SimpleSmoother",
                                       "SubBlockAFactory",
                                       "TekoSmoother",
                                       "UzawaSmoother",
                                       "ZeroSubBlockAFactory"};

MatrixKind kind_of(const std::string& factory) {
  if (const FactoryEntry* const ours = find_factory(factory)) return ours->works_on;
  if (for_one_matrix.count(factory) > 0) return MatrixKind::merged;
  return for_blocks.count(factory) > 0 ? MatrixKind::blocked : MatrixKind::either;
}

void check_name(const std::string& name, bool is_blocked) {
  const auto wrong = is_blocked ? MatrixKind::merged : MatrixKind::blocked;
  TUNICA_CHECK(kind_of(name) != wrong, name + " needs \"matrix\" = \"" +
                                           (is_blocked ? "merged" : "blocked") + "\", found \"" +
                                           (is_blocked ? "blocked" : "merged") + "\".");
}

/// Factories are named by "factory" or, without keys of their own, in their place.
void check_names(const Teuchos::ParameterList& list, const Teuchos::ParameterList& labels,
                 bool is_blocked) {
  for (const auto& item : list) {
    const auto& entry = item.second;
    if (entry.isList()) {
      const auto& inner = Teuchos::getValue<Teuchos::ParameterList>(entry);
      check_names(inner, labels, is_blocked);
      TUNICA_CHECK(is_blocked || !is_schwarz_of_pressures(inner),
                   "SCHWARZ with \"partitioner: type\" \"user\" needs \"matrix\" = \"blocked\", "
                   "found \"merged\".");
    } else if (entry.isType<std::string>()) {
      const auto& value = Teuchos::getValue<std::string>(entry);
      if (item.first == "factory" || !labels.isParameter(value)) check_name(value, is_blocked);
    }
  }
}

/// The type of a factory that a list names by its label or directly.
std::string type_of(const std::string& name, const Teuchos::ParameterList& factories) {
  if (!factories.isParameter(name)) return name;
  if (!factories.isSublist(name)) return factories.get<std::string>(name);
  const auto& list = factories.sublist(name);
  return list.isParameter("factory") ? list.get<std::string>("factory") : name;
}

/// MueLu's default is DirectSolver.
void check_coarse_solver(const Teuchos::ParameterList& hierarchy,
                         const Teuchos::ParameterList& factories) {
  std::set<std::string> solvers;
  for (const auto& item : hierarchy) {
    if (!item.second.isList()) continue;
    const auto& levels = hierarchy.sublist(item.first);
    if (levels.isType<std::string>("CoarseSolver"))
      solvers.insert(type_of(levels.get<std::string>("CoarseSolver"), factories));
  }
  TUNICA_CHECK(!solvers.empty() && solvers.count("DirectSolver") == 0,
               "at the coarsest level is a DirectSolver, \"matrix\" = \"blocked\" needs "
               "\"CoarseSolver\" = BlockedDirectSolver.");
}

}  // namespace

void check_matrix_kind(const Teuchos::ParameterList& muelu, bool is_blocked) {
  if (!muelu.isSublist("Factories") || !muelu.isSublist("Hierarchy")) return;
  const auto& factories = muelu.sublist("Factories");
  const auto& hierarchy = muelu.sublist("Hierarchy");
  check_names(factories, factories, is_blocked);
  check_names(hierarchy, factories, is_blocked);
  if (is_blocked) check_coarse_solver(hierarchy, factories);
}

bool is_schwarz_of_pressures(const Teuchos::ParameterList& smoother) {
  const auto text = [](const Teuchos::ParameterList& list, const char* key) {
    return list.isType<std::string>(key) ? list.get<std::string>(key) : std::string();
  };
  if (text(smoother, "factory") != "TrilinosSmoother" || text(smoother, "type") != "SCHWARZ")
    return false;
  const std::string patches = "subdomain solver parameters";
  if (!smoother.isSublist("ParameterList")) return false;
  const auto& schwarz = smoother.sublist("ParameterList");
  return schwarz.isSublist(patches) &&
         text(schwarz.sublist(patches), "partitioner: type") == "user";
}

}  // namespace tunica::multigrid
