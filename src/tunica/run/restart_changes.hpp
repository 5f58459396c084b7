#pragma once
#include <map>
#include <string>
#include <vector>

#include "tunica/base/types.hpp"
#include "tunica/output/checkpoint.hpp"
#include "tunica/params/differences.hpp"
#include "tunica/params/table.hpp"
#include "tunica/setup/command_line.hpp"

namespace tunica::run {

/// Changes of the case by a restart.
using Changes = std::vector<params::Difference>;

/// True for keys that say how long a run goes, what it writes and how its equations are solved;
/// false for those that say what is solved: physics, loads, discretisation in space and time.
bool may_change_freely(const std::string& path);

/// Hashes of what the files of a case hold, by key; not of its mesh, which has a fingerprint.
/// Throws Error where one cannot be read. Not collective.
std::map<std::string, std::string> hashes_of_files(const Teuchos::ParameterList& list);

/// The difference between the case that the checkpoint was made with and that of this run. Both are
/// complete: what the older one lacks has the default of the table. Where the folder of the results
/// and files lie does not count, but what these hold; the mesh is compared by its fingerprint. Not
/// collective.
Changes changes_since(const output::CheckpointHead& head, const Teuchos::ParameterList& list,
                      const params::Table& table);

/// Says what has changed since the checkpoint in the file; on rank 0, which gets it. Throws Error
/// where that is not free and --allow-changes is not given. Collective.
Changes accepted_changes(const output::CheckpointHead& head, const std::string& file,
                         const Teuchos::ParameterList& list, const params::Table& table,
                         const setup::CommandLine& command, const Comm& comm);

}  // namespace tunica::run
