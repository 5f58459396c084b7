#pragma once
#include "tunica/base/types.hpp"
#include "tunica_mesh/arguments.hpp"

/// The subcommands that also run on several ranks.

/// refine: every tetrahedron becomes 8.
Arguments::Command refine_command();
void refine_mesh(const Arguments& arguments, const tunica::CommPtr& comm);

/// convert: from one format to another.
Arguments::Command convert_command();
void convert_mesh(const Arguments& arguments, const tunica::CommPtr& comm);

/// partition: how a mesh is cut for the ranks that are there.
Arguments::Command partition_command();
void show_partition(const Arguments& arguments, const tunica::CommPtr& comm);
