#include "tunica/mesh/netgen.hpp"

#include <cctype>

#include "tunica/mesh/raw_mesh.hpp"
#include "tunica/mesh/text_scanner.hpp"

namespace tunica::mesh {
namespace {

class NetgenReader {
public:
  explicit NetgenReader(const std::string& path) : in_(path, '#') { mesh_.path = path; }

  RawMesh read() {
    in_.expect("mesh3d");
    std::string section;
    while ((section = std::string(in_.word("endmesh"))) != "endmesh") read_section(section);
    check_corners(mesh_.tets, "volume");
    check_corners(mesh_.triangles, "surface");
    return std::move(mesh_);
  }

private:
  void read_section(const std::string& section) {
    if (section == "dimension") {
      if (in_.integer("the dimension") != 3) in_.fail("dimension is not 3");
    } else if (section == "surfaceelements" || section == "surfaceelementsgi" ||
               section == "surfaceelementsuv") {
      read_triangles();
    } else if (section == "volumeelements") {
      read_tets();
    } else if (section == "points") {
      read_points();
    } else if (section == "materials") {
      read_names(mesh_.region_names);
    } else if (section == "bcnames") {
      read_names(mesh_.surface_names);
    } else {
      skip_section(section);
    }
  }

  /// Up to the next line that begins with a letter.
  void skip_section(const std::string& section) {
    if (std::isalpha(static_cast<unsigned char>(section[0])) == 0)
      in_.fail("found \"" + section.substr(0, 40) + "\", expected a section such as points");
    in_.rest_of_line();
    while (!in_.is_at_end() && std::isalpha(static_cast<unsigned char>(in_.peek()[0])) == 0)
      in_.rest_of_line();
  }

  template <std::size_t N>
  std::array<int, N> read_corners(const std::string& kind) {
    const int n = in_.integer("the number of points of an element", 1, 100);
    if (n != static_cast<int>(N))
      in_.fail("a " + kind + " element with " + std::to_string(n) + " points, expected " +
               std::to_string(N) + ". Mesh with tetrahedra of first order.");
    std::array<int, N> corners;
    for (int& corner : corners) corner = in_.integer("the number of a point", 1, largest_int) - 1;
    in_.rest_of_line();
    return corners;
  }

  void read_triangles() {
    const std::size_t n = in_.count("the number of surface elements", 16);
    mesh_.triangles.clear();
    mesh_.triangle_tag.clear();
    for (std::size_t i = 0; i < n; ++i) {
      in_.integer("the number of a surface");
      mesh_.triangle_tag.push_back(
          in_.integer("the number of a boundary condition", 0, largest_int));
      in_.integer("the domain inside");
      in_.integer("the domain outside");
      mesh_.triangles.push_back(read_corners<3>("surface"));
    }
  }

  void read_tets() {
    const std::size_t n = in_.count("the number of volume elements", 12);
    for (std::size_t i = 0; i < n; ++i) {
      mesh_.tet_tag.push_back(in_.integer("the number of a material", 0, largest_int));
      mesh_.tets.push_back(read_corners<4>("volume"));
      mesh_.tet_number.push_back(static_cast<long long>(mesh_.tets.size()));
    }
  }

  void read_points() {
    const std::size_t n = in_.count("the number of points", 6);
    if (!mesh_.vertices.empty()) in_.fail("a second section points");
    mesh_.vertices.resize(n);
    for (Vec3& x : mesh_.vertices)
      for (double& value : x) value = in_.real("a coordinate");
  }

  void read_names(std::map<int, std::string>& names) {
    const std::size_t n = in_.count("the number of names", 3);
    for (std::size_t i = 0; i < n; ++i) {
      const int id = in_.integer("the number of a name", 0, largest_int);
      names[id] = in_.rest_of_line();
    }
  }

  template <std::size_t N>
  void check_corners(const std::vector<std::array<int, N>>& elements, const std::string& kind) {
    for (std::size_t e = 0; e < elements.size(); ++e)
      for (const int v : elements[e])
        if (v >= static_cast<int>(mesh_.vertices.size()))
          in_.fail(kind + " element " + std::to_string(e + 1) + " has point " +
                   std::to_string(v + 1) + ", but the file has " +
                   std::to_string(mesh_.vertices.size()) + " points");
  }

  TextScanner in_;
  RawMesh mesh_;
};

}  // namespace

Mesh read_netgen(const std::string& path) { return finish(NetgenReader(path).read()); }

}  // namespace tunica::mesh
