#pragma once
#include <Teuchos_ParameterList.hpp>
#include <string>

#include "tunica/params/table.hpp"

namespace tunica::params {

/// The parameter list in the file. Throws tunica::Error, naming the file, if there is none,
/// if it is not XML, if a name occurs twice in a list, or if a value is not of its type
/// (Teuchos reads `1,5` as 1 and `abc` as 0; here they are errors).
Teuchos::ParameterList read_xml(const std::string& path);

/// Reads a list from a text; messages begin with `where` instead of the file.
Teuchos::ParameterList from_xml(const std::string& text, const std::string& where);

/// Sets one value from the command line: "Fluid/Surfaces/inlet/pressure=1.3".
///
/// The table tells whether the key exists (in whichever case of a variant) and its type.
/// Lists that are not there yet are made. Ranges are left to Table::resolve.
void set_from_text(Teuchos::ParameterList& list, const Table& table, const std::string& assignment);

/// The text of a file in which read_xml reads the same list.
std::string to_xml(const Teuchos::ParameterList& list);

}  // namespace tunica::params
