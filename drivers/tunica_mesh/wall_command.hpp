#pragma once
#include "tunica_mesh/arguments.hpp"

/// The subcommand wall: a wall around a lumen.
Arguments::Command wall_command();

void make_wall(const Arguments& arguments);
