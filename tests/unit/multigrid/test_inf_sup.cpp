#include <Teuchos_BLAS.hpp>
#include <Teuchos_LAPACK.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/assembly/block_assembler.hpp"
#include "tunica/assembly/fluid_assembly.hpp"
#include "tunica/assembly/mass_norm.hpp"
#include "tunica/assembly/solid_assembly.hpp"
#include "tunica/materials/newtonian.hpp"
#include "tunica/materials/registry.hpp"
#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"
#include "unit/fields/small_tube.hpp"

// Stability of the levels of a hierarchy for K = [A B1ᵀ; B2 −C]: the smallest λ of
//
//   (B2 A⁻¹ B1ᵀ + s^l C) p = λ M p        on level l, A and the sum replaced by their symmetric
//   part,
//
// is the square of the generalised inf-sup constant, M the mass matrix of the pressure. On the
// levels of Galerkin's product s = 1; "stabilisation scaling" has other s.

namespace {

using namespace tunica;

/// Column by column.
struct Dense {
  int rows, columns;
  std::vector<double> values;

  Dense(int n_rows, int n_columns)
      : rows(n_rows), columns(n_columns), values(static_cast<std::size_t>(n_rows) * n_columns) {}
  double& operator()(int i, int j) { return values[static_cast<std::size_t>(j) * rows + i]; }
  double operator()(int i, int j) const { return values[static_cast<std::size_t>(j) * rows + i]; }
};

Dense dense(const CrsMatrix& A, double factor = 1.0) {
  Dense D(static_cast<int>(A.getGlobalNumRows()), static_cast<int>(A.getGlobalNumCols()));
  const auto local = A.getLocalMatrixHost();
  for (int i = 0; i < local.numRows(); ++i) {
    const auto row = local.rowConst(i);
    for (int k = 0; k < row.length; ++k)
      D(i, static_cast<int>(A.getColMap()->getGlobalElement(row.colidx(k)))) +=
          factor * row.value(k);
  }
  return D;
}

Dense product(const Dense& A, const Dense& B, bool is_transposed = false) {
  Dense C(is_transposed ? A.columns : A.rows, B.columns);
  Teuchos::BLAS<int, double>().GEMM(
      is_transposed ? Teuchos::TRANS : Teuchos::NO_TRANS, Teuchos::NO_TRANS, C.rows, C.columns,
      B.rows, 1.0, A.values.data(), A.rows, B.values.data(), B.rows, 0.0, C.values.data(), C.rows);
  return C;
}

Dense symmetric(const Dense& A) {
  Dense S(A);
  for (int i = 0; i < A.rows; ++i)
    for (int j = 0; j < A.rows; ++j) S(i, j) = 0.5 * (A(i, j) + A(j, i));
  return S;
}

/// RᵀAP, the Galerkin product.
Dense coarse(const Dense& R, const Dense& A, const Dense& P) {
  return product(R, product(A, P), true);
}

struct Level {
  Dense A, B1T, B2, C, M;

  Level next(const Dense& Pu, const Dense& Pp) const {
    return {coarse(Pu, A, Pu), coarse(Pu, B1T, Pp), coarse(Pp, B2, Pu), coarse(Pp, C, Pp),
            coarse(Pp, M, Pp)};
  }

  /// The part of the velocity, B2 A⁻¹ B1ᵀ.
  Dense schur() const {
    Dense A_s = symmetric(A), X(B1T);
    std::vector<int> exchanged(A.rows);
    int info = 0;
    Teuchos::LAPACK<int, double>().GESV(A.rows, X.columns, A_s.values.data(), A.rows,
                                        exchanged.data(), X.values.data(), A.rows, &info);
    if (info != 0) throw std::runtime_error("LAPACK cannot solve with A");
    return product(B2, X);
  }
};

/// The smallest λ of (S + factor C) p = λ M p.
double smallest(Dense S, double factor, const Level& level) {
  for (std::size_t k = 0; k < S.values.size(); ++k) S.values[k] += factor * level.C.values[k];
  S = symmetric(S);
  Dense mass(level.M);
  std::vector<double> eigenvalues(S.rows), work(8 * S.rows);
  int info = 0;
  Teuchos::LAPACK<int, double>().SYGV(1, 'N', 'U', S.rows, S.values.data(), S.rows,
                                      mass.values.data(), S.rows, eigenvalues.data(), work.data(),
                                      static_cast<int>(work.size()), &info);
  if (info != 0) throw std::runtime_error("LAPACK finds no eigenvalues");
  return eigenvalues[0];
}

/// Twice the small tube, for one level more.
struct Tube {
  Tube()
      : mesh(mesh::make_tube(options())),
        share(test::share_of(mesh, {true, false, false}, test::alone())),
        fluid(fields::make_field_mesh(share, {0})), wall(fields::make_field_mesh(share, {1, 2})) {}

