#pragma once
#include "oracle/algebra.hpp"
#include "tunica/assembly/gather.hpp"
#include "tunica/discretisation/mixed_field.hpp"
#include "tunica/mesh/block.hpp"
#include "unit/problems/lists.hpp"

namespace tunica::test {

/// Twelve tetrahedra of the region "block".
struct FewTets {
  explicit FewTets(const CommPtr& comm = world())
      : share(share_of(mesh::make_block({{0.6, 0.3, 0.4}, {2, 1, 1}}), {true}, comm)),
        field(fields::make_field_mesh(share, {0})) {}

  mesh::Share share;
  fields::FieldMesh field;
};

/// The 16 unknowns of an element, 3 a + i and then 12 + a, as the oracle numbers them.
using ElementValues = std::array<double, 16>;

inline std::vector<ElementValues> element_values(const fields::FieldMesh& mesh,
                                                 const algebra::BlockVector& x) {
  const std::vector<Vec3> u = fields::ghosted_vectors(mesh, x[0]);
  const std::vector<double> p = fields::ghosted_scalars(mesh, x[1]);
  std::vector<ElementValues> all(mesh.tets.size());
  for (std::size_t e = 0; e < all.size(); ++e)
    for (int a = 0; a < 4; ++a) {
      for (int i = 0; i < 3; ++i) all[e][3 * a + i] = u[mesh.tets[e][a]][i];
      all[e][12 + a] = p[mesh.tets[e][a]];
    }
  return all;
}

/// Sums of rows(e), sixteen numbers for each local element, on owned nodes: as no element is left
/// out there, they are those of the whole mesh.
template <class Rows>
algebra::BlockVector sum_of_elements(const fields::FieldMesh& mesh,
                                     const algebra::BlockSpacePtr& space, const Rows& rows) {
  algebra::BlockVector sum(space);
  sum[0].putScalar(0.0);
  sum[1].putScalar(0.0);
  const auto u = sum[0].getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto p = sum[1].getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const ElementValues R = rows(e);
    for (int a = 0; a < 4; ++a) {
      const int node = mesh.tets[e][a];
      if (node >= mesh.n_owned) continue;
      for (int i = 0; i < 3; ++i) u(3 * node + i, 0) += R[3 * a + i];
      p(node, 0) += R[12 + a];
    }
  }
  return sum;
}

/// The values alone of rows that know their derivatives: the residual.
template <class Rows>
algebra::BlockVector residual_by_values(const fields::FieldMesh& mesh,
                                        const algebra::BlockSpacePtr& space, const Rows& rows) {
  return sum_of_elements(mesh, space, [&](std::size_t e) {
    ElementValues R{};
    const auto all = rows(e);
    for (int k = 0; k < 16; ++k) R[k] = all[k].val();
    return R;
  });
}

/// The Jacobian's product with v by the derivatives of an element's rows: rows(e) gives sixteen
/// numbers that know their derivatives by the element's unknowns.
template <class Rows>
algebra::BlockVector product_by_derivatives(const fields::FieldMesh& mesh,
                                            const algebra::BlockVector& v, const Rows& rows) {
  const std::vector<ElementValues> direction = element_values(mesh, v);
  return sum_of_elements(mesh, v.space(), [&](std::size_t e) {
    const auto R = rows(e);
    ElementValues Kv{};
    for (int k = 0; k < 16; ++k)
      for (int l = 0; l < 16; ++l) Kv[k] += R[k].dx(l) * direction[e][l];
    return Kv;
  });
}

/// u(x) and p(x) at the nodes.
template <class U, class P>
algebra::BlockVector interpolated(const fields::FieldMesh& mesh,
                                  const algebra::BlockSpacePtr& space, const U& u, const P& p) {
  algebra::BlockVector x(space);
  std::vector<Vec3> values;
  for (int a = 0; a < mesh.n_nodes(); ++a) values.push_back(u(mesh.x[a]));
  fields::store(values, mesh, x[0]);
  const auto view = x[1].getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (int a = 0; a < mesh.n_owned; ++a) view(a, 0) = p(mesh.x[a]);
  return x;
}

}  // namespace tunica::test
