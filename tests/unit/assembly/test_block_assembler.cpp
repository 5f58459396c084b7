#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/assembly/block_assembler.hpp"
#include "tunica/base/trilinos.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

/// A number for each element and pair of unknowns: component 3 is the scalar.
double entry(int number, int v, int i, int w, int j) {
  return test::scatter(97.0 * number + 13.0 * v + 5.0 * w + 4.0 * i + j + 0.01 * v * w);
}

kernels::MixedJacobianOf<Pack> element_matrices(const fields::FieldMesh& mesh,
                                                const assembly::PackedElements& elements) {
  kernels::MixedJacobianOf<Pack> K;
  for (int lane = 0; lane < Pack::size; ++lane) {
    const std::size_t e = elements.number[lane];
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        const int v = mesh.vertex[mesh.tets[e][a]], w = mesh.vertex[mesh.tets[e][b]];
        const auto at = [&](int i, int j) { return entry(mesh.tet_number[e], v, i, w, j); };
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) K.A[a][b][i][j].set(lane, at(i, j));
          K.B1T[a][b][i].set(lane, at(i, 3));
          K.B2[a][b][i].set(lane, at(3, i));
        }
        K.mC[a][b].set(lane, at(3, 3));
      }
  }
  return K;
}

kernels::SurfaceJacobian face_matrix(const fields::FieldMesh& mesh, const fields::Face& face) {
  kernels::SurfaceJacobian K;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          K.A[a][b][i][j] = entry(-1 - face.surface, mesh.vertex[face.nodes[a]], i,
                                  mesh.vertex[face.nodes[b]], j);
  return K;
}

/// Some vertices without any, some with all, some with single constraints, some across the axes.
void constrain(int vertex, int node, assembly::Constraints& fixed) {
  const double third = 1.0 / 3.0;
  const Vec3 across{third, -2.0 * third, 2.0 * third}, beside{0.8, 0.6, 0.0};
  switch (vertex % 11) {
    case 1:
      return fixed.fix_vector(node);
    case 3:
      return fixed.fix_component(node, 0);
    case 5:
      fixed.fix_component(node, 1);
      return fixed.fix_scalar(node);
    case 6:
      return fixed.fix_direction(node, across);
    case 7:
      fixed.fix_vector(node);
      return fixed.fix_scalar(node);
    case 8:
      return fixed.fix_component(node, 2);
    case 9:
      fixed.fix_scalar(node);
      fixed.fix_direction(node, across);
      return fixed.fix_direction(node, beside);
    case 10:
      fixed.fix_direction(node, beside);
      return fixed.fix_component(node, 2);
    default:
      return;
  }
}

fields::BlockOperator assembled(const fields::FieldMesh& mesh, bool is_constrained) {
  assembly::Constraints fixed(mesh.n_nodes());
  if (is_constrained)
    for (int a = 0; a < mesh.n_nodes(); ++a) constrain(mesh.vertex[a], a, fixed);
  fields::BlockOperator K(mesh);
  for (int pass = 0; pass < 2; ++pass) {  // the second pass must start from zeros
    assembly::BlockAssembler assembler(K, fixed);
    for (std::size_t e = 0; e < mesh.tets.size(); e += Pack::size) {
      const assembly::PackedElements elements(e, mesh.tets.size());
      assembler.begin(elements);
      assembler.add(element_matrices(mesh, elements));
    }
    for (const auto& face : mesh.faces) assembler.add(face, face_matrix(mesh, face));
    assembler.finish();
  }
  return K;
}

