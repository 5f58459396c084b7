#include "tunica/linear/preconditioner_registry.hpp"

#include <algorithm>
#include <stdexcept>

#include "tunica/linear/preconditioners/block.hpp"
#include "tunica/linear/preconditioners/cycle.hpp"
#include "tunica/linear/preconditioners/direct.hpp"
#include "tunica/linear/preconditioners/field_by_field.hpp"
#include "tunica/linear/preconditioners/ilu.hpp"
#include "tunica/linear/preconditioners/none.hpp"
#include "tunica/linear/preconditioners/two_level_schwarz.hpp"

namespace tunica::linear {

const std::vector<PreconditionerEntry>& preconditioners() {
  static const std::vector<PreconditionerEntry> all = {
      ilu_preconditioner(),      // "ilu"
      schwarz_preconditioner(),  // "two-level schwarz"
      block_preconditioner(),    // "block"
      cycle_preconditioner(),    // "multigrid"
      field_preconditioner(),    // "field by field"
      direct_preconditioner(),   // "direct"
      no_preconditioner(),       // "none"
  };
  return all;
}

const PreconditionerEntry& preconditioner_of(const Teuchos::ParameterList& list) {
  const auto& name = list.get<std::string>("preconditioner");
  const auto& all = preconditioners();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.name == name; });
  if (found == all.end()) throw std::logic_error("\"" + name + "\" is no preconditioner");
  return *found;
}

void add_preconditioner_keys(params::Table& table, const SolverDefaults& defaults) {
  std::vector<params::Table::Case> cases;
  for (const PreconditionerEntry& entry : preconditioners())
    if (defaults.has_fields || !entry.needs_fields)
      cases.push_back({entry.name, entry.table(defaults)});
  table.variant(
      "preconditioner", defaults.preconditioner, cases,
      "right preconditioner: incomplete LU with additive Schwarz between ranks, FROSch's two-level "
      "Schwarz method with a subdomain per rank, a block preconditioner, a multigrid cycle for the "
      "whole system, " +
          std::string(defaults.has_fields ? "the parts of a coupled system in turn, " : "") +
          "sparse LU factors (for small systems), or none");
}

}  // namespace tunica::linear
