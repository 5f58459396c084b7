#pragma once
#include <string>
#include <vector>

#include "tunica_mesh/arguments.hpp"

/// A subcommand: what it takes and what it does.
struct Subcommand {
  Arguments::Command command;
  void (*run)(const Arguments&);
};

/// tube, block, wall, info, refine, convert, partition.
const std::vector<Subcommand>& subcommands();
