#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tunica/linear/block_preconditioner.hpp"
#include "tunica/linear/preconditioned_system.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"
#include "tunica/params/table.hpp"

namespace tunica::linear {

/// Defaults of a field for keys that are not given.
struct SolverDefaults {
  std::string preconditioner = "block";
  /// The Stratimikos list of the block preconditioner.
  Teuchos::ParameterList block = default_block_preconditioner(1, 1);
  /// The MueLu list of the multigrid cycle.
  Teuchos::ParameterList cycle = multigrid::mixed_cycle_list(2);
  /// The system is one of several fields.
  bool has_fields = false;
  /// Directions that GCR keeps from solve to solve.
  int recycled = 0;
  /// Preconditioners that replace one that stagnates (solvers/fallbacks.hpp).
  std::vector<std::string> fallbacks{};
};

/// Default fallbacks of the fields and of the coupled system.
inline std::vector<std::string> usual_fallbacks() { return {"vanka", "direct"}; }

/// A preconditioner, as XML names it.
struct PreconditionerEntry {
  std::string name;
  /// A set-up in iterations, roughly as measured for the default lists on walls and fluids of
  /// 10,000 to 200,000 unknowns.
  double setup_cost;
  std::function<params::Table(const SolverDefaults&)> table;
  /// The system for a resolved list, whose matrix and operators outlive it.
  std::function<std::unique_ptr<PreconditionedSystem>(
      const Teuchos::ParameterList&, const algebra::BlockMatrix&, const NamedOperators&)>
      make;
  bool needs_fields = false;  ///< is for coupled systems alone
};

/// Every preconditioner there is, in the order of the reference.
const std::vector<PreconditionerEntry>& preconditioners();

/// The one of the resolved list's key "preconditioner".
const PreconditionerEntry& preconditioner_of(const Teuchos::ParameterList& list);

/// Adds the key "preconditioner" and the keys of each preconditioner.
void add_preconditioner_keys(params::Table& table, const SolverDefaults& defaults);

}  // namespace tunica::linear
