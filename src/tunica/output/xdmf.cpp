#include "tunica/output/xdmf.hpp"

#include <algorithm>
#include <limits>
#include <sstream>

#include "tunica/io/atomic_file.hpp"

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

/// time: a line, or none.
std::string grid_text(const Grid& grid, const std::string& time, const std::string& file) {
  const std::string place = file + ":/" + grid.name;
  std::ostringstream out;
  out << "      <Grid Name=\"" << grid.name << "\" GridType=\"Uniform\">\n"
      << time << "        <Topology TopologyType=\"Tetrahedron\" NumberOfElements=\"" << grid.cells
      << "\">" << item(grid.cells, 4, index_type, place + "/tets") << "</Topology>\n"
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

/// <Time> with as many digits as give the number back.
std::string time_text(double time) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "<Time Value=\"" << time << "\"/>\n";
  return out.str();
}

const char* const head = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n";
const char* const foot = "  </Grid>\n</Domain>\n</Xdmf>\n";

}  // namespace

void Document::add(const Step& step, const std::string& hdf5_file) {
  const std::string time = time_text(step.time);
  steps_ += "    <Grid GridType=\"Collection\" CollectionType=\"Spatial\">\n      " + time;
  for (const Grid& grid : step.grids) {
    steps_ += grid_text(grid, "", hdf5_file);
    auto block = std::find_if(blocks_.begin(), blocks_.end(),
                              [&](const auto& known) { return known.first == grid.name; });
    if (block == blocks_.end()) block = blocks_.insert(block, {grid.name, ""});
    block->second += grid_text(grid, "        " + time, hdf5_file);
  }
  steps_ += "    </Grid>\n";
  ++n_steps_;
}

Outcome Document::replace_version_3(const std::string& path) const {
  io::AtomicFile file(path);
  file.add(head);
  file.add("  <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
  file.add(steps_);
  file.add(foot);
  return file.commit();
}

Outcome Document::replace_version_2(const std::string& path) const {
  io::AtomicFile file(path);
  file.add(head);
  file.add("  <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Spatial\">\n");
  for (const auto& [name, grids] : blocks_) {
    file.add("    <Grid Name=\"" + name +
             "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
    file.add(grids);
    file.add("    </Grid>\n");
  }
  file.add(foot);
  return file.commit();
}

}  // namespace tunica::output::xdmf
