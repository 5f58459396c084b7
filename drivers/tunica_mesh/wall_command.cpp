#include "tunica_mesh/wall_command.hpp"

#include <cstdio>
#include <iostream>

#include "tunica/mesh/info.hpp"
#include "tunica/mesh/read.hpp"
#include "tunica/mesh/validate.hpp"
#include "tunica/mesh/wall/grow.hpp"
#include "tunica/mesh/write.hpp"

using namespace tunica;

namespace {

mesh::wall::Options options_of(const Arguments& arguments) {
  mesh::wall::Options options;
  options.surfaces = arguments.names("surfaces");
  options.layers = mesh::wall::layers_from_text(arguments.text("layers"));
  if (!arguments.text("thickness").empty())
    options.thickness.uniform = arguments.number("thickness");
  if (!arguments.text("thickness-fraction").empty())
    options.thickness.fraction = arguments.number("thickness-fraction");
  options.thickness.file = arguments.text("thickness-file");
  options.interface = arguments.text("interface");
  return options;
}

std::vector<std::string> names(const std::vector<mesh::Tag>& tags) {
  std::vector<std::string> result;
  for (const mesh::Tag& tag : tags) result.push_back(tag.name);
  return result;
}

}  // namespace

Arguments::Command wall_command() {
  return {"wall",
          {"LUMEN", "OUT"},
          "Grows a wall of layers around the mesh of a lumen. The result holds both: the lumen's\n"
          "regions and caps as they are, a region for each layer, and the surfaces \"interface\",\n"
          "\"outer\", \"layer\" between two layers, and \"wall_CAP\" around each cap.",
          {{"surfaces", "lumen_wall", "of the lumen, on which the wall grows, separated by commas"},
           {"layers", "media=0.26,adventitia=0.13",
            "from the lumen outwards: name=thickness (mm):elements through it; without :elements\n"
            "as many as suit the lumen's triangles"},
           {"thickness", "", "of the whole wall, mm; the layers' are shares then"},
           {"thickness-fraction", "", "the same as a part of the lumen's local radius"},
           {"thickness-file", "",
            "the same at points: lines \"x y z thickness\", or .h5 with /points and /thickness"},
           {"interface", "interface", "new name of the surfaces"},
           overwrite_option()}};
}

void make_wall(const Arguments& arguments) {
  const std::string& path = arguments.new_file(1);
  const mesh::Mesh lumen = mesh::read(arguments.file(0));
  const mesh::wall::Options options = options_of(arguments);
  const mesh::wall::Grown grown = mesh::wall::grow(lumen, options);
  std::vector<std::string> layers;
  for (const mesh::wall::Layer& layer : options.layers) layers.push_back(layer.name);
  mesh::check_interface(grown.mesh, names(lumen.regions), layers, {options.interface});
  mesh::write(grown.mesh, path);
  std::cout << mesh::wall::to_text(grown.report);
  std::printf("%s: %zu vertices, %zu tetrahedra, %zu triangles\n", path.c_str(),
              grown.mesh.vertices.size(), grown.mesh.tets.size(), grown.mesh.triangles.size());
}
