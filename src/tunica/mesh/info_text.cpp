#include "tunica/base/formatted.hpp"
#include "tunica/mesh/info.hpp"
#include "tunica/mesh/text.hpp"

namespace tunica::mesh {
namespace {

template <typename... Values>
std::string line(const char* format, Values... values) {
  return formatted(format, values...) + "\n";
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string regions_text(const Info& info) {
  std::string text = line("%-20s %10s %10s %14s %9s %9s", "region", "tets", "vertices", "volume",
                          "worst q", "mean q");
  for (const Info::Region& r : info.regions)
    text += line("%-20s %10d %10d %14.8g %9.4f %9.4f", r.name.c_str(), r.tets, r.vertices, r.volume,
                 r.worst_quality, r.mean_quality);
  return text;
}

std::string surfaces_text(const Info& info) {
  std::string text =
      line("%-20s %10s %10s %14s  %s", "surface", "triangles", "vertices", "area", "between");
  for (const Info::Surface& s : info.surfaces)
    text += line("%-20s %10d %10d %14.8g  %s", s.name.c_str(), s.triangles, s.vertices, s.area,
                 joined(s.neighbours).c_str());
  return text;
}

}  // namespace

std::string to_text(const Info& info) {
  std::string text = line("%d vertices, %d edges, %d faces, %d tetrahedra, %d triangles",
                          info.vertices, info.edges, info.faces, info.tets, info.triangles);
  text += "box from " + show(info.low) + " to " + show(info.high) + "\n";
  text += line("edges from %.6g to %.6g", info.shortest_edge, info.longest_edge);
  text += line("quality 12 (3V)^(2/3) / sum of squared edges (1: regular): worst %.4f, mean %.4f",
               info.worst_quality, info.mean_quality);
  text += "  the worst is at " + show(info.worst_place) + "\n\n";
  text += regions_text(info) + "\n" + surfaces_text(info) + "\n";
  for (const Info::Contact& c : info.contacts)
    text += line("%s and %s share %d faces, %d of them on a surface", c.first.c_str(),
                 c.second.c_str(), c.faces, c.tagged_faces);
  if (!info.tet_vectors.empty())
    text += "vectors on the tetrahedra: " + joined(info.tet_vectors) + "\n";
  text += line("connected pieces: %d; Euler characteristic: %d (solid cylinder 1, pipe 0)",
               info.pieces, info.euler());
  if (info.twin_vertices > 0)
    text += line("NOT CONFORMING: %d vertices lie at the place of another one", info.twin_vertices);
  return text;
}

}  // namespace tunica::mesh
