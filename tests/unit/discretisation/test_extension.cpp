#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/discretisation/extension.hpp"
#include "unit/discretisation/few_tets.hpp"

namespace {

using namespace tunica;
using test::FewTets;

/// A linear displacement of the nodes.
MultiVector linear(const fields::FieldMesh& mesh) {
  MultiVector phi(mesh.node_map, 3);
  const auto view = phi.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (int a = 0; a < mesh.n_owned; ++a) {
    const Vec3& X = mesh.x[a];
    view(a, 0) = 0.1 + 0.3 * X[0] - 0.2 * X[2];
    view(a, 1) = 0.5 * X[1] + 0.4 * X[0];
    view(a, 2) = -0.7 * X[2] + 0.6 * X[1];
  }
  return phi;
}

double largest(const MultiVector& F) {
  std::array<double, 3> norms{};
  F.normInf(Teuchos::ArrayView<double>(norms.data(), 3));
  return std::max({norms[0], norms[1], norms[2]});
}

/// All but one vertex inside are given; a block of 2 × 2 × 2 cells has one.
struct OneFree {
  OneFree()
      : share(test::share_of(mesh::make_block({{1.0, 0.8, 0.6}, {2, 2, 2}}), {true})),
        field(fields::make_field_mesh(share, {0})) {
    for (int a = 0; a < field.n_nodes(); ++a) is_given.push_back(field.is_on_boundary(a));
  }
  mesh::Share share;
  fields::FieldMesh field;
  std::vector<char> is_given;
};

TEUCHOS_UNIT_TEST(Extension, a_linear_displacement_is_harmonic_and_in_equilibrium) {
  const OneFree block;
  const MultiVector phi = linear(block.field);
  MultiVector F(block.field.node_map, 3);
  discretisation::HarmonicExtension(block.field, block.is_given).residual(phi, F);
  TEST_COMPARE(largest(F), <, 1e-14);
  discretisation::ElasticExtension(block.field, block.is_given, discretisation::Extent::volume, 0.3,
                                   0.0)
      .residual(phi, F);
  TEST_COMPARE(largest(F), <, 1e-13);
}

TEUCHOS_UNIT_TEST(Extension, what_is_out_of_balance_pulls_the_node_inside_back) {
  const OneFree block;
  MultiVector phi(block.field.node_map, 3), F(block.field.node_map, 3);
  {
    const auto view = phi.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (int a = 0; a < block.field.n_owned; ++a)
      for (int i = 0; i < 3; ++i) view(a, i) = block.is_given[a] ? 0.0 : 0.1;
  }
  discretisation::HarmonicExtension extension(block.field, block.is_given);
  extension.residual(phi, F);
  // The diagonal of L for cells of 0.5 × 0.4 × 0.3: that of the seven-point formula, 2 V Σ 1/h².
  const double diagonal = 2.0 * 0.5 * 0.4 * 0.3 * (1.0 / 0.25 + 1.0 / 0.16 + 1.0 / 0.09);
  double found = 0.0;
  {
    const auto view = F.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (int a = 0; a < block.field.n_owned; ++a)
      if (!block.is_given[a]) found = view(a, 1);
  }
  TEST_FLOATING_EQUALITY(global_sum(*block.field.comm, found), 0.1 * diagonal, 1e-12);
}

}  // namespace
