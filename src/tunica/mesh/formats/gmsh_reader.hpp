#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tunica/mesh/distributed/row_stream.hpp"
#include "tunica/mesh/formats/gmsh.hpp"
#include "tunica/mesh/formats/text_scanner.hpp"
#include "tunica/mesh/number_runs.hpp"

namespace tunica::mesh {

/// Reads the sections of a Gmsh file. Both versions share the names, the numbering of the
/// nodes and the elements' kinds; they differ in the order of the numbers.
class GmshReader {
public:
  /// kept: null where nobody wants lines.
  GmshReader(const std::string& path, RowStream& rows, Curves* kept);
  void read();

private:
  void read_format();
  void read_names();
  /// Keeps vectors on tetrahedra; passes over scalars, tensors and other elements.
  void read_element_data();
  void begin_vectors(const std::string& name);
  void skip_section(const std::string& name);
  void read_section(const std::string& name);

  void read_nodes_22();
  void read_elements_22();
  void read_entities_41();
  /// So many numbers of nodes that come one after the other.
  struct Run {
    long long first, count;
  };
  std::vector<Run> read_runs(long long n);
  void read_nodes_41();
  void read_elements_41();
  /// The one physical number of an entity, 0 for none.
  int read_physical();

  void add_node(long long number, const Vec3& x);
  Vec3 read_point();
  /// Reads the nodes of an element and keeps tetrahedra, triangles and, if asked, lines.
  void read_element(long long number, int type, int physical);
  template <std::size_t N>
  std::array<int, N> read_corners();

  TextScanner in_;
  RowStream& rows_;
  Curves* curves_;
  bool is_41_ = false;
  bool has_nodes_ = false;
  bool has_elements_ = false;
  NumberRuns nodes_, tets_;
  bool has_repeated_numbers_ = false;                            ///< among those of tetrahedra
  std::map<std::pair<int, long long>, int> physical_of_entity_;  ///< by dimension and number
};

}  // namespace tunica::mesh
