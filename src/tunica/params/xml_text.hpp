#pragma once
#include <Teuchos_ParameterList.hpp>
#include <iosfwd>
#include <string>

namespace tunica::params {

/// The text with &, <, > and quotes as XML wants them inside an attribute.
std::string escaped(const std::string& text);
/// The text with "--" taken out, which a comment must not contain.
std::string comment_safe(std::string text);

/// `<Parameter name=… type=… value=…/>`
std::string parameter_text(const std::string& name, const std::string& type,
                           const std::string& value);
/// `<Parameter …/>` of an entry that is not a list, without marking it as used.
std::string parameter_text(const std::string& name, const Teuchos::ParameterEntry& entry);

/// The list and everything in it; indent: number of blanks before it.
void print_list(std::ostream& out, const Teuchos::ParameterList& list, const std::string& name,
                int indent);

}  // namespace tunica::params
