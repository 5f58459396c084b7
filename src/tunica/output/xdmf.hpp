#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tunica/base/outcome.hpp"

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

struct Step {
  double time;
  std::vector<Grid> grids;
};

/// A run's steps so far, for readers of both versions.
class Document {
public:
  /// hdf5_file: the name that the numbers are to be found under.
  void add(const Step& step, const std::string& hdf5_file);
  int n_steps() const { return n_steps_; }

  /// Replaces the files in one step each. Not collective.
  Outcome replace_version_3(const std::string& path) const;
  Outcome replace_version_2(const std::string& path) const;

private:
  int n_steps_ = 0;
  std::string steps_;                                        ///< for version 3
  std::vector<std::pair<std::string, std::string>> blocks_;  ///< for version 2: name, its grids
};

}  // namespace xdmf
}  // namespace tunica::output
