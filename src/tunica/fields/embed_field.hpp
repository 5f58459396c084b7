#pragma once
#include "tunica/algebra/embedding.hpp"
#include "tunica/fields/block_operator.hpp"

namespace tunica::fields {

/// Position of a field in a mesh of several fields, both of this rank's share of one mesh: for its
/// local tetrahedra and nodes, those of the whole.
struct FieldPlace {
  std::vector<int> tets, nodes;
};
FieldPlace place_in(const FieldMesh& field, const FieldMesh& whole);

/// A mixed field's vectors and scalars in those of a mesh of several fields, by their elements.
/// Either may have its scalars on a split mesh; null: it has not.
struct FieldOfSeveral {
  const FieldMesh& mesh;
  const SplitMesh* split;
};
algebra::Embedding embed(const FieldOfSeveral& field, const BlockOperator& whole);

}  // namespace tunica::fields
