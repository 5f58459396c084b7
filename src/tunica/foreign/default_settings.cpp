#include "tunica/foreign/default_settings.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/algebra/independent_set.hpp"
#include "tunica/algebra/is_diagonal.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/foreign/factor_cost.hpp"
#include "tunica/foreign/given_operators.hpp"
#include "tunica/foreign/rigid_fit.hpp"
#include "tunica/linear/solvers/conjugate_gradients.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"

namespace tunica::foreign {

namespace {

/// Factors of larger systems would take more memory than there is (as "direct unknowns" of
/// fallbacks).
constexpr long long most_factored = 300000;

const char* const first_direct = "direct";
const char* const c_stabilises = "C stabilises";
const char* const nodes_have_pivots = "C is zero, but each node has a pivot";
const char* const c_is_zero = "C is zero";
const char* const c_is_small = "few scalars";
const char* const a_is_near_diagonal = "A is near its diagonal";

/// Iterations that may be to come before sparse LU is tried, and the operations per entry for which
/// it takes as long: a cycle takes as long as 180 to 340, and in space, where fronts are larger and
/// dense products with them quicker, three times as many.
constexpr int most_to_come = 100;
constexpr double operations_in_plane = 200.0 * most_to_come;
constexpr double operations_in_space = 3.0 * operations_in_plane;

/// Part of the pivot B2 diag(A)⁻¹ B2ᵀ of a scalar that has to come from the vectors of its own node
/// for incomplete factors of nodes. Of flows it is nothing inside the domain, of optimal control
/// 0.8.
constexpr double enough_of_own = 0.3;

/// Part of the scalars that must have it. Where a single one without ends the factors, the next
/// setting follows.
constexpr double most_of_own = 0.9;

/// Parts of the scalar rows with entries in B2.
struct Pivots {
  double of_c = 0.0;    ///< that have a diagonal in C
  double of_own = 0.0;  ///< that have enough of their pivot from their own node
};

// b_i = Σ_c B2_ic² / |A_cc|, of all vectors c and of those of the node
Pivots find_pivots(const algebra::BlockMatrix& K) {
  const auto B2 = K(1, 0)->getLocalMatrixHost(), mC = K(1, 1)->getLocalMatrixHost();
  const Map &rows = *K(1, 1)->getRowMap(), &columns = *K(1, 1)->getColMap(),
            &vectors = *K(1, 0)->getColMap();
  const int components = (*K.space())[0].components;
  Vector D(K(0, 0)->getRowMap());
  K(0, 0)->getLocalDiagCopy(D);
  const Vector on_columns = algebra::on_columns(*K(1, 0), D);
  const auto diagonal = on_columns.getLocalViewHost(read_only);
  double coupled = 0.0, with_c = 0.0, with_own = 0.0;
  for (int i = 0; i < mC.numRows(); ++i) {
    const GlobalOrdinal own = rows.getGlobalElement(i);
    double pivot = 0.0, of_own = 0.0;
    const auto b = B2.rowConst(i);
    for (int k = 0; k < b.length; ++k) {
      if (b.value(k) == 0.0) continue;  // also where A has no diagonal
      const double part = b.value(k) * b.value(k) / std::abs(diagonal(b.colidx(k), 0));
      pivot += part;
      if (vectors.getGlobalElement(b.colidx(k)) / components == own) of_own += part;
    }
    const auto c = mC.rowConst(i);
    bool has_diagonal = false;
    for (int k = 0; k < c.length; ++k)
      has_diagonal =
          has_diagonal || (columns.getGlobalElement(c.colidx(k)) == own && c.value(k) != 0.0);
    const bool is_coupled = pivot > 0.0;
    coupled += is_coupled;
    with_c += is_coupled && has_diagonal;
    with_own += is_coupled && of_own > enough_of_own * pivot;
  }
  const std::vector<double> all =
      global_sum(*K.comm(), std::vector<double>{coupled, with_c, with_own});
  return all[0] > 0.0 ? Pivots{all[1] / all[0], all[2] / all[0]} : Pivots{};
}

/// Values between -1 and 1 by the numbers of the rows, the same on any number of ranks.
Vector scattered_values(const Teuchos::RCP<const Map>& map) {
  Vector values(map);
  const auto view = values.getLocalViewHost(overwrite_all);
  const auto numbers = global_numbers(*map);
  for (int i = 0; i < static_cast<int>(numbers.size()); ++i)
    view(i, 0) = 2.0 * std::fmod(0.6180339887498949 * double(numbers[i] + 1), 1.0) - 1.0;
  return values;
}

/// Conjugate gradients with the diagonal gain this factor in so many iterations where A is no
/// further from it than a mass matrix, κ(D⁻¹A) < 20 or so, on any mesh.
constexpr int few_iterations = 10;
constexpr double near_gain = 0.01;

// A x = b with b of any kind, preconditioned by D
bool is_near_its_diagonal(const CrsMatrix& A) {
  Vector D(A.getRowMap());
  A.getLocalDiagCopy(D);
  CrsMatrix inverse(A.getRowMap(), A.getRowMap(), 1);
  const auto diagonal = D.getLocalViewHost(read_only);
  for (int i = 0; i < static_cast<int>(diagonal.extent(0)); ++i) {
    const double value = 1.0 / diagonal(i, 0);  // no number where D is zero, which ends the solve
    inverse.insertLocalValues(i, 1, &value, &i);
  }
  inverse.fillComplete();
  Vector r = scattered_values(A.getRowMap()), x(A.getRowMap());
  const double goal = near_gain * r.norm2();
  linear::conjugate_gradients(A, inverse, {goal}, few_iterations, r, x);
  return r.norm2() <= goal;
}

/// Sum of a row's entries in its own component over the diagonal, from which on A is next to a
/// mass: it is 2.5 of that of linear tetrahedra and 3.4 of bricks, 0 of what is a derivative.
/// At 1.9 the fields take a third of the time away, but grow from 7 to 11 iterations where
/// multigrid takes 6.
constexpr double next_to_mass = 2.2;

// Σ_j A_rj ≥ 2.2 A_rr over the unknowns j of the component of r, in most of the rows that are not
// those of known values
bool is_mostly_mass(const CrsMatrix& A, int components) {
  const auto local = A.getLocalMatrixHost();
  const Map &rows = *A.getRowMap(), &columns = *A.getColMap();
  std::vector<double> counts(2, 0.0);
  for (int r = 0; r < local.numRows(); ++r) {
    const GlobalOrdinal own = rows.getGlobalElement(r);
    const auto row = local.rowConst(r);
    double sum = 0.0, diagonal = 0.0;
    for (int k = 0; k < row.length; ++k) {
      const GlobalOrdinal other = columns.getGlobalElement(row.colidx(k));
      if (other % components == own % components) sum += row.value(k);
      if (other == own) diagonal = row.value(k);
    }
    const bool is_coupled = sum != diagonal;
    counts[0] += is_coupled;
    counts[1] += is_coupled && std::abs(sum) >= next_to_mass * std::abs(diagonal);
  }
  const std::vector<double> all = global_sum(*rows.getComm(), counts);
  return 2.0 * all[1] > all[0];
}

SolverSetting resolved(const std::string& name, Teuchos::ParameterList list) {
  solver_table().resolve(list, "", "");
  return {name, list};
}

SolverSetting with_preconditioner(const std::string& name, const std::string& preconditioner) {
  Teuchos::ParameterList list;
  list.set("method", "gcr").set("preconditioner", preconditioner);
  return resolved(name, list);
}

SolverSetting with_cycle(const std::string& name, const Teuchos::ParameterList& cycle) {
  Teuchos::ParameterList list;
  list.set("method", "gcr").set("preconditioner", "multigrid");
  list.sublist("MueLu") = cycle;
  return resolved(name, list);
}

/// Block LU with what the user knows of S.
SolverSetting by_given_schur() {
  Teuchos::ParameterList list;
  list.set("method", "gcr").set("preconditioner", "block");
  list.sublist("Stratimikos") = linear::default_block_preconditioner(1, 1, "Given");
  return resolved("field by field, S given", list);
}

/// The setting, given up for another where it is slow.
SolverSetting with_patience(SolverSetting setting) {
  setting.list.set(linear::give_up_at, most_to_come);
  return setting;
}

SolverSetting incomplete_factors() {
  Teuchos::ParameterList list;
  list.set("method", "gmres").set("preconditioner", "ilu").set("fill level", 1);
  return resolved("ILU(1)", list);
}

SolverSetting direct(const std::string& name, double most_operations) {
  Teuchos::ParameterList list;
  list.set("method", "direct").set("most operations", most_operations);
  return resolved(name, list);
}

/// Of elements as Taylor and Hood's, with several times as many vectors as scalars, C is small, and
/// the incomplete factors of the nodes grow.
bool are_scalars_few(const algebra::BlockMatrix& K) {
  const int components = (*K.space())[0].components;
  return 2 * components * K(1, 1)->getGlobalNumRows() < K(0, 0)->getGlobalNumRows();
}

/// The first setting, given up where it is slow; factors; the first one to its end.
void insert_factors_of_slow(double most_operations, std::vector<SolverSetting>& all) {
  const SolverSetting first = all.front();
  all.front().name += " to the end";
  all.front().is_for_slow = true;
  all.insert(all.begin(),
             {with_patience(first), direct("direct where that is slow", most_operations)});
}

/// Largest entry on the diagonal against the smallest, up to which a coefficient is mild.
constexpr double mild = 1000.0;

/// Nodes of vectors for each scalar, beyond which scalars stand on a boundary alone.
constexpr int many_nodes = 10;

/// Whether A is a Laplacian of each component by itself, with a mild coefficient, or as plain as
/// one. Means of coarse vectors then serve; where components are coupled, as in elasticity, or the
/// coefficient jumps, cycles by Braess and Sarazin contract by 0.8 and less.
bool is_plain(const algebra::BlockMatrix& K) {
  const int components = (*K.space())[0].components;
  if (many_nodes * components * K(1, 1)->getGlobalNumRows() < K(0, 0)->getGlobalNumRows())
    return false;
  const auto A = K(0, 0)->getLocalMatrixHost();
  const Map &rows = *K(0, 0)->getRowMap(), &columns = *K(0, 0)->getColMap();
  double across = 0.0, within = 0.0, largest = 0.0, smallest = std::numeric_limits<double>::max();
  for (int i = 0; i < A.numRows(); ++i) {
    const GlobalOrdinal number = rows.getGlobalElement(i);
    const auto row = A.rowConst(i);
    for (int k = 0; k < row.length; ++k) {
      const GlobalOrdinal other = columns.getGlobalElement(row.colidx(k));
      (other % components == number % components ? within : across) += row.value(k) * row.value(k);
      if (other != number) continue;
      largest = std::max(largest, std::abs(row.value(k)));
      smallest = std::min(smallest, std::abs(row.value(k)));
    }
  }
  const Comm& comm = *K.comm();
  return global_sum(comm, across) < 1e-12 * global_sum(comm, within) &&
         global_max(comm, largest) < mild * global_min(comm, smallest);
}

/// Operations per entry up to which sparse LU comes first. In the plane it then takes as long as
/// multigrid, or as cycles by Braess and Sarazin that are soon found slow, and half where A is
/// plain and they are quick. Of nodes in space, whose systems have three times as many entries in a
/// row, incomplete factors take fewer; so do those of optimal control, whose cycles contract by a
/// fifth.
double break_even(const DefaultChoice& choice, const algebra::BlockMatrix& K, double operations) {
  if (choice.reason == c_is_zero || choice.reason == c_is_small)
    return is_plain(K) ? 0.5 * operations : operations;
  const bool is_in_space = (*K.space())[0].components >= 3;
  const bool is_cheap =
      (is_in_space && choice.reason == c_stabilises) || choice.reason == nodes_have_pivots;
  return is_cheap ? operations / 3.0 : operations;
}

/// RigidFit::resting of places that are those of A. Of clamped solids in the arena it is 0.93 to
/// 0.99, with their places in another order 0.03 to 0.06.
constexpr double least_resting = 0.2;

/// RigidFit::centred of regular meshes.
constexpr double least_centred = 0.2;

/// Contraction of an iteration from which on rotations are interpolated elsewhere, as of vessels.
constexpr double slow = 0.25;

bool are_places_wrong(const algebra::BlockMatrix& K, const RigidFit& fit) {
  return !(*K.space())[0].nodes.places.coordinates.is_null() && fit.resting < least_resting;
}

/// Levels that interpolate rotations where the places of nodes fit: from the start where it costs
/// next to nothing, since means are exact in the middle of regular meshes; elsewhere, where the
/// set-up takes twice as long, once iterations are slow without.
Teuchos::ParameterList with_rotations(Teuchos::ParameterList cycle, const RigidFit& fit) {
  cycle.sublist("Factories")
      .sublist("Nodes")
      .set("rotations", fit.resting >= least_resting)
      .set("rotations from", fit.centred >= least_centred ? 0.0 : slow);
  return cycle;
}

SolverSetting by_factors_of_nodes(int sweeps, const RigidFit& fit) {
  return with_cycle("multigrid, incomplete factors",
                    with_rotations(multigrid::mixed_cycle_list(sweeps), fit));
}

/// Iterative settings, the likeliest first.
DefaultChoice iterative(const algebra::BlockMatrix& K, const linear::NamedOperators& operators,
                        const RigidFit& fit) {
  if (K.n_blocks() == 1)
    return {{with_cycle("multigrid, Gauss-Seidel",
                        with_rotations(multigrid::nodal_cycle_list(2, 500), fit)),
             incomplete_factors()},
            "one field"};
  const auto by_factors = by_factors_of_nodes(2, fit);
  const auto by_braess = with_cycle(
      "multigrid, Braess-Sarazin", with_rotations(multigrid::braess_sarazin_cycle_list(2, 4), fit));
  const auto by_fields = with_preconditioner("field by field", "block");
  const auto names = operators.operator_names();
  if (std::count(names.begin(), names.end(), GivenOperators::schur) > 0)
    return {{by_given_schur(), by_braess, by_fields, incomplete_factors()}, "S is given"};
  // C + B2 A⁻¹ B1ᵀ is exact, and there is nothing to coarsen in A.
  if (algebra::is_diagonal(*K(0, 0)))
    return {{by_fields, by_braess, incomplete_factors()}, "A is diagonal"};
  const Pivots pivots = find_pivots(K);
  const bool is_stabilised = pivots.of_c > 0.5;
  // Fluxes through faces, with a Schur complement as that of a Laplacian. With vectors at nodes and
  // masses in A, as in optimal control, it may be one of fourth order, of which fields make little.
  const bool has_fluxes = (*K.space())[0].components == 1;
  if (!is_stabilised && has_fluxes && is_near_its_diagonal(*K(0, 0)))
    return {{by_fields, by_braess}, a_is_near_diagonal};
  // One unknown of a field alone is no node. A second sweep saves a quarter of the cycles and makes
  // each half as dear again.
  if (!is_stabilised && !has_fluxes && pivots.of_own > most_of_own)
    return {{by_factors_of_nodes(1, fit), by_braess, by_fields, incomplete_factors()},
            nodes_have_pivots};
  if (!is_stabilised) return {{by_braess, by_fields}, c_is_zero};
  // Of short time steps: the Schur complement is a Laplacian, and there is little to smooth in A.
  if (is_mostly_mass(*K(0, 0), (*K.space())[0].components) && is_near_its_diagonal(*K(0, 0)))
    return {{by_fields, by_factors, by_braess, incomplete_factors()}, a_is_near_diagonal};
  if (are_scalars_few(K)) return {{by_braess, by_fields, incomplete_factors()}, c_is_small};
  return {{by_factors, by_braess, by_fields, incomplete_factors()}, c_stabilises};
}

}  // namespace

params::Table solver_table() {
  linear::SolverDefaults defaults;
  defaults.block = linear::default_block_preconditioner(1, 1, "Algebraic");
  return linear::linear_solver_table(defaults);
}

const char* const settings_sentence =
    "settings to compare, each like a \"Linear Solver\" list; the first is the reference for the "
    "others";

void add_tolerance_key(params::Table& table) {
  table.number("tolerance", 1e-8, params::Range{0.0, 1.0, true, true}, "1",
               "reduction of the residual that every setting has to reach");
}

void add_settings_keys(params::Table& table) {
  add_tolerance_key(table);
  table
      .number("direct operations", 3000.0, params::non_negative(), "1",
              "without settings: sparse LU comes first where its factors take at most so many "
              "operations per entry of the matrix; others come where all else fails")
      .entries("Settings", solver_table(),
               std::string(settings_sentence) + "; none: chosen by the matrix");
}

DefaultChoice default_settings(const algebra::BlockMatrix& K, double direct_operations,
                               const linear::NamedOperators& operators) {
  const RigidFit fit = rigid_fit(K);
  DefaultChoice choice = iterative(K, operators, fit);
  choice.are_places_wrong = are_places_wrong(K, fit);
  std::vector<SolverSetting>& all = choice.settings;
  if (direct_operations > 0.0) {
    const double most = break_even(choice, K, direct_operations);
    const bool is_in_space = (*K.space())[0].components >= 3;
    const double most_of_slow = is_in_space ? operations_in_space : operations_in_plane;
    const double about = operations_by_vectors(K, std::max(most, most_of_slow));
    // In space factors of whatever is large take more than any number of cycles.
    if (!is_in_space || (about > 0.0 && about <= most_of_slow))
      insert_factors_of_slow(most_of_slow, all);
    if (is_factoring_dear(K, about, most))
      choice.operations = about;
    else
      all.insert(all.begin(), direct(first_direct, most));
  }
  if (K.n_unknowns() <= most_factored) choice.settings.push_back(direct("direct at any cost", 0.0));
  return choice;
}

std::string in_words(const DefaultChoice& choice) {
  const std::string& first = choice.settings.front().name;
  const bool is_direct = first == first_direct && choice.settings.size() > 1;
  const std::string& other = choice.settings[is_direct ? 1 : 0].name;
  std::string reason = choice.reason;
  if (choice.operations > 0.0)
    reason += formatted("; sparse LU would take some %.0f operations per entry", choice.operations);
  if (choice.are_places_wrong)
    reason +=
        "; \"coordinates\" are left aside: A resists small rotations about its nodes, as it does "
        "where these are in another order";
  return (is_direct ? "\"" + first + "\" unless its factors are large, then " : std::string()) +
         "\"" + other + "\" (" + reason + ")";
}

}  // namespace tunica::foreign
