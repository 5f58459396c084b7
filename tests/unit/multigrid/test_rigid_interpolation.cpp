#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <cmath>

#include "tunica/algebra/picked_matrix.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/multigrid/coarsening/flatness.hpp"
#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"
#include "unit/fields/small_tube.hpp"
#include "unit/multigrid/grid_blocks.hpp"

namespace {

using namespace tunica;
using multigrid::MixedCoarsening;
using multigrid::NodalCoarsening;
using test::Grid;

/// A curved shell of two layers, over 100 times as wide as it is thick.
const Grid shell{25, 33, 2, true};

Vec3 place(GlobalOrdinal node) {
  const auto x = static_cast<double>(node % shell.nx),
             y = static_cast<double>(node / shell.nx % shell.ny),
             z = 0.2 * static_cast<double>(node / shell.nx / shell.ny);
  const double angle = 0.15 * x;
  return {(6.0 + z) * std::sin(angle), y, (6.0 + z) * std::cos(angle)};
}

/// solid: nodes with a smaller number than this.
algebra::Nodes nodes_of_shell(const CommPtr& comm = test::world(),
                              GlobalOrdinal solid = shell.n_nodes()) {
  algebra::Nodes nodes = test::nodes_of(shell.graph(comm));
  const auto x = Teuchos::rcp(new MultiVector(nodes.graph->getRowMap(), 3));
  const auto in_solid = Teuchos::rcp(new Vector(nodes.graph->getRowMap()));
  for (const GlobalOrdinal node : global_numbers(*nodes.graph->getRowMap())) {
    for (int i = 0; i < 3; ++i) x->replaceGlobalValue(node, i, place(node)[i]);
    in_solid->replaceGlobalValue(node, node < solid ? 1.0 : 0.0);
  }
  nodes.places = {x, in_solid};
  return nodes;
}

algebra::BlockSpace space_on(const algebra::Nodes& nodes) {
  return algebra::BlockSpace(
      {{"vector", shell.laplacian(nodes.graph->getComm(), 3)->getRowMap(), 3, nodes},
       {"scalar", nodes.graph->getRowMap(), 1, nodes}});
}

/// Translations and rotations of nodes at x, in six columns.
MultiVector rigid_motions(const Teuchos::RCP<const Map>& unknowns, const MultiVector& x) {
  MultiVector motions(unknowns, 6);
  const auto from = x.getLocalViewHost(read_only);
  const auto to = motions.getLocalViewHost(overwrite_all);
  for (std::size_t a = 0; a < from.extent(0); ++a)
    for (int k = 0; k < 3; ++k) {
      const Vec3 turned = cross(identity()[k], Vec3{from(a, 0), from(a, 1), from(a, 2)});
      for (int i = 0; i < 3; ++i) {
        to(3 * a + i, k) = i == k ? 1.0 : 0.0;
        to(3 * a + i, 3 + k) = turned[i];
      }
    }
  return motions;
}

/// The largest difference of any motion from its interpolant on a level.
double largest_difference(const CrsMatrix& P, const MultiVector& fine, const MultiVector& coarse) {
  MultiVector difference(fine, Teuchos::Copy);
  P.apply(coarse, difference, Teuchos::NO_TRANS, -1.0, 1.0);
  std::vector<double> largest(6);
  difference.normInf(Teuchos::arrayViewFromVector(largest));
  return *std::max_element(largest.begin(), largest.end());
}

TEUCHOS_UNIT_TEST(rigid_interpolation, is_exact_for_rigid_motions_on_all_levels) {
  const algebra::Nodes nodes = nodes_of_shell();
  MixedCoarsening coarsening(space_on(nodes));
  NodalCoarsening of_nodes(nodes.graph, *nodes.order);
  Teuchos::RCP<const Map> rows = shell.laplacian(test::world(), 3)->getRowMap();
  Teuchos::RCP<const MultiVector> x = nodes.places.coordinates;
  for (int level = 0; level < 2; ++level) {
    const auto P = coarsening.prolongator(level, *rows, true);
    const auto means = coarsening.prolongator(level, *rows);
    const auto coarse_x =
        Teuchos::rcp(new MultiVector(of_nodes.prolongator(level)->getDomainMap(), 3));
    algebra::pick_rows(of_nodes.coarse_rows(level), *x, *coarse_x);
    const MultiVector fine = rigid_motions(rows, *x),
                      coarse = rigid_motions(P->getDomainMap(), *coarse_x);
    TEST_ASSERT(P->getDomainMap()->isSameAs(*means->getDomainMap()));
    TEST_COMPARE(largest_difference(*P, fine, coarse), <, 1e-12);
    TEST_COMPARE(largest_difference(*means, fine, coarse), >, 0.1);
    rows = P->getDomainMap();
    x = coarse_x;
  }
}

/// Of cells as long as they are wide, an odd number of them in each direction.
TEUCHOS_UNIT_TEST(rigid_interpolation, keeps_exact_means_of_regular_meshes) {
  const Grid block{8, 8, 8, true};
  algebra::Nodes nodes = test::nodes_of(block.graph(test::world()));
  const auto x = Teuchos::rcp(new MultiVector(nodes.graph->getRowMap(), 3));
  const auto in_solid = Teuchos::rcp(new Vector(nodes.graph->getRowMap()));
  in_solid->putScalar(1.0);
  for (const GlobalOrdinal node : global_numbers(*nodes.graph->getRowMap())) {
    x->replaceGlobalValue(node, 0, static_cast<double>(node % 8));
    x->replaceGlobalValue(node, 1, static_cast<double>(node / 8 % 8));
    x->replaceGlobalValue(node, 2, static_cast<double>(node / 64));
  }
  nodes.places = {x, in_solid};
  const Teuchos::RCP<const Map> unknowns = block.laplacian(test::world(), 3)->getRowMap();
  const algebra::BlockSpace space(
      {{"vector", unknowns, 3, nodes}, {"scalar", nodes.graph->getRowMap(), 1, nodes}});
  MixedCoarsening coarsening(space);
  NodalCoarsening of_nodes(nodes.graph, *nodes.order);
  const auto P = coarsening.prolongator(0, *unknowns, true),
             means = coarsening.prolongator(0, *unknowns);
  MultiVector coarse_x(of_nodes.prolongator(0)->getDomainMap(), 3);
  algebra::pick_rows(of_nodes.coarse_rows(0), *x, coarse_x);
  const MultiVector fine = rigid_motions(unknowns, *x),
                    coarse = rigid_motions(P->getDomainMap(), coarse_x);
  // the last layer has parents on one side alone, the others have them on both
  TEST_COMPARE(largest_difference(*P, fine, coarse), <, 1e-12);
  TEST_COMPARE(largest_difference(*means, fine, coarse), >, 0.4);
  for (const GlobalOrdinal row : global_numbers(*unknowns)) {
    const GlobalOrdinal node = row / 3;
    const bool is_last = node % 8 == 7 || node / 8 % 8 == 7 || node / 64 == 7;
    TEST_EQUALITY(test::row_of(*P, row) == test::row_of(*means, row), !is_last);
  }
}

TEUCHOS_UNIT_TEST(flatness, is_that_of_solids_alone) {
  const double thickness = 0.04;
  algebra::Nodes nodes = nodes_of_shell();
  const auto x = Teuchos::rcp(new MultiVector(nodes.graph->getRowMap(), 3));
  for (const GlobalOrdinal node : global_numbers(*nodes.graph->getRowMap())) {
    const auto layer = static_cast<double>(node / shell.nx / shell.ny);
    x->replaceGlobalValue(node, 0, static_cast<double>(node % shell.nx));
    x->replaceGlobalValue(node, 1, static_cast<double>(node / shell.nx % shell.ny));
    x->replaceGlobalValue(node, 2, thickness * layer);
  }
  nodes.places.coordinates = x;
  // the diagonal of a cell over its height
  const double expected = std::sqrt(2.0 + thickness * thickness) / thickness;
  TEST_FLOATING_EQUALITY(multigrid::flatness_of_solids(*nodes.graph, nodes.places), expected,
                         1e-12);
  TEST_FLOATING_EQUALITY(MixedCoarsening(space_on(nodes)).flatness(), expected, 1e-12);
  nodes.places.in_solid = Teuchos::rcp(new Vector(nodes.graph->getRowMap()));
  TEST_EQUALITY(multigrid::flatness_of_solids(*nodes.graph, nodes.places), 1.0);
  TEST_EQUALITY(multigrid::flatness_of_solids(*nodes.graph, {}), 1.0);
}

/// Of what is interpolated from a field on the coarse nodes, the product with another on the fine.
double moment(const CommPtr& comm) {
  const algebra::Nodes nodes = nodes_of_shell(comm);
  NodalCoarsening of_nodes(nodes.graph, *nodes.order);
  const auto P =
      MixedCoarsening(space_on(nodes)).prolongator(0, *shell.laplacian(comm, 3)->getRowMap(), true);
  MultiVector x(of_nodes.prolongator(0)->getDomainMap(), 3);
  algebra::pick_rows(of_nodes.coarse_rows(0), *nodes.places.coordinates, x);
  Vector coarse(P->getDomainMap()), fine(P->getRangeMap()), weights(P->getRangeMap());
  {
    const auto from = x.getLocalViewHost(read_only);
    const auto to = coarse.getLocalViewHost(overwrite_all);
    for (std::size_t r = 0; r < to.extent(0); ++r)
      to(r, 0) = std::sin(3.0 * from(r / 3, 1) + 2.0 * from(r / 3, 0) + static_cast<double>(r % 3));
  }
  for (const GlobalOrdinal row : global_numbers(*P->getRangeMap()))
    weights.replaceGlobalValue(row, std::cos(static_cast<double>(row)));
  P->apply(coarse, fine);
  return weights.dot(fine);
}

TEUCHOS_UNIT_TEST(rigid_interpolation, is_that_of_one_rank_on_several) {
  TEST_FLOATING_EQUALITY(moment(test::world()), moment(test::alone()), 1e-10);
}

TEUCHOS_UNIT_TEST(rigid_interpolation, leaves_nodes_outside_solids_their_means) {
  const algebra::Nodes nodes = nodes_of_shell(test::world(), 0);
  MixedCoarsening coarsening(space_on(nodes));
  const Teuchos::RCP<const Map> own = shell.laplacian(test::world(), 3)->getRowMap();
  const Map& rows = *own;
  const auto P = coarsening.prolongator(0, rows, true), means = coarsening.prolongator(0, rows);
  bool is_same = true;
  for (const GlobalOrdinal row : global_numbers(rows))
    is_same &= test::row_of(*P, row) == test::row_of(*means, row);
  TEST_ASSERT(all_agree(*test::world(), is_same));
}

}  // namespace
