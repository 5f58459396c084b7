#pragma once
#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

namespace tunica::multigrid {

/// The value of a key of a smoother's list. Throws std::invalid_argument, which lists the known
/// words, for any other.
std::string validated_choice(const std::string& smoother, const Teuchos::ParameterList& list,
                             const std::string& key, const std::vector<std::string>& known);

}  // namespace tunica::multigrid
