#include "tunica/mesh/formats/gmsh_reader.hpp"

#include <algorithm>
#include <cstdlib>

namespace tunica::mesh {
namespace {

constexpr int line_type = 1, triangle_type = 2, tet_type = 4, point_type = 15;

}  // namespace

GmshReader::GmshReader(const std::string& path, RowStream& rows, Curves* kept)
    : in_(path), rows_(rows), curves_(kept) {}

void GmshReader::read() {
  read_format();
  while (!in_.is_at_end()) {
    const std::string section(in_.word("a section"));
    if (section.size() < 2 || section[0] != '$')
      in_.fail("found \"" + section.substr(0, 40) + "\", expected a section such as $Nodes");
    read_section(section.substr(1));
  }
  if (!has_nodes_ || !has_elements_)
    in_.fail("the file ends without $Nodes or without $Elements. Is it truncated?");
}

void GmshReader::read_format() {
  in_.expect("$MeshFormat");
  const double version = in_.real("the version");
  if (version != 2.2 && version != 4.1)
    in_.fail("Gmsh version " + std::to_string(version).substr(0, 3) +
             ", expected 2.2 or 4.1. Save it with \"gmsh -0 -format msh41\".");
  is_41_ = version == 4.1;
  if (in_.integer("the file type") != 0)
    in_.fail(
        "a binary Gmsh file, expected ASCII. Save it with \"gmsh -0 -format msh41\", "
        "without -bin.");
  in_.integer("the data size");
  in_.expect("$EndMeshFormat");
}

void GmshReader::read_section(const std::string& name) {
  if (name == "PartitionedEntities")
    in_.fail("a partitioned Gmsh file, expected a whole one. Save it with \"gmsh -unpartition\".");
  if (name == "PhysicalNames") {
    read_names();
  } else if (name == "Entities" && is_41_) {
    read_entities_41();
  } else if (name == "Nodes") {
    if (has_nodes_) in_.fail("a second section $Nodes");
    has_nodes_ = true;
    is_41_ ? read_nodes_41() : read_nodes_22();
  } else if (name == "Elements") {
    if (!has_nodes_) in_.fail("$Elements before $Nodes");
    if (has_elements_) in_.fail("a second section $Elements");
    has_elements_ = true;
    is_41_ ? read_elements_41() : read_elements_22();
  } else if (name == "ElementData") {
    if (!has_elements_) in_.fail("$ElementData before $Elements");
    read_element_data();
  } else {
    return skip_section(name);
  }
  in_.expect("$End" + name);
}

void GmshReader::skip_section(const std::string& name) {
  const std::string end = "$End" + name;
  while (in_.word(end) != end) continue;
}

void GmshReader::read_names() {
  const long long n = in_.count("the number of physical names", 7);
  for (long long i = 0; i < n; ++i) {
    const int dimension = in_.integer("the dimension of a physical group", 0, 3);
    const int id = in_.integer("the number of a physical group", 1, largest_int);
    const std::string name = in_.quoted("the name of a physical group");
    if (dimension == 3) rows_.region_names[id] = name;
    if (dimension == 2) rows_.surface_names[id] = name;
    if (dimension == 1 && curves_ != nullptr) curves_->names[id] = name;
  }
}

void GmshReader::read_element_data() {
  std::string name;
  const long long strings = in_.count("the number of string tags", 2);
  for (long long i = 0; i < strings; ++i) {
    const std::string text = in_.quoted("a string tag");
    if (i == 0) name = text;
  }
  const long long reals = in_.count("the number of real tags", 2);
  for (long long i = 0; i < reals; ++i) in_.real("a real tag");
  const long long integers = in_.count("the number of integer tags", 2);
  if (integers < 3) in_.fail("$ElementData with fewer than 3 integer tags");
  in_.integer("a time step");
  const int components = in_.integer("the number of components", 1, 9);
  const long long rows = in_.count("the number of elements with data", 4);
  for (long long i = 3; i < integers; ++i) in_.integer("an integer tag");
  const bool is_kept = components == 3;
  if (is_kept) begin_vectors(name);
  for (long long row = 0; row < rows; ++row) {
    VectorRow found{tets_.find(in_.integer("the number of an element")),
                    static_cast<int>(rows_.vector_names.size()) - 1,
                    {}};
    for (int i = 0; i < components; ++i) {
      const double value = in_.real("a value on an element");
      if (is_kept) found.value[i] = value;
    }
    if (is_kept && found.tet >= 0) rows_.vectors.put(found);
  }
}

void GmshReader::begin_vectors(const std::string& name) {
  std::vector<std::string>& names = rows_.vector_names;
  if (std::find(names.begin(), names.end(), name) != names.end())
    in_.fail("a second $ElementData \"" + name + "\", expected one time step of each");
  if (has_repeated_numbers_)
    in_.fail("$ElementData \"" + name + "\", but several elements have the same number");
  names.push_back(name);
}

void GmshReader::add_node(long long number, const Vec3& x) {
  if (!nodes_.add(number)) in_.fail("a second node with the number " + std::to_string(number));
  rows_.vertices.put(x);
}

Vec3 GmshReader::read_point() {
  Vec3 x;
  for (double& value : x) value = in_.real("a coordinate");
  return x;
}

template <std::size_t N>
std::array<int, N> GmshReader::read_corners() {
  std::array<int, N> corners;
  for (int& corner : corners) {
    const long long number = in_.integer("the number of a node");
    const long long place = nodes_.find(number);
    if (place < 0) in_.fail("node " + std::to_string(number) + " is not in $Nodes");
    corner = static_cast<int>(place);
  }
  return corners;
}

void GmshReader::read_element(long long number, int type, int physical) {
  if (type == tet_type) {
    rows_.tets.put({read_corners<4>(), physical, number});
    has_repeated_numbers_ |= !tets_.add(number);
  } else if (type == triangle_type) {
    rows_.triangles.put({read_corners<3>(), physical});
  } else if (type == line_type) {
    const auto corners = read_corners<2>();
    if (curves_ == nullptr) return;
    curves_->lines.push_back(corners);
    curves_->tags.push_back(physical);
  } else if (type == point_type) {
    read_corners<1>();
  } else {
    in_.fail("element " + std::to_string(number) + " is of Gmsh type " + std::to_string(type) +
             ", expected 4 (tetrahedron with 4 nodes), 2 (triangle with 3), 1 or 15. Mesh with "
             "tetrahedra of first order.");
  }
}

void GmshReader::read_nodes_22() {
  const long long n = in_.count("the number of nodes", 8);
  for (long long i = 0; i < n; ++i) {
    const long long number = in_.integer("the number of a node");
    add_node(number, read_point());
  }
}

void GmshReader::read_elements_22() {
  const long long n = in_.count("the number of elements", 8);
  for (long long i = 0; i < n; ++i) {
    const long long number = in_.integer("the number of an element");
    const int type = in_.integer("the type of an element", 1, largest_int);
    const long long tags = in_.count("the number of an element's tags", 2);
    int physical = 0;
    for (long long tag = 0; tag < tags; ++tag) {
      const int value = in_.integer("a tag of an element", -largest_int, largest_int);
      if (tag == 0) physical = std::abs(value);
    }
    read_element(number, type, physical);
  }
}

void read_gmsh(const std::string& path, RowStream& rows, Curves* kept) {
  GmshReader(path, rows, kept).read();
}

}  // namespace tunica::mesh
