#pragma once
#include <Teuchos_ParameterList.hpp>
#include <string>

namespace tunica::params {

/// Throws tunica::Error that names the list and both numbers where the first key of a resolved list
/// has more than the second.
void check_order(const Teuchos::ParameterList& list, const std::string& path,
                 const std::string& smaller, const std::string& larger);

}  // namespace tunica::params
