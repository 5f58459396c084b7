#include "tunica/fields/embed_field.hpp"

#include "tunica/base/error.hpp"

namespace tunica::fields {

namespace {

/// For each local node of a part the local node of the whole that takes its place in the same
/// elements: of a field in a mesh of several fields, both of this rank's share of one mesh; of
/// either the plain or the split mesh.
std::vector<int> nodes_in(const FieldMesh& part, const FieldMesh& whole) {
  std::vector<int> nodes(part.n_nodes(), -1);
  std::size_t there = 0;  // the numbers of elements ascend in both
  for (std::size_t e = 0; e < part.tets.size(); ++e) {
    while (there < whole.tets.size() && whole.tet_number[there] < part.tet_number[e]) ++there;
    TUNICA_ASSERT(there < whole.tets.size() && whole.tet_number[there] == part.tet_number[e],
                  "the elements of a part are elements of the whole");
    for (int a = 0; a < 4; ++a) nodes[part.tets[e][a]] = whole.tets[there][a];
  }
  return nodes;
}

algebra::Embedding::Place place_of(const BlockOperator& part, const BlockOperator& whole, int b) {
  const FieldMesh& mesh = whole.mesh_of(b);
  const int m = (*part.space())[b].components;
  algebra::Embedding::Place place{b, {}};
  for (const int a : nodes_in(part.mesh_of(b), mesh))
    for (int i = 0; i < m; ++i)
      place.numbers.push_back(m * mesh.ghosted_map->getGlobalElement(a) + i);
  return place;
}

}  // namespace

algebra::Embedding embed(const BlockOperator& part, const BlockOperator& whole) {
  std::vector<algebra::Embedding::Place> places;
  for (int b = 0; b < part.n_blocks(); ++b) places.push_back(place_of(part, whole, b));
  return {part, whole, std::move(places)};
}

}  // namespace tunica::fields