  static mesh::Tube options() {
    mesh::Tube tube = test::SmallTube::options();
    tube.around = 8;
    tube.axial = 12;
    tube.length = 12.0;
    return tube;
  }
  assembly::Constraints fixed(const fields::FieldMesh& field,
                              const std::vector<std::string>& surfaces) const {
    assembly::Constraints constraints(field.n_nodes());
    for (int a = 0; a < field.n_nodes(); ++a)
      for (const std::string& name : surfaces)
        if (field.is_on(a, mesh::surface_index(mesh, name))) constraints.fix_vector(a);
    return constraints;
  }

  mesh::Mesh mesh;
  mesh::Share share;
  fields::FieldMesh fluid, wall;
};

Dense mass(const fields::FieldMesh& mesh) {
  Dense M(mesh.n_owned, mesh.n_owned);
  const auto geometry = assembly::ElementGeometry(mesh, mesh.x);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    for (const int a : mesh.tets[e])
      for (const int b : mesh.tets[e]) M(a, b) += geometry[e].volume / 20.0 * (a == b ? 2.0 : 1.0);
  return M;
}

/// The levels of a system, made as a hierarchy makes them.
std::vector<Level> levels_of(const fields::BlockOperator& K) {
  std::vector<Level> levels{
      {dense(*K(0, 0)), dense(*K(0, 1)), dense(*K(1, 0)), dense(*K(1, 1), -1.0), mass(K.mesh())}};
  multigrid::MixedCoarsening coarsening(*K.space());
  Teuchos::RCP<const Map> vectors = (*K.space())[0].map, scalars = (*K.space())[1].map;
  for (int level = 0;; ++level) {
    const auto Pu = coarsening.prolongator(level, *vectors);
    const auto Pp = coarsening.prolongator(level, *scalars);
    if (Pp->getGlobalNumCols() <= 3) return levels;
    levels.push_back(levels.back().next(dense(*Pu), dense(*Pp)));
    vectors = Pu->getDomainMap();
    scalars = Pp->getDomainMap();
  }
}

/// Stokes flow at rest with the walls and the inlet held; inv_dt = 0: steady.
std::vector<Level> fluid_levels(double inv_dt) {
  const Tube tube;
  const fields::FieldMesh& mesh = tube.fluid;
  assembly::FluidElements elements;
  elements.geometry = assembly::ElementGeometry(mesh, mesh.x);
  const materials::Newtonian viscosity(3.5e-3);
  elements.coefficients = {1.0, &viscosity, inv_dt};
  elements.viscosity.assign(mesh.tets.size(), viscosity.reference());
  const std::vector<Vec3> none(mesh.n_nodes());
  const assembly::FluidFields state{none, std::vector<double>(mesh.n_nodes()), none, none, none};
  elements.tau = assembly::fluid_taus(mesh, elements, none, none);
  fields::BlockOperator K(mesh);
  const auto fixed = tube.fixed(mesh, {"interface", "inlet"});
  assembly::NodalResidual R(mesh);
  assembly::BlockAssembler assembler(K, fixed);
  assembly::assemble_fluid(mesh, elements, state, R, &assembler);
  assembler.finish();
  return levels_of(K);
}

/// The undeformed wall, clamped at one end; alpha = 0: static. τ = h²/(4 μ) as in the paper.
std::vector<Level> wall_levels(double alpha) {
  const Tube tube;
  const fields::FieldMesh& mesh = tube.wall;
  const auto law = materials::make_law("mooney-rivlin", {});
  assembly::SolidElements elements;
  elements.geometry = assembly::ElementGeometry(mesh, mesh.x);
  elements.layers = {{law.get(), 1.2, {alpha, 1e-5, 0.0}}};
  elements.layer_number.assign(mesh.tets.size(), 0);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const double h = kernels::element_length(elements.geometry[e].volume);
    elements.tau.push_back(h * h / (4.0 * law->stabilisation_modulus()));
  }
  const std::vector<Vec3> none(mesh.n_nodes());
  fields::BlockOperator K(mesh);
  const auto fixed = tube.fixed(mesh, {"struct_in"});
  assembly::NodalResidual R(mesh);
  assembly::BlockAssembler assembler(K, fixed);
  assembly::assemble_solid(mesh, elements, {none, std::vector<double>(mesh.n_nodes()), none}, R,
                           &assembler);
  assembler.finish();
  return levels_of(K);
}

