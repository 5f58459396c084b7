#include <Teuchos_UnitTestHarness.hpp>
#include <map>

#include "tunica/assembly/patch_recovery.hpp"
#include "tunica/fields/split_mesh.hpp"
#include "unit/fields/small_tube.hpp"
#include "verify/cube.hpp"
#include "verify/field_of.hpp"

namespace {

using namespace tunica;
using assembly::PatchRecovery;
using test::SmallTube;

Vec3 centroid(const fields::FieldMesh& mesh, std::size_t e) {
  Vec3 sum{};
  for (const int a : mesh.tets[e]) sum += mesh.x[a];
  return 0.25 * sum;
}

template <class Function>
std::vector<double> at_centroids(const fields::FieldMesh& mesh, const Function& f) {
  std::vector<double> values;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) values.push_back(f(centroid(mesh, e)));
  return values;
}

/// The largest error at nodes of what is recovered from the function's values at centroids.
template <class Function>
double largest_error(const fields::FieldMesh& mesh, const Function& f) {
  const std::vector<double> nodal = PatchRecovery(mesh).at_nodes(1, at_centroids(mesh, f));
  double largest = 0.0;
  for (int a = 0; a < mesh.n_nodes(); ++a)
    largest = std::max(largest, std::abs(nodal[a] - f(mesh.x[a])));
  return global_max(*mesh.comm, largest);
}

SmallTube two_elements_in_each_layer(const CommPtr& comm = test::world()) {
  mesh::Tube shape = SmallTube::options();
  shape.media_layers = shape.adventitia_layers = 2;
  return SmallTube(comm, shape);
}

TEUCHOS_UNIT_TEST(PatchRecovery, linear_functions_are_exact_up_to_the_boundary) {
  const auto f = [](const Vec3& x) { return 3.0 + 2.0 * x[0] - x[1] + 0.5 * x[2]; };
  TEST_COMPARE(largest_error(two_elements_in_each_layer().wall, f), <, 1e-11);
  TEST_COMPARE(largest_error(verify::field_of(verify::make_cube(3)), f), <, 1e-12);
}

TEUCHOS_UNIT_TEST(PatchRecovery, is_of_second_order_up_to_the_boundary) {
  const auto f = [](const Vec3& x) { return std::sin(2.0 * x[0] + x[1]) * std::exp(x[2]); };
  const double coarse = largest_error(verify::field_of(verify::make_cube(6)), f),
               fine = largest_error(verify::field_of(verify::make_cube(12)), f);
  out << "largest errors " << coarse << ' ' << fine << '\n';
  TEST_COMPARE(verify::order(coarse, fine), >, 1.8);
}

TEUCHOS_UNIT_TEST(PatchRecovery, stays_bounded_where_a_layer_has_one_element) {
  const SmallTube tube;
  std::vector<double> values;
  for (const GlobalOrdinal number : tube.wall.tet_number)
    values.push_back(test::scatter(static_cast<double>(number)));
  const auto split = fields::split_mesh(tube.wall, {-1, 0, 1});
  for (const double v : PatchRecovery(*split).at_nodes(1, values))
    TEST_COMPARE(std::abs(v), <, 1.0 + 3.0 * std::sqrt(3.0));
}

TEUCHOS_UNIT_TEST(PatchRecovery, keeps_layers_apart) {
  const SmallTube tube = two_elements_in_each_layer();
  const auto split = fields::split_mesh(tube.wall, {-1, 0, 1});
  std::vector<double> values;
  for (std::size_t e = 0; e < split->tets.size(); ++e)
    values.push_back(split->region[e] == 1 ? 5.0 + centroid(*split, e)[2] : -7.0);
  const std::vector<double> nodal = PatchRecovery(*split).at_nodes(1, values);
  for (std::size_t e = 0; e < split->tets.size(); ++e)
    for (const int a : split->tets[e])
      TEST_COMPARE(std::abs(nodal[a] - (split->region[e] == 1 ? 5.0 + split->x[a][2] : -7.0)), <,
                   1e-11);
}

TEUCHOS_UNIT_TEST(PatchRecovery, does_not_depend_on_the_ranks) {
  const SmallTube many, one(test::alone());
  const auto recovered = [](const fields::FieldMesh& mesh) {
    std::vector<double> values;
    for (std::size_t e = 0; e < mesh.tets.size(); ++e)
      for (int k = 0; k < 2; ++k)
        values.push_back(test::scatter(2.0 * static_cast<double>(mesh.tet_number[e]) + k));
    return PatchRecovery(mesh).at_nodes(2, values);
  };
  const std::vector<double> mine = recovered(many.wall), all = recovered(one.wall);
  std::map<int, int> node_of;
  for (int a = 0; a < one.wall.n_nodes(); ++a) node_of[one.wall.vertex[a]] = a;
  for (int a = 0; a < many.wall.n_nodes(); ++a)
    for (int k = 0; k < 2; ++k)
      TEST_COMPARE(std::abs(mine[2 * a + k] - all[2 * node_of.at(many.wall.vertex[a]) + k]), <,
                   1e-12);
}

}  // namespace
