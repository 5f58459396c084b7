#include "tunica_mesh/commands.hpp"

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "tunica/base/error.hpp"
#include "tunica/mesh/block.hpp"
#include "tunica/mesh/info.hpp"
#include "tunica/mesh/read.hpp"
#include "tunica/mesh/tube.hpp"
#include "tunica/mesh/validate.hpp"
#include "tunica/mesh/write.hpp"
#include "tunica_mesh/parallel_commands.hpp"
#include "tunica_mesh/report.hpp"
#include "tunica_mesh/slab_command.hpp"
#include "tunica_mesh/wall_command.hpp"

namespace {

using namespace tunica;
using mesh::Mesh;

void make_tube(const Arguments& arguments) {
  mesh::Tube tube;
  tube.radius = arguments.number("radius");
  tube.media = arguments.number("media");
  tube.adventitia = arguments.number("adventitia");
  tube.length = arguments.number("length");
  tube.around = arguments.integer("around");
  tube.rings = arguments.integer("rings");
  tube.axial = arguments.integer("axial");
  tube.media_layers = arguments.integer("media-layers");
  tube.adventitia_layers = arguments.integer("adventitia-layers");
  tube.ring_grading = arguments.number("ring-grading");
  tube.axial_grading = arguments.number("axial-grading");
  tube.with_lumen = arguments.flag("lumen");
  tube.with_wall = arguments.flag("wall");
  tube.with_layer_surface = arguments.flag("layer-surface");
  const std::string& path = arguments.new_file(0);
  const Mesh result = mesh::make_tube(tube);
  mesh::write(result, path);
  report(result, path);
}

void make_block(const Arguments& arguments) {
  mesh::Block block;
  block.size = {arguments.number("x"), arguments.number("y"), arguments.number("z")};
  block.cells = {arguments.integer("cells-x"), arguments.integer("cells-y"),
                 arguments.integer("cells-z")};
  block.patch = {arguments.integer("patch-x"), arguments.integer("patch-y")};
  const std::string& path = arguments.new_file(0);
  const Mesh result = mesh::make_block(block);
  mesh::write(result, path);
  report(result, path);
}

void show_info(const Arguments& arguments) {
  const Mesh subject = mesh::read(arguments.file(0));
  std::cout << mesh::to_text(mesh::inspect(subject));
  const auto interface = arguments.names("interface");
  if (interface.empty()) return;
  const auto fluid = arguments.names("fluid");
  auto wall = arguments.names("wall");
  if (wall.empty())
    for (const mesh::Tag& region : subject.regions)
      if (std::find(fluid.begin(), fluid.end(), region.name) == fluid.end())
        wall.push_back(region.name);
  mesh::check_interface(subject, fluid, wall, interface);
  std::cout << "the interface conforms\n";
}

std::vector<Arguments::Option> tube_options() {
  return {{"radius", "1.43", "inner radius, mm"},
          {"media", "0.26", "thickness of the media, mm"},
          {"adventitia", "0.13", "thickness of the adventitia, mm"},
          {"length", "18", "mm"},
          {"around", "12", "divisions of the circumference, a multiple of 4"},
          {"rings", "0", "rings of the lumen around its core of (around/4)^2 cells"},
          {"axial", "18", "slices along the axis"},
          {"media-layers", "2", "layers of elements in the media, 0: none"},
          {"adventitia-layers", "1", "layers of elements in the adventitia, 0: none"},
          {"ring-grading", "1", "outermost ring of the lumen over the innermost"},
          {"axial-grading", "1", "last slice over the first"},
          {"lumen", "on", "on or off: wall only"},
          {"wall", "on", "on or off: lumen only"},
          {"layer-surface", "on", "on or off: triangles between media and adventitia"},
          overwrite_option()};
}

std::vector<Arguments::Option> block_options() {
  return {{"x", "1", "length along x, mm"},
          {"y", "1", "length along y, mm"},
          {"z", "1", "length along z, mm"},
          {"cells-x", "8", "cells along x, of six tetrahedra each"},
          {"cells-y", "8", "cells along y"},
          {"cells-z", "8", "cells along z"},
          {"patch-x", "0", "cells along x of the surface \"patch\", a corner of the top; 0: none"},
          {"patch-y", "0", "cells along y of it"},
          overwrite_option()};
}

/// What one rank does alone. Several would write one file, or say the same.
Subcommand alone(const Arguments::Command& command, void (*run)(const Arguments&)) {
  return {command, [name = command.name, run](const Arguments& arguments, const CommPtr& comm) {
            TUNICA_CHECK(comm->getSize() == 1,
                         "tunica-mesh " + name + " runs on one rank, not on " +
                             std::to_string(comm->getSize()) + "; start it without mpirun.");
            run(arguments);
          }};
}

}  // namespace

const std::vector<Subcommand>& subcommands() {
  static const std::vector<Subcommand> all{
      alone({"tube", {"OUT"}, "Makes a tube of lumen, media and adventitia.", tube_options()},
            make_tube),
      alone({"block", {"OUT"}, "Makes a block along the axes.", block_options()}, make_block),
      alone(slab_command(), make_slab),
      alone(wall_command(), make_wall),
      alone({"info",
             {"MESH"},
             "Shows counts, volumes, areas and quality of a mesh; checks the interface if it is "
             "named.",
             {{"fluid", "fluid", "regions of the fluid, separated by commas"},
              {"wall", "", "regions of the wall; all others if it is empty"},
              {"interface", "", "surfaces between them; empty: no check"}}},
            show_info),
      {refine_command(), refine_mesh},
      {convert_command(), convert_mesh},
      {partition_command(), show_partition}};
  return all;
}
