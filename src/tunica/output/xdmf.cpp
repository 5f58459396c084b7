#include "tunica/output/xdmf.hpp"

#include <limits>
#include <sstream>

namespace tunica::output::xdmf {

namespace {

const char* type_of(int components) {
  return components == 1 ? "Scalar" : components == 3 ? "Vector" : "Tensor6";
}

/// <DataItem> that points into the HDF5 file.
std::string item(long long rows, int columns, const char* type, const std::string& place) {
  std::ostringstream out;
  out << "<DataItem Format=\"HDF\" " << type << " Dimensions=\"" << rows;
  if (columns > 1) out << ' ' << columns;
  out << "\">" << place << "</DataItem>";
  return out.str();
}

const char* const real_type = "NumberType=\"Float\" Precision=\"8\"";
const char* const index_type = "NumberType=\"Int\" Precision=\"8\"";
const char* const step_begin = "    <Grid Name=\"parts\"";
const char* const step_end = "    </Grid>\n";
const char* const tag_type = "NumberType=\"Int\" Precision=\"4\"";

std::string grid_text(const Grid& grid, const std::string& file) {
  const std::string place = file + ":/" + grid.name;
  std::ostringstream out;
  out << "      <Grid Name=\"" << grid.name << "\" GridType=\"Uniform\">\n"
      << "        <Topology TopologyType=\"Tetrahedron\" NumberOfElements=\"" << grid.cells << "\">"
      << item(grid.cells, 4, index_type, place + "/tets") << "</Topology>\n"
      << "        <Geometry GeometryType=\"XYZ\">"
      << item(grid.points, 3, real_type, place + "/points") << "</Geometry>\n";
  for (const Attribute& a : grid.attributes) {
    const bool at_nodes = a.centre == Centre::node;
    out << "        <Attribute Name=\"" << a.name << "\" AttributeType=\"" << type_of(a.components)
        << "\" Center=\"" << (at_nodes ? "Node" : "Cell") << "\">"
        << item(at_nodes ? grid.points : grid.cells, a.components,
                a.is_integer ? tag_type : real_type, file + ":" + a.dataset)
        << "</Attribute>\n";
  }
  out << "      </Grid>\n";
  return out.str();
}

}  // namespace

std::string step(double time, const std::vector<Grid>& grids, const std::string& hdf5_file) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << step_begin << " GridType=\"Collection\" CollectionType=\"Spatial\">\n"
      << "      <Time Value=\"" << time << "\"/>\n";
  for (const Grid& grid : grids) out << grid_text(grid, hdf5_file);
  out << step_end;
  return out.str();
}

std::string steps_up_to(int last, const std::string& document) {
  const std::string mark = "/step_", line_end = "\n";
  std::string kept;
  std::size_t begin = document.find(step_begin);
  while (begin != std::string::npos) {
    const std::size_t end = document.find(line_end + step_end, begin);
    if (end == std::string::npos) break;
    const std::size_t length = end + line_end.size() + std::string(step_end).size() - begin;
    const std::string step = document.substr(begin, length);
    const std::size_t number = step.find(mark);
    if (number != std::string::npos && std::stoi(step.substr(number + mark.size())) <= last)
      kept += step;
    begin = document.find(step_begin, begin + length);
  }
  return kept;
}

std::string document(const std::string& steps) {
  return "<?xml version=\"1.0\"?>\n"
         "<Xdmf Version=\"3.0\">\n"
         "<Domain>\n"
         "  <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n" +
         steps +
         "  </Grid>\n"
         "</Domain>\n"
         "</Xdmf>\n";
}

}  // namespace tunica::output::xdmf
