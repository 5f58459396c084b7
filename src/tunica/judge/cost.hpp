#pragma once
#include <string>

#include "tunica/fields/field_mesh.hpp"

namespace tunica::judge {

/// Cost of a run with monolithic coupling and its default solver, by two straight lines:
///
///   memory of a rank = m₀ + a (m₁ F + m₂ W)      seconds of a step = s₁ (F + W)
///
///   F, W   tetrahedra of fluid and wall that a rank knows: those it counts and those of others
///          around its vertices
///   a      1 on one rank, and 1.2 on several, which keep copies of each other's rows
///
/// The memory is fitted to straight tubes of 39 to 349 thousand tetrahedra on 1 to 4 ranks and to
/// vessels; docs/cluster.md has the runs and how far they are off. The seconds are those of one
/// machine and between those of a pulse in a thick tube, 6 Newton steps with 7 linear iterations,
/// and of vessels of 200,000 tetrahedra at steps of 5 ms, 4 to 7 with 18 to 31: within a factor of
/// 2 of either.
struct Cost {
  double memory_of_rank = 0.0;   ///< that needs most [MB]
  double memory_of_all = 0.0;    ///< [MB]
  double seconds_of_step = 0.0;  ///< with a core for each rank
};

/// Collective.
Cost expected_cost(const fields::FieldMesh& fluid, const fields::FieldMesh& wall);

/// A line of it.
std::string text_of(const Cost& cost, int ranks);

}  // namespace tunica::judge
