#pragma once
#include <string>

#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// tunica's own mesh file, HDF5: here on one rank without MPI; write_slab() writes it on several.
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
/// All counts begin at 0. Datasets are compressed (deflate, level 1) and carry checksums, but for
/// files that several ranks have written.
Mesh read_hdf5(const std::string& path);

/// The rows of one of some ranks, by portion_of(). Not validated.
struct Hdf5Rows {
  Mesh rows;  ///< elements have numbers of the whole; all tags
  long long vertices = 0, tets = 0, triangles = 0;  ///< of the whole
};
Hdf5Rows read_hdf5_rows(const std::string& path, int rank, int ranks);

/// A failed write leaves all as it was.
void write_hdf5(const Mesh& mesh, const std::string& path);

/// Value of the attribute "format".
constexpr const char* hdf5_format = "tunica-mesh 1";

}  // namespace tunica::mesh
