#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/io/hdf5_arrays.hpp"

namespace tunica::output {

/// What fields.h5 of a run holds of one of its times, for one rank. Every failure is an Error that
/// names the file.
class StoredFields {
public:
  /// time: one that was written [ms], or none for the last. Throws Error, with the times there are,
  /// where it was not.
  StoredFields(const std::string& folder, std::optional<double> time);

  int step() const { return step_; }
  double time() const { return time_; }  ///< [ms]

  /// The undeformed mesh of a grid ("fluid", "wall").
  struct Mesh {
    std::vector<Vec3> x;  ///< [mm]
    std::vector<std::array<int, 4>> tets;
    std::vector<int> region;  ///< per tetrahedron: index into regions
    std::vector<std::string> regions;
  };
  bool has(const std::string& grid) const { return file_.has(grid + "/points"); }
  Mesh mesh(const std::string& grid) const;
  /// Values at the points, those of a point side by side; none where there is no such array.
  std::vector<double> values(const std::string& grid, const std::string& array, int columns) const;

private:
  std::string path_;
  io::Hdf5Reader file_;
  int step_ = 0;
  double time_ = 0.0;
};

}  // namespace tunica::output
