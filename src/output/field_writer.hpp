#pragma once
#include <array>
#include <string>
#include <vector>

#include "base/tensor.hpp"
#include "base/types.hpp"
#include "output/xdmf.hpp"

namespace tunica::output {

/// One tetrahedral mesh of the output, distributed: points as rank-contiguous ranges, each
/// tetrahedron on one rank. Positions are those of the reference configuration.
struct Grid {
  std::string name;  ///< "fluid", "wall"; a path component
  long long points_global = 0;
  long long first_point = 0;                   ///< global id of points[0]
  std::vector<Vec3> points;                    ///< owned points [mm]
  std::vector<std::array<long long, 4>> tets;  ///< written by this rank; global point ids
  std::vector<int> region;                     ///< per tet of this rank
  std::vector<int> partition;                  ///< per tet of this rank
};

/// Values at the owned points or at the tets of this rank, all components of one after those
/// of the other. Six components are a symmetric tensor in the order xx, yy, zz, xy, yz, zx.
struct Array {
  std::string name;
  int components = 1;  ///< 1, 3 or 6
  std::vector<double> values;
};

/// Time series of fields for ParaView: "fields.h5" and "fields.xdmf" in one folder.
///
/// In fields.h5 lie the geometry once per grid (/fluid/points, tets, region, partition) and per
/// step /step_000016/fluid/velocity; the step's group carries the attributes "step" and "time".
/// Symmetric tensors are stored as xx, xy, xz, yy, yz, zz, the order of XDMF's Tensor6.
/// A point array "displacement" moves the points in viewers (Warp By Vector).
///
/// A run killed at any time leaves the finished steps: write() touches no file, finish_step()
/// opens the file, writes, flushes and closes it, and only then replaces the XDMF.
class FieldWriter {
public:
  /// Replaces the files of an earlier run and writes the geometry. Ranks may own nothing.
  /// Collective. Throws std::runtime_error on all ranks if the disk refuses.
  FieldWriter(const std::string& folder, std::vector<Grid> grids, const CommPtr& comm);

  /// Takes the fields of one grid. Grids and arrays come in the same order on all ranks.
  void write(int step, double time, const std::string& grid, std::vector<Array> point_data,
             std::vector<Array> cell_data);

  /// Brings what write() took to the disk. Collective. Throws std::logic_error on all ranks if
  /// a write() did not fit the grids, and std::runtime_error if the disk refuses.
  void finish_step();

private:
  /// What remains of a Grid when its geometry is on the disk.
  struct Shape {
    std::string name;
    long long points_total, first_point, points;
    long long cells_total, first_cell, cells;
  };
  struct Block {
    Shape shape;
    std::vector<Array> point_data, cell_data;
  };

  Shape shape_of(const Grid& grid) const;
  void write_geometry(const std::vector<Grid>& grids) const;
  std::string complaint(int step, double time, const Block& block) const;
  void write_blocks(const std::string& group) const;
  std::vector<xdmf::Grid> describe_blocks(const std::string& group) const;
  void replace_xdmf() const;

  std::string folder_;
  CommPtr comm_;
  std::vector<Shape> shapes_;
  std::string finished_steps_;  ///< their XDMF text

  int step_ = 0;  ///< of the blocks not yet on the disk
  double time_ = 0.0;
  std::vector<Block> blocks_;
  std::string complaint_;
};

}  // namespace tunica::output
