#pragma once
#include <string>
#include <vector>

namespace tunica::output {

/// The text of XDMF files: tetrahedral grids at several times, all numbers being in one HDF5 file
/// beside them.
///
/// Readers give a grid the name "fluid[1]" where an earlier one is called "fluid" already, each in
/// other places, and no one file is read rightly by all:
///   version 3   a collection over time of collections without a name, one per step: grids below a
///               collection with a name are renamed, and collections lend no name to a block
///   version 2   a collection over time for each block, as only collections keep their names
namespace xdmf {

enum class Centre { node, cell };

struct Attribute {
  std::string name;
  Centre centre;
  int components;  ///< 1 scalar, 3 vector, 6 symmetric tensor (xx xy xz yy yz zz)
  bool is_integer;
  std::string dataset;  ///< path in the HDF5 file
};

/// Points at `/<name>/points`, tetrahedra at `/<name>/tets`.
struct Grid {
  std::string name;
  long long points;
  long long cells;
  std::vector<Attribute> attributes;
  std::vector<std::string> regions{};  ///< what the numbers of the attribute "region" mean
};

/// One spatial collection.
std::string step(double time, const std::vector<Grid>& grids, const std::string& hdf5_file);

/// The steps of a whole file up to that number, as step() made them.
std::string steps_up_to(int last, const std::string& document);

/// The whole file around the steps, for readers of version 3.
std::string document(const std::string& steps);

/// The same steps for readers of version 2.
std::string document_by_block(const std::string& steps);

}  // namespace xdmf
}  // namespace tunica::output
