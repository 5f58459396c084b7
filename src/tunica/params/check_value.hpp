#pragma once
#include <Teuchos_ParameterList.hpp>
#include <string>

#include "tunica/params/content.hpp"

namespace tunica::params {

/// The fault of the value that the list holds for the key (`"density" is -1 mg/mm³, expected > 0`);
/// "" if there is none. On the way integers become numbers where numbers are expected, and file
/// names become absolute.
std::string check_value(const Key& key, Teuchos::ParameterList& list, const std::string& directory);

/// The fault of a list of another package, given the keys and types it declares.
std::string check_foreign(const Key& key, const Teuchos::ParameterList& list,
                          const std::string& path);

}  // namespace tunica::params
