#pragma once
#include "tunica_mesh/arguments.hpp"

namespace tunica {

/// Before what was at fault.
constexpr const char* fault_of_machine = "tunica-mesh: a fault of this program or of the machine: ";

}  // namespace tunica

/// The subcommands that also run on several ranks.

/// refine: every tetrahedron becomes 8.
Arguments::Command refine_command();
void refine_mesh(const Arguments& arguments);

/// partition: how a mesh is cut for the ranks that are there.
Arguments::Command partition_command();
void show_partition(const Arguments& arguments);
