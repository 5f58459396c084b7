#include "tunica/io/atomic_file.hpp"
#include "tunica/mesh/text.hpp"
#include "tunica/mesh/write.hpp"

namespace tunica::mesh {
namespace {

std::string point(const Vec3& x) {
  return exact(x[0]) + " " + exact(x[1]) + " " + exact(x[2]) + "\n";
}

std::string array(const std::string& type, const std::string& name, const std::string& values,
                  int components = 1) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         std::to_string(components) + "\" format=\"ascii\">\n" + values + "</DataArray>\n";
}

template <typename Elements>
void append(std::string& text, const Elements& elements) {
  for (const auto& element : elements) {
    for (const int v : element) text += std::to_string(v) + " ";
    text += "\n";
  }
}

/// One value per tetrahedron, then one per triangle.
template <typename OfTet, typename OfTriangle>
std::string per_cell(const Mesh& mesh, OfTet of_tet, OfTriangle of_triangle) {
  std::string text;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) text += std::to_string(of_tet(t)) + "\n";
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    text += std::to_string(of_triangle(i)) + "\n";
  return text;
}

std::string points(const Mesh& mesh) {
  std::string text;
  for (const Vec3& x : mesh.vertices) text += point(x);
  return "<Points>\n" + array("Float64", "points", text, 3) + "</Points>\n";
}

std::string cells(const Mesh& mesh) {
  std::string connectivity;
  append(connectivity, mesh.tets);
  append(connectivity, mesh.triangles);
  const auto tets = mesh.tets.size();
  const auto end_of_tet = [](std::size_t t) { return 4 * (t + 1); };
  const auto end_of_triangle = [&](std::size_t i) { return 4 * tets + 3 * (i + 1); };
  const std::string offsets = per_cell(mesh, end_of_tet, end_of_triangle);
  const auto tetra = [](std::size_t) { return 10; };
  const auto triangle = [](std::size_t) { return 5; };
  const std::string types = per_cell(mesh, tetra, triangle);
  return "<Cells>\n" + array("Int64", "connectivity", connectivity) +
         array("Int64", "offsets", offsets) + array("UInt8", "types", types) + "</Cells>\n";
}

std::string cell_data(const Mesh& mesh) {
  const auto zero = [](std::size_t) { return 0; };
  const auto region = [&](std::size_t t) { return mesh.regions[mesh.tet_region[t]].id; };
  const auto surface = [&](std::size_t i) { return mesh.surfaces[mesh.triangle_surface[i]].id; };
  std::string text = array("Int32", "region", per_cell(mesh, region, zero)) +
                     array("Int32", "surface", per_cell(mesh, zero, surface));
  for (const TetVectors& vectors : mesh.tet_vectors) {
    std::string values;
    for (const Vec3& v : vectors.values) values += point(v);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) values += point({0, 0, 0});
    text += array("Float64", vectors.name, values, 3);
  }
  return "<CellData>\n" + text + "</CellData>\n";
}

/// XML comments must not hold two hyphens in a row.
std::string legend(const Mesh& mesh) {
  std::string text;
  for (const Tag& tag : mesh.regions) text += " region " + std::to_string(tag.id) + " " + tag.name;
  for (const Tag& tag : mesh.surfaces)
    text += " surface " + std::to_string(tag.id) + " " + tag.name;
  for (std::size_t at; (at = text.find("--")) != std::string::npos;) text[at] = '_';
  return "<!--" + text + " -->\n";
}

}  // namespace

void write_vtu(const Mesh& mesh, const std::string& path) {
  std::string text = "<?xml version=\"1.0\"?>\n" + legend(mesh) +
                     "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                     "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n";
  text += "<Piece NumberOfPoints=\"" + std::to_string(mesh.vertices.size()) +
          "\" NumberOfCells=\"" + std::to_string(mesh.tets.size() + mesh.triangles.size()) +
          "\">\n";
  text += cell_data(mesh) + points(mesh) + cells(mesh);
  text += "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  io::write_file(path, text);
}

}  // namespace tunica::mesh
