#pragma once
#include <Teuchos_ParameterList.hpp>

#include "multigrid/mixed_coarsening.hpp"

namespace tunica::multigrid {

/// One multigrid cycle for A by a MueLu list in the form of factories and a hierarchy.
/// Throws std::exception for a list that MueLu refuses. Collective.
Teuchos::RCP<Operator> make_cycle(const Teuchos::RCP<CrsMatrix>& A,
                                  const Teuchos::RCP<MixedCoarsening>& coarsening,
                                  const Teuchos::ParameterList& muelu);

/// The matrices of a hierarchy, the finest first.
struct Levels {
  std::vector<long long> unknowns;   ///< of all ranks
  double operator_complexity = 0.0;  ///< entries of all levels to those of the finest
};
/// Of what make_cycle() made. Collective.
Levels levels_of(const Operator& cycle);

/// Builds the factories of such a list without a matrix. Throws tunica::Error for what MueLu
/// refuses; for an unknown factory with the names that are ours.
void check_cycle_list(const Teuchos::ParameterList& muelu);

/// V-cycles on the levels of the nodal coarsening with sweeps of symmetric Gauss-Seidel before
/// and after, sparse LU at the coarsest level of at most coarse_size unknowns.
Teuchos::ParameterList nodal_cycle_list(int sweeps, int coarse_size);

/// The same for a mixed system with four unknowns per node, smoothed by incomplete factors of
/// all of them together.
Teuchos::ParameterList mixed_cycle_list();

}  // namespace tunica::multigrid
