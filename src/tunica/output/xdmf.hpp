#pragma once
#include <string>
#include <vector>

namespace tunica::output {

/// The text of an XDMF file: a temporal collection of spatial collections of tetrahedral grids,
/// all numbers being in one HDF5 file beside it.
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
};

/// One spatial collection.
std::string step(double time, const std::vector<Grid>& grids, const std::string& hdf5_file);

/// The steps of a whole file up to that number, as step() made them.
std::string steps_up_to(int last, const std::string& document);

/// The whole file around the steps.
std::string document(const std::string& steps);

}  // namespace xdmf
}  // namespace tunica::output
