#include "tunica/foreign/default_settings.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>

#include "tunica/algebra/is_diagonal.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/foreign/factor_cost.hpp"
#include "tunica/foreign/given_operators.hpp"
#include "tunica/foreign/matrix_traits.hpp"
#include "tunica/foreign/rigid_fit.hpp"
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

/// Part of the scalars that must have it. Where a single one without ends the factors, the next
/// setting follows.
constexpr double most_of_own = 0.9;

SolverSetting resolved(const std::string& name, Teuchos::ParameterList list) {
  solver_table().resolve(list, "", "");
  return {name, list};
}

SolverSetting with_cycle(const std::string& name, const Teuchos::ParameterList& cycle) {
  Teuchos::ParameterList list;
  list.set("method", "gcr").set("preconditioner", "multigrid");
  list.sublist("MueLu") = cycle;
  return resolved(name, list);
}

/// Block LU; schur_sweeps: in each cycle for S, before and after its coarser levels.
SolverSetting by_blocks(const std::string& name, int schur_sweeps, const std::string& schur) {
  Teuchos::ParameterList list;
  list.set("method", "gcr").set("preconditioner", "block");
  list.sublist("Stratimikos") = linear::default_block_preconditioner(1, schur_sweeps, schur);
  return resolved(name, list);
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

/// The first setting, given up where it is slow; factors; the first one to its end.
void insert_factors_of_slow(double most_operations, std::vector<SolverSetting>& all) {
  const SolverSetting first = all.front();
  all.front().name += " to the end";
  all.front().is_for_slow = true;
  all.insert(all.begin(),
             {with_patience(first), direct("direct where that is slow", most_operations)});
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

/// Part of its Schur complement that C has on coarse levels at least. Stokes flow in the plane with
/// half a million unknowns takes 6, 8, 14 iterations on 1, 2, 4 ranks without, 4 with; parts
/// between 0.1 and 0.7 make little difference. With convection it takes more: 14 without, 18 to 29
/// with.
constexpr double least_stabilisation = 0.4;

SolverSetting by_factors_of_nodes(int sweeps, double stabilisation, const RigidFit& fit) {
  Teuchos::ParameterList cycle = with_rotations(multigrid::mixed_cycle_list(sweeps), fit);
  cycle.sublist("Factories").sublist("Galerkin").set("least stabilisation", stabilisation);
  return with_cycle("multigrid, incomplete factors", cycle);
}

/// Iterative settings, the likeliest first.
DefaultChoice iterative(const algebra::BlockMatrix& K, const linear::NamedOperators& operators,
                        const RigidFit& fit) {
  if (K.n_blocks() == 1)
    return {{with_cycle("multigrid, Gauss-Seidel",
                        with_rotations(multigrid::nodal_cycle_list(2, 500), fit)),
             incomplete_factors()},
            "one field"};
  const auto by_braess = with_cycle(
      "multigrid, Braess-Sarazin", with_rotations(multigrid::braess_sarazin_cycle_list(2, 4), fit));
  const auto by_fields = by_blocks("field by field", 1, "Algebraic");
  const auto names = operators.operator_names();
  if (std::count(names.begin(), names.end(), GivenOperators::schur) > 0)
    return {{by_blocks("field by field, S given", 1, "Given"), by_braess, by_fields,
             incomplete_factors()},
            "S is given"};
  // C + B2 A⁻¹ B1ᵀ is exact, and there is nothing to coarsen in A.
  if (algebra::is_diagonal(*K(0, 0)))
    return {{by_fields, by_braess, incomplete_factors()}, "A is diagonal"};
  const Pivots pivots = find_pivots(K);
  const bool is_stabilised = pivots.of_c > 0.5;
  // Fluxes through faces, with a Schur complement as that of a Laplacian. With vectors at nodes and
  // masses in A, as in optimal control, it may be one of fourth order, of which fields make little.
  const bool has_fluxes = (*K.space())[0].components == 1;
  if (!is_stabilised && has_fluxes && is_near_its_diagonal(*K(0, 0)))
    return {{by_blocks("field by field", 2, "Algebraic"), by_braess}, a_is_near_diagonal};
  // One unknown of a field alone is no node. A second sweep saves a quarter of the cycles and makes
  // each half as dear again.
  if (!is_stabilised && !has_fluxes && pivots.of_own > most_of_own)
    return {{by_factors_of_nodes(1, 0.0, fit), by_braess, by_fields, incomplete_factors()},
            nodes_have_pivots};
  if (!is_stabilised) return {{by_braess, by_fields}, c_is_zero};
  const auto by_factors =
      by_factors_of_nodes(2, is_nearly_symmetric(*K(0, 0)) ? least_stabilisation : 0.0, fit);
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
