#pragma once
#include <string>

#include "tunica/mesh/distributed/row_stream.hpp"
#include "tunica/mesh/distributed/slab.hpp"

namespace tunica::mesh {

/// Reads a mesh of another program: rank 0 the file, in pieces, which are handed on so that no rank
/// has more of it than its portion; rank 0 also has the numbers of nodes and elements, run by run.
/// Everything that such files leave open is resolved:
/// - if all tetrahedra are negative they are flipped; single ones are an Error that names
///   the element's number in the file;
/// - triangles without tag are dropped unless they lie on the boundary;
/// - vertices of no element (centres of arcs) are dropped;
/// - tags that are used become regions and surfaces, in the order of their numbers.
///
/// Throws Error on all ranks alike. Collective.
Slab read_text_mesh(const std::string& path, const CommPtr& comm,
                    int rows_at_once = RowStream::piece);

}  // namespace tunica::mesh
