#pragma once
#include <Teuchos_ParameterList.hpp>

#include "tunica/base/types.hpp"
#include "tunica/params/table.hpp"
#include "tunica/setup/command_line.hpp"

namespace tunica::setup {

/// Reads and validates the whole case, with the assignments of the command line, before
/// anything else is opened. Every parameter of the result is resolved. Rank 0 reads; where
/// that fails all ranks throw the same Error, which names the file. Collective.
Teuchos::ParameterList read_case(const CommandLine& command, const params::Table& table,
                                 const Comm& comm);

/// True where the XML file has such a list at the top. Throws as read_case() does. Collective.
bool has_list(const std::string& file, const std::string& name, const Comm& comm);

}  // namespace tunica::setup
