#include "tunica_mesh/slab_command.hpp"

#include <cstdio>

#include "tunica/mesh/plane_mesh.hpp"
#include "tunica/mesh/write.hpp"
#include "tunica_mesh/report.hpp"

using namespace tunica;

Arguments::Command slab_command() {
  return {"slab",
          {"PLANE", "OUT"},
          "Draws a plane Gmsh mesh of triangles out along z, to a slab one cell thick for a plane "
          "flow.\n"
          "Physical surfaces become regions, physical curves surfaces, by their names. Hold the\n"
          "surfaces \"front\" and \"back\" along their normal: planes of symmetry.",
          {{"thickness", "0", "mm; 0: the mean length of the edges"}, overwrite_option()}};
}

void make_slab(const Arguments& arguments) {
  const std::string& path = arguments.new_file(1);
  const mesh::PlaneMesh plane = mesh::read_plane_mesh(arguments.file(0));
  const double wanted = arguments.number("thickness");
  const double thickness = wanted == 0.0 ? mesh::mean_edge(plane) : wanted;
  const mesh::Mesh slab = mesh::drawn_out(plane, thickness, arguments.file(0));
  mesh::write(slab, path);
  report(slab, path);
  std::printf("thickness %.6g mm\n", thickness);
}
