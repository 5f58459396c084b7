#include "tunica/output/xdmf.hpp"

#include <limits>
#include <sstream>
#include <utility>

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
const char* const step_begin = "    <Grid GridType=\"Collection\" CollectionType=\"Spatial\">";
const char* const step_end = "    </Grid>\n";
const char* const tag_type = "NumberType=\"Int\" Precision=\"4\"";

std::string escaped(const std::string& text) {
  std::string found;
  for (const char c : text) {
    if (c == '&')
      found += "&amp;";
    else if (c == '<')
      found += "&lt;";
    else if (c == '"')
      found += "&quot;";
    else
      found += c;
  }
  return found;
}

/// "0 fluid, 1 media"
std::string legend(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k > 0 ? ", " : "") + std::to_string(k) + " " + escaped(names[k]);
  return text;
}

std::string grid_text(const Grid& grid, const std::string& file) {
  const std::string place = file + ":/" + grid.name;
  std::ostringstream out;
  out << "      <Grid Name=\"" << grid.name << "\" GridType=\"Uniform\">\n"
      << "        <Topology TopologyType=\"Tetrahedron\" NumberOfElements=\"" << grid.cells << "\">"
      << item(grid.cells, 4, index_type, place + "/tets") << "</Topology>\n"
      << "        <Geometry GeometryType=\"XYZ\">"
      << item(grid.points, 3, real_type, place + "/points") << "</Geometry>\n";
  if (!grid.regions.empty())
    out << "        <Information Name=\"region\" Value=\"" << legend(grid.regions) << "\"/>\n";
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

std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t begin = text.find(before) + before.size();
  return text.substr(begin, text.find(after, begin) - begin);
}

/// The passages of a text from begin to end, both inclusive.
std::vector<std::string> passages(const std::string& text, const std::string& begin,
                                  const std::string& end) {
  std::vector<std::string> found;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const std::size_t last = text.find(end, at);
    if (last == std::string::npos) break;
    found.push_back(text.substr(at, last + end.size() - at));
  }
  return found;
}

std::vector<std::string> steps_of(const std::string& document) {
  return passages(document, step_begin, std::string("\n") + step_end);
}

const char* const head = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n";
const char* const foot = "</Domain>\n</Xdmf>\n";

}  // namespace

std::string step(double time, const std::vector<Grid>& grids, const std::string& hdf5_file) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << step_begin << "\n"
      << "      <Time Value=\"" << time << "\"/>\n";
  for (const Grid& grid : grids) out << grid_text(grid, hdf5_file);
  out << step_end;
  return out.str();
}

std::string steps_up_to(int last, const std::string& document) {
  const std::string mark = "/step_";
  std::string kept;
  for (const std::string& step : steps_of(document)) {
    const std::size_t number = step.find(mark);
    if (number != std::string::npos && std::stoi(step.substr(number + mark.size())) <= last)
      kept += step;
  }
  return kept;
}

std::string document(const std::string& steps) {
  return std::string(head) +
         "  <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n" + steps +
         "  </Grid>\n" + foot;
}

std::string document_by_block(const std::string& steps) {
  std::vector<std::pair<std::string, std::string>> blocks;  // name, its grids
  for (const std::string& step : steps_of(steps)) {
    const std::string time = between(step, "<Time Value=\"", "\"");
    for (std::string grid : passages(step, "      <Grid Name=", "\n      </Grid>\n")) {
      grid.insert(grid.find('\n') + 1, "        <Time Value=\"" + time + "\"/>\n");
      const std::string name = between(grid, "Name=\"", "\"");
      auto block = blocks.begin();
      while (block != blocks.end() && block->first != name) ++block;
      if (block == blocks.end()) block = blocks.insert(block, {name, ""});
      block->second += grid;
    }
  }
  std::string text;
  for (const auto& [name, grids] : blocks) {
    text += "    <Grid Name=\"" + name +
            "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n" + grids + step_end;
  }
  return std::string(head) +
         "  <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Spatial\">\n" + text +
         "  </Grid>\n" + foot;
}

}  // namespace tunica::output::xdmf