/// The same by the definition: a dense matrix of the whole mesh, in which constrained rows and
/// columns are cut at the end. Unknowns 4 v + i.
std::vector<std::vector<double>> dense(const SmallTube& serial, bool is_constrained) {
  const std::size_t n = 4 * serial.mesh.vertices.size();
  std::vector<std::vector<double>> K(n, std::vector<double>(n, 0.0));
  const fields::FieldMesh& mesh = serial.wall;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    for (const int a : mesh.tets[e])
      for (const int b : mesh.tets[e])
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 4; ++j)
            K[4 * mesh.vertex[a] + i][4 * mesh.vertex[b] + j] +=
                entry(mesh.tet_number[e], mesh.vertex[a], i, mesh.vertex[b], j);
  for (const auto& face : mesh.faces)
    for (const int a : face.nodes)
      for (const int b : face.nodes)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            K[4 * mesh.vertex[a] + i][4 * mesh.vertex[b] + j] +=
                entry(-1 - face.surface, mesh.vertex[a], i, mesh.vertex[b], j);
  if (!is_constrained) return K;
  // P K P + s N vertex by vertex, N = I − P
  const std::vector<std::vector<double>> all = K;
  const auto P = [](int v) {
    assembly::Constraints fixed(1);
    constrain(v, 0, fixed);
    std::array<std::array<double, 4>, 4> all_of{};
    const Mat3 of_vector = fixed.projector(0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) all_of[i][j] = of_vector[i][j];
    all_of[3][3] = fixed.is_scalar_fixed(0) ? 0.0 : 1.0;
    return all_of;
  };
  const auto is_oblique = [](int v) {
    assembly::Constraints fixed(1);
    constrain(v, 0, fixed);
    return fixed.oblique(0) != nullptr;
  };
  const int vertices = static_cast<int>(n / 4);
  for (int v = 0; v < vertices; ++v)
    for (int w = 0; w < vertices; ++w) {
      const auto left = P(v), right = P(w);
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
          double sum = 0.0;
          for (int k = 0; k < 4; ++k)
            for (int l = 0; l < 4; ++l) sum += left[i][k] * all[4 * v + k][4 * w + l] * right[l][j];
          K[4 * v + i][4 * w + j] = sum;
        }
    }
  for (int v = 0; v < vertices; ++v) {
    const auto free = P(v);
    const auto rest = [&](int i, int j) { return (i == j ? 1.0 : 0.0) - free[i][j]; };
    double trace = 0.0, rank = 0.0;
    for (int i = 0; i < 3; ++i) {
      rank += rest(i, i);
      for (int j = 0; j < 3; ++j) trace += rest(i, j) * all[4 * v + j][4 * v + i];
    }
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const bool is_by_trace = i < 3 && j < 3 && is_oblique(v);
        const double scale = is_by_trace ? trace / rank : all[4 * v + i][4 * v + j];
        K[4 * v + i][4 * v + j] += scale * rest(i, j);
      }
  }
  return K;
}

double worst_product(const SmallTube& tube, bool is_constrained) {
  const auto K = assembled(tube.wall, is_constrained);
  const auto reference = dense(SmallTube(test::alone()), is_constrained);
  const std::size_t vertices = tube.mesh.vertices.size();
  double worst = 0.0;
  for (int seed = 1; seed <= 3; ++seed) {
    const auto x = test::scattered(tube.wall, seed);
    auto y = test::scattered(tube.wall, 9);
    K.apply(x, y);
    const auto all_x = test::by_vertex(tube.wall, x, vertices);
    std::vector<double> expected(4 * vertices, 0.0);
    for (std::size_t r = 0; r < expected.size(); ++r)
      for (std::size_t c = 0; c < expected.size(); ++c) expected[r] += reference[r][c] * all_x[c];
    worst = std::max(worst,
                     test::largest_difference(test::by_vertex(tube.wall, y, vertices), expected));
  }
  return worst;
}

TEUCHOS_UNIT_TEST(block_assembler, agrees_with_a_dense_assembly) {
  TEST_COMPARE(worst_product(SmallTube(), false), <, 1e-11);
}

TEUCHOS_UNIT_TEST(block_assembler, constrained_rows_and_columns_keep_only_what_is_left_out) {
  TEST_COMPARE(worst_product(SmallTube(), true), <, 1e-11);
}

