#pragma once
#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

namespace tunica::linear {

/// Teko hands over what the user wrote; a key outside the known ones is a slip. Throws
/// std::invalid_argument, which names the nearest.
void check_keys(const Teuchos::ParameterList& list, const std::vector<std::string>& known);

}  // namespace tunica::linear
