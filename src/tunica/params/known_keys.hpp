#pragma once
#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

namespace tunica::params {

/// For lists that another package hands over as the user wrote them: a key outside the known ones
/// is a slip. Throws std::invalid_argument, which begins with the owner and names the nearest.
void check_keys(const Teuchos::ParameterList& list, const std::vector<std::string>& known,
                const std::string& owner = "");

/// The fault of the fields of a coupled system, sublists with "parts" (Array(string)) each: the
/// system has no such part, or no field has one of its own. Empty: nothing.
std::string complaint_about_parts(const Teuchos::ParameterList& fields,
                                  const std::vector<std::string>& of_system);

}  // namespace tunica::params
