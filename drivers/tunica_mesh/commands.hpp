#pragma once
#include <functional>
#include <vector>

#include "tunica/base/types.hpp"
#include "tunica_mesh/arguments.hpp"

/// A subcommand: what it takes, and what it does on the ranks that are there. Throws Error.
struct Subcommand {
  Arguments::Command command;
  std::function<void(const Arguments& arguments, const tunica::CommPtr& comm)> run;
};

/// tube, block, slab, wall, info, refine, convert, partition.
const std::vector<Subcommand>& subcommands();
