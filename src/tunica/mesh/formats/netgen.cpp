#include "tunica/mesh/formats/netgen.hpp"

#include <cctype>

#include "tunica/mesh/formats/text_scanner.hpp"

namespace tunica::mesh {
namespace {

class NetgenReader {
public:
  NetgenReader(const std::string& path, RowStream& rows) : in_(path, '#'), rows_(rows) {}

  void read() {
    in_.expect("mesh3d");
    std::string section;
    while ((section = std::string(in_.word("endmesh"))) != "endmesh") read_section(section);
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
      read_names(rows_.region_names);
    } else if (section == "bcnames") {
      read_names(rows_.surface_names);
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
    const long long n = in_.count("the number of surface elements", 16);
    if (rows_.triangles.count() > 0) in_.fail("a second section of surface elements");
    for (long long i = 0; i < n; ++i) {
      in_.integer("the number of a surface");
      const int tag = in_.integer("the number of a boundary condition", 0, largest_int);
      in_.integer("the domain inside");
      in_.integer("the domain outside");
      rows_.triangles.put({read_corners<3>("surface"), tag});
    }
  }

  void read_tets() {
    const long long n = in_.count("the number of volume elements", 12);
    for (long long i = 0; i < n; ++i) {
      const int tag = in_.integer("the number of a material", 0, largest_int);
      rows_.tets.put({read_corners<4>("volume"), tag, rows_.tets.count() + 1});
    }
  }

  void read_points() {
    const long long n = in_.count("the number of points", 6);
    if (rows_.vertices.count() > 0) in_.fail("a second section points");
    for (long long i = 0; i < n; ++i) {
      Vec3 x;
      for (double& value : x) value = in_.real("a coordinate");
      rows_.vertices.put(x);
    }
  }

  void read_names(std::map<int, std::string>& names) {
    const long long n = in_.count("the number of names", 3);
    for (long long i = 0; i < n; ++i) {
      const int id = in_.integer("the number of a name", 0, largest_int);
      names[id] = in_.rest_of_line();
    }
  }

  TextScanner in_;
  RowStream& rows_;
};

}  // namespace

void read_netgen(const std::string& path, RowStream& rows) { NetgenReader(path, rows).read(); }

}  // namespace tunica::mesh
