#include "tunica/fields/embed_field.hpp"

#include "tunica/base/error.hpp"

namespace tunica::fields {

FieldPlace place_in(const FieldMesh& field, const FieldMesh& whole) {
  FieldPlace place{{}, std::vector<int>(field.n_nodes(), -1)};
  int there = 0;  // the numbers of elements ascend in both
  const int n_tets = static_cast<int>(whole.tets.size());
  for (std::size_t e = 0; e < field.tets.size(); ++e) {
    while (there < n_tets && whole.tet_number[there] < field.tet_number[e]) ++there;
    TUNICA_ASSERT(there < n_tets && whole.tet_number[there] == field.tet_number[e],
                  "the elements of a field are elements of the whole");
    place.tets.push_back(there);
    for (int a = 0; a < 4; ++a) place.nodes[field.tets[e][a]] = whole.tets[there][a];
  }
  return place;
}

algebra::Embedding embed(const FieldOfSeveral& field, const BlockOperator& whole) {
  std::vector<algebra::Embedding::Place> places;
  for (int b = 0; b < whole.n_blocks(); ++b) {
    const int m = (*whole.space())[b].components;
    const FieldMesh& mesh = m == 1 ? scalar_mesh(field.mesh, field.split) : field.mesh;
    const FieldMesh& there = whole.mesh_of(b);
    algebra::Embedding::Place place{b, mesh.owned_map(m), mesh.map_with_ghosts(m), {}};
    for (const int a : place_in(mesh, there).nodes)
      for (int i = 0; i < m; ++i)
        place.numbers.push_back(there.map_with_ghosts(m)->getGlobalElement(m * a + i));
    places.push_back(std::move(place));
  }
  return {*whole.space(), std::move(places)};
}

}  // namespace tunica::fields