TEUCHOS_UNIT_TEST(block_assembler, adds_to_the_scalars_of_each_part_where_they_jump) {
  const SmallTube tube;
  std::vector<int> part(tube.mesh.regions.size(), 0);
  part.back() = 1;  // the outer layer
  const auto split = fields::split_mesh(tube.wall, part);
  const assembly::Constraints fixed(tube.wall.n_nodes());
  fields::BlockOperator K(tube.wall, fields::mixed_blocks, split.get());
  algebra::BlockVector x(K.space()), y(K.space());
  for (int block = 0; block < 2; ++block) {
    const auto numbers = global_numbers(*x[block].getMap());
    const auto values = x[block].getLocalViewHost(overwrite_all);
    for (int i = 0; i < numbers.size(); ++i)
      values(i, 0) = test::scatter(7.0 * static_cast<double>(numbers[i]) + block);
  }
  const auto u = fields::ghosted_vectors(tube.wall, x[0]);
  const auto p = fields::ghosted_scalars(*split, x[1]);
  assembly::NodalResidual expected(tube.wall, split.get());  // K x element by element
  assembly::BlockAssembler assembler(K, fixed);
  for (std::size_t e = 0; e < tube.wall.tets.size(); e += Pack::size) {
    const assembly::PackedElements elements(e, tube.wall.tets.size());
    const auto Ke = element_matrices(tube.wall, elements);
    assembler.begin(elements);
    assembler.add(Ke);
    kernels::MixedResidualOf<Pack> product{};
    for (int lane = 0; lane < Pack::size; ++lane) {
      const std::size_t number = elements.number[lane];
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b) {
          const Vec3& u_b = u[tube.wall.tets[number][b]];
          const double p_b = p[split->tets[number][b]];
          for (int i = 0; i < 3; ++i) {
            double sum = product.u[a][i][lane] + Ke.B1T[a][b][i][lane] * p_b;
            for (int j = 0; j < 3; ++j) sum += Ke.A[a][b][i][j][lane] * u_b[j];
            product.u[a][i].set(lane, sum);
          }
          double sum = product.p[a][lane] + Ke.mC[a][b][lane] * p_b;
          for (int j = 0; j < 3; ++j) sum += Ke.B2[a][b][j][lane] * u_b[j];
          product.p[a].set(lane, sum);
        }
    }
    expected.add(tube.wall, elements, product);
  }
  assembler.finish();
  K.apply(x, y);
  algebra::BlockVector sums(K.space());
  expected.store(fixed, sums);
  TEST_COMPARE(test::norm(sums), >, 1.0);
  TEST_COMPARE(test::relative_difference(y, sums), <, 1e-13);
}

TEUCHOS_UNIT_TEST(nodal_residual, sums_elements_and_faces_and_stores_zeros_in_fixed_rows) {
  const SmallTube tube;
  assembly::NodalResidual R(tube.wall);
  for (std::size_t e = 0; e < tube.wall.tets.size(); e += Pack::size) {
    const assembly::PackedElements elements(e, tube.wall.tets.size());
    Pack number;
    for (int lane = 0; lane < Pack::size; ++lane)
      number.set(lane, tube.wall.tet_number[elements.number[lane]]);
    kernels::MixedResidualOf<Pack> one;
    one.u.fill({number, 2.0 * number, 3.0 * number});
    one.p.fill(4.0 * number);
    R.add(tube.wall, elements, one);
  }
  for (const auto& face : tube.wall.faces) {
    kernels::SurfaceResidual ten;
    ten.u.fill({100, 0, 0});
    R.add(tube.wall, face, ten);
  }
  std::vector<int> tets(tube.mesh.vertices.size(), 0), faces(tets);
  const SmallTube serial(test::alone());
  for (std::size_t e = 0; e < serial.wall.tets.size(); ++e)
    for (const int a : serial.wall.tets[e])
      tets[serial.wall.vertex[a]] += serial.wall.tet_number[e];
  for (const auto& face : serial.wall.faces)
    for (const int a : face.nodes) ++faces[serial.wall.vertex[a]];
  assembly::Constraints fixed(tube.wall.n_nodes());
  for (int a = 0; a < tube.wall.n_nodes(); ++a)
    if (tube.wall.vertex[a] % 2 == 0) fixed.fix_component(a, 1);
  algebra::BlockVector F = fields::zero_vector(tube.wall);
  R.store(fixed, F);
  const auto expected = test::block_vector(tube.wall, [&](int v, int i) {
    return i == 1 && v % 2 == 0 ? 0.0 : (i + 1.0) * tets[v] + (i == 0 ? 100.0 * faces[v] : 0.0);
  });
  TEST_EQUALITY(test::relative_difference(F, expected), 0.0);
}

}  // namespace
