#pragma once
#include <string>
#include <vector>

#include "tunica/params/table.hpp"

namespace tunica::linear {

/// A preconditioner that takes the place of one that stagnates.
struct Fallback {
  std::string name;             ///< as the key "fallbacks" has it
  Teuchos::ParameterList list;  ///< resolved, of a Krylov solver with it
};

/// The one that factors the whole matrix.
constexpr const char* direct_fallback = "direct";

/// Adds the keys "fallbacks", "direct unknowns" and "direct memory".
void add_fallback_keys(params::Table& table, const std::vector<std::string>& defaults);

/// Those of a resolved "Linear Solver" list in their order, without the preconditioner of the list
/// itself: their Krylov method is that of the list.
std::vector<Fallback> fallbacks_of(const Teuchos::ParameterList& options);

}  // namespace tunica::linear
