#pragma once
#include <optional>
#include <string>

#include "tunica/mesh/mesh.hpp"
#include "tunica/mesh/partition.hpp"

namespace tunica::mesh {

/// tunica's own mesh file, HDF5, written and read on one rank without MPI.
///
///   attribute "format" of the root = "tunica-mesh 1"
///   /vertices          n × 3  float64
///   /tets              m × 4  int32    positively oriented
///   /tet_region        m      int32    position in /region_ids
///   /triangles         k × 3  int32
///   /triangle_surface  k      int32    position in /surface_ids
///   /region_ids  /surface_ids          int32
///   /region_names  /surface_names      strings of fixed length, UTF-8, zero-padded
/// where tetrahedra have vectors
///   /tet_vector_names                  strings, one per field
///   /tet_vectors       f·m × 3  float64  one field behind the other
/// and in a partitioned file
///   /tet_part          m      int32
///   /vertex_owner      n      int32
/// All counts begin at 0. Datasets are compressed (deflate, level 1) and carry checksums.
Mesh read_hdf5(const std::string& path);

/// The partition in the file, if it holds one.
std::optional<Partition> read_hdf5_partition(const std::string& path);

/// A failed write leaves all as it was.
void write_hdf5(const Mesh& mesh, const std::string& path, const Partition* partition = nullptr);

}  // namespace tunica::mesh
