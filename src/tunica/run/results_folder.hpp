#pragma once
#include <string>
#include <vector>

#include "tunica/base/types.hpp"
#include "tunica/io/folder_lock.hpp"
#include "tunica/output/run_record.hpp"
#include "tunica/setup/command_line.hpp"

namespace tunica::run {

/// Throws Error, before anything is written, where the run would replace what another one has left
/// in the folder and neither --restart nor --overwrite says so; or a file that is not a result, a
/// case above all, whatever they say. Collective.
void check_results_folder(const std::string& folder, const setup::CommandLine& command,
                          const std::string& program, const Comm& comm);

/// Keeps other runs out of the folder, if it is there. Throws Error, before anything is written,
/// where one is in it. Collective.
void lock_results_folder(io::FolderLock& lock, const std::string& folder, const Comm& comm);

/// The history of the run in the folder; of one that has not kept it what can be known. Empty where
/// there is no run. Not collective.
std::vector<output::Leg> history_of(const std::string& folder);

/// Name of the file in the folder that takes the parameters as a new run uses them: "case.xml", or
/// "case-used.xml" where a case.xml is there that no run has written. Not collective.
std::string name_for_parameters(const std::string& folder, const std::string& case_file);

/// Name for the parameters if a run continues with changes: the first free one of "case-2.xml",
/// "case-3.xml", ... Not collective.
std::string name_for_changed(const std::string& folder, const std::string& first);

/// Removes the parameters that an earlier run has written, but those under its first name and the
/// case of this one. Not collective.
void remove_parameters(const std::string& folder, const std::vector<output::Leg>& history,
                       const std::string& case_file);

}  // namespace tunica::run