/// λ of a level for s = 1, 2, 4, without C, and with so much of it that only smooth pressures,
/// which it does not reach, have a small λ.
struct Stability {
  double plain, two, four, none, ample;
};

std::vector<Stability> study(const std::string& name, const std::vector<Level>& levels,
                             std::ostream& out) {
  out << name << ": nodes, λ for s = 1, 2, 4, without C, with 1000 C\n";
  std::vector<Stability> all;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const Dense S = levels[l].schur();
    const auto power = static_cast<double>(l);
    const auto lambda = [&](double factor) { return smallest(S, factor, levels[l]); };
    const Stability now{lambda(1.0), lambda(std::pow(2.0, power)), lambda(std::pow(4.0, power)),
                        lambda(0.0), lambda(1000.0)};
    out << "  " << levels[l].M.rows << "  " << now.plain << "  " << now.two << "  " << now.four
        << "  " << now.none << "  " << now.ample << "\n";
    all.push_back(now);
  }
  return all;
}

TEUCHOS_UNIT_TEST(inf_sup, levels_without_stabilisation_are_not_stable) {
  const auto wall = study("static wall", wall_levels(0.0), out);
  for (const Stability& level : wall) TEST_COMPARE(level.none, <, 0.02 * wall[0].plain);
}

TEUCHOS_UNIT_TEST(inf_sup, galerkin_levels_keep_a_tenth_of_the_stability_of_the_finest) {
  for (const auto& levels :
       {study("steady fluid", fluid_levels(0.0), out), study("static wall", wall_levels(0.0), out)})
    for (const Stability& level : levels) TEST_COMPARE(level.plain, >, 0.08 * levels[0].plain);
}

/// What it lacks is due to C in the wall, whose coarse levels keep most with the right one, and to
/// the few nodes of the coarsest level there and of those in the fluid, where no C helps.
TEUCHOS_UNIT_TEST(inf_sup, four_times_the_stabilisation_per_level_keeps_most_of_it_in_the_wall) {
  const auto wall = study("static wall", wall_levels(0.0), out);
  for (const Stability& level : wall) {
    TEST_COMPARE(level.four, >, std::min(0.6 * wall[0].plain, 0.3 * level.ample));
    TEST_COMPARE(level.two, <=, level.four + 1e-12);
  }
  TEST_COMPARE(wall.back().plain, <, 0.3 * wall[0].plain);
  const auto fluid = study("steady fluid", fluid_levels(0.0), out);
  for (const Stability& level : fluid) TEST_COMPARE(level.plain, >, 0.5 * level.ample);
}

/// λ depends on the step where inertia dominates A, and has no common scale on the levels.
TEUCHOS_UNIT_TEST(inf_sup, levels_of_unsteady_systems_are_stable) {
  for (const auto& levels :
       {study("fluid", fluid_levels(8.0), out), study("wall", wall_levels(123.0), out)})
    for (const Stability& level : levels) {
      TEST_COMPARE(level.plain, >, 0.0);
      TEST_COMPARE(level.four, >=, level.plain);
    }
}

}  // namespace
