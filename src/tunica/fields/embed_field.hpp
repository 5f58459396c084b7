#pragma once
#include "tunica/algebra/embedding.hpp"
#include "tunica/fields/block_operator.hpp"

namespace tunica::fields {

/// For each local node of a part the local node of the whole that takes its place in the same
/// elements: of a field in a mesh of several fields, both of this rank's share of one mesh; of
/// either the plain or the split mesh.
std::vector<int> nodes_in(const FieldMesh& part, const FieldMesh& whole);

/// The unknowns of a field in those of a mesh of several fields, by their elements. Both operators
/// outlive what is returned.
algebra::Embedding embed(const BlockOperator& part, const BlockOperator& whole);

}  // namespace tunica::fields
