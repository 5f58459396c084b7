#pragma once
#include "tunica_mesh/arguments.hpp"

/// The subcommand slab: a plane mesh one cell thick.
Arguments::Command slab_command();

void make_slab(const Arguments& arguments);
