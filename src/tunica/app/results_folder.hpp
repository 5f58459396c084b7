#pragma once
#include <string>

#include "tunica/app/command_line.hpp"
#include "tunica/base/types.hpp"

namespace tunica::app {

/// Throws Error, before anything is written, where the run would replace what another one has left
/// in the folder and neither --restart nor --overwrite says so. Collective.
void check_results_folder(const std::string& folder, const CommandLine& command,
                          const std::string& program, const Comm& comm);

/// Name of the file in the folder that takes the parameters as they are used: "case.xml", or
/// "case-used.xml" where the folder's case.xml is the input of this run or was that of an earlier
/// one. An input is never written to. Not collective.
std::string name_for_parameters(const std::string& folder, const std::string& case_file);

}  // namespace tunica::app
