#pragma once
#include <string>
#include <vector>

#include "tunica/linear/linear_solver.hpp"

namespace tunica::foreign {

/// One entry of a list of settings.
struct SolverSetting {
  std::string name;
  Teuchos::ParameterList list;  ///< a resolved "Linear Solver" list
  /// The first setting without patience: for where it has been given up as slow.
  bool is_for_slow = false;
};

/// The keys of a setting for systems that come without named operators.
params::Table solver_table();

/// What a list of settings is.
extern const char* const settings_sentence;
/// Adds the tolerance of all settings.
void add_tolerance_key(params::Table& table);
/// Adds the keys of a list of settings: tolerance, "direct operations", "Settings".
void add_settings_keys(params::Table& table);

/// Settings for a system of another program of which nothing is known but the matrix, to be tried
/// in this order until one converges.
struct DefaultChoice {
  std::vector<SolverSetting> settings;
  std::string reason;       ///< why the first iterative one comes before the others
  double operations = 0.0;  ///< per entry, about, of factors that do not come first; 0: they do, or
                            ///< are not wanted
  bool are_places_wrong = false;  ///< of nodes: rotations are not interpolated with them
};

/// Sparse LU first, for systems whose factors take at most direct_operations per entry of the
/// matrix (half as many for Braess and Sarazin's sweeps where A is plain, a third for incomplete
/// factors in space; 0: none), and last, for all of up to 300,000 unknowns. Between: multigrid for
/// all unknowns, smoothed by incomplete factors where C stabilises, by Braess and Sarazin's sweeps
/// where it is zero or scalars are few; the fields in turn (block LU), which come first where A is
/// diagonal, or near it as a mass of fluxes or a short time step; incomplete factors where C is not
/// zero, since they break down otherwise. For one field multigrid with Gauss-Seidel. The first of
/// these is given up where it is slow and sparse LU takes at most 20,000 operations per entry,
/// 60,000 in space. Collective.
DefaultChoice default_settings(const algebra::BlockMatrix& K, double direct_operations,
                               const linear::NamedOperators& operators = linear::no_operators());

/// `"direct" unless factors are large, "field by field" (C is zero), …`
std::string in_words(const DefaultChoice& choice);

}  // namespace tunica::foreign
