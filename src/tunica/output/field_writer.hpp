#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/base/types.hpp"
#include "tunica/output/field_files.hpp"
#include "tunica/output/row_order.hpp"

namespace tunica::output {

/// One tetrahedral mesh of the output, distributed: points as rank-contiguous ranges, each
/// tetrahedron on one rank. Positions are those of the reference configuration.
struct Grid {
  std::string name;  ///< "fluid", "wall"; a path component
  long long points_global = 0;
  long long first_point = 0;                   ///< global id of points[0]
  std::vector<Vec3> points;                    ///< owned points [mm]
  std::vector<int> vertex;                     ///< per owned point: vertex of the mesh
  std::vector<std::array<long long, 4>> tets;  ///< written by this rank; global point ids
  std::vector<GlobalOrdinal> tet_number;       ///< per tet of this rank: that of the mesh
  std::vector<int> region;                     ///< per tet of this rank: index into regions
  std::vector<int> partition;                  ///< per tet of this rank
  std::vector<std::string> regions{};          ///< names, of the whole mesh
};

/// Values at the owned points or at the tets of this rank, all components of one after those
/// of the other. Six components are a symmetric tensor in the order xx, yy, zz, xy, yz, zx.
struct Array {
  std::string name;
  int components = 1;  ///< 1, 3 or 6
  std::vector<double> values;
};

/// Time series of fields for ParaView: "fields.h5" with "fields.xdmf" and
/// "fields.xdmf2", see xdmf.hpp, in one folder.
///
/// In fields.h5 lie the geometry once per grid (/fluid/points, tets, region, partition) and per
/// step /step_000016/fluid/velocity; the step's group carries the attributes "step" and, once all
/// is there, "time". /fluid/region_names has their names in the order of the numbers. Symmetric
/// tensors are stored as xx, xy, xz, yy, yz, zz, the order of XDMF's Tensor6. A point array
/// "displacement" moves the points in viewers (Warp By Vector).
///
/// Rows are named by the mesh: /fluid/vertices and /fluid/tet_numbers. A run that goes on in the
/// same folder brings its rows into the order of the file, which does not change; "partition" is
/// that of the run that began the file.
///
/// Each array of a step has an attribute "centre", "node" or "cell".
///
/// A run killed at any time leaves the finished steps: write() touches no file, finish_step()
/// opens the file, writes, flushes and closes it, and only then lets the XDMF know.
class FieldWriter {
public:
  /// Replaces the files of an earlier run and writes the geometry. Ranks may own nothing.
  /// With kept_step > 0 the steps up to that one stay and later ones go; files that cannot be
  /// continued are set aside, see remark().
  /// Collective. Throws MachineFault on all ranks if the disk refuses.
  FieldWriter(const std::string& folder, const std::vector<Grid>& grids, const CommPtr& comm,
              int kept_step = 0);

  /// Compression of later steps, see io::Hdf5File::compress().
  void compress(int level) { compression_ = level; }

  /// A sentence for the user if files of an earlier run could not be continued, or nothing.
  const std::string& remark() const { return remark_; }

  /// Takes the fields of one grid. Grids and arrays come in the same order on all ranks.
  void write(int step, double time, const std::string& grid, std::vector<Array> point_data,
             std::vector<Array> cell_data);

  /// Brings what write() took to the disk. Collective. Throws std::logic_error on all ranks if
  /// a write() did not fit the grids, and MachineFault if the disk refuses.
  void finish_step();
  /// Brings the XDMF up to date. Collective. Throws MachineFault if the disk refuses.
  void finish();

private:
  /// The data of a Grid that are kept after its geometry is on the disk.
  struct Shape {
    std::string name;
    long long points_total = 0, first_point = 0, points = 0;  ///< rows of the file that this rank
                                                              ///< writes
    long long cells_total = 0, first_cell = 0, cells = 0;
    long long given_points = 0, given_cells = 0;  ///< rows that the run has on this rank
    std::shared_ptr<const RowOrder> point_order, cell_order;  ///< from the given; null: the same
    std::vector<std::string> regions;
  };
  struct Block {
    Shape shape;
    std::vector<Array> point_data, cell_data;
  };

  Shape shape_of(const Grid& grid) const;
  /// False, with a remark, if there is nothing to continue. Files that cannot be continued are set
  /// aside.
  bool can_go_on(int kept_step);
  void go_on(const std::vector<Grid>& grids);
  /// Sets which rows of the file this rank writes; returns how they come from those given.
  std::shared_ptr<const RowOrder> take_share(const std::string& dataset,
                                             const std::vector<GlobalOrdinal>& given,
                                             long long& first, long long& count) const;
  void begin_anew(const std::vector<Grid>& grids);
  void write_geometry(const std::vector<Grid>& grids) const;
  std::string complaint(int step, double time, const Block& block) const;
  void write_blocks(const std::string& group) const;
  /// The grid without the arrays of any step.
  static xdmf::Grid description_of(const Shape& shape);
  xdmf::Step describe_step(const std::string& group) const;

  std::string folder_;
  CommPtr comm_;
  int compression_ = 0;
  std::vector<Shape> shapes_;
  std::unique_ptr<XdmfFiles> xdmf_;  ///< on rank 0

  int step_ = 0;  ///< of the blocks not yet on the disk
  double time_ = 0.0;
  std::vector<Block> blocks_;
  std::string complaint_;
  std::string remark_;
};

}  // namespace tunica::output
