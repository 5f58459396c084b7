#include "tunica/multigrid/muelu/cycle.hpp"
#include "tunica/multigrid/muelu/nodal_p_factory.hpp"

namespace tunica::multigrid {

namespace {

constexpr int coarsest_mixed = 1500;  ///< unknowns

/// The levels of the nodal coarsening with a smoother named "Sweeps".
Teuchos::ParameterList nodal_levels(const Teuchos::ParameterList& sweeps, int coarse_size) {
  Teuchos::ParameterList list("MueLu");
  // P by nodes, R = Pᵀ (not stored), A_l+1 = R A_l P; sweeps before and behind, sparse LU at the
  // coarsest level
  Teuchos::ParameterList& factories = list.sublist("Factories");
  factories.sublist("Nodes").set("factory", "NodalPFactory");
  factories.sublist("Galerkin")
      .set("factory", "GalerkinFactory")
      .set("P", "Nodes")
      .set("R", "NoFactory");
  factories.sublist("Sweeps") = sweeps;
  factories.sublist("Coarsest").set("factory", "SparseLUSolver");
  Teuchos::ParameterList& hierarchy = list.sublist("Hierarchy");
  hierarchy.set("max levels", 10).set("coarse: max size", coarse_size).set("verbosity", "None");
  hierarchy.set("transpose: use implicit", true);
  hierarchy.sublist("All")
      .set("P", "Nodes")
      .set("R", "NoFactory")
      .set("A", "Galerkin")
      .set("Smoother", "Sweeps")
      .set("CoarseSolver", "Coarsest");
  return list;
}

}  // namespace

// For a definite block: Gauss–Seidel forth and back, so that the cycle is symmetric where A is.
Teuchos::ParameterList nodal_cycle_list(int sweeps, int coarse_size, bool has_w_cycles) {
  Teuchos::ParameterList smoother;
  smoother.set("factory", "Ifpack2Smoother").set("type", "RELAXATION");
  smoother.sublist("ParameterList")
      .set("relaxation: type", "Symmetric Gauss-Seidel")
      .set("relaxation: sweeps", sweeps);
  Teuchos::ParameterList list = nodal_levels(smoother, coarse_size);
  if (!has_w_cycles) list.sublist("Hierarchy").set(Cycle::w_cycles, false);
  return list;
}

// Rotations change nothing where no node belongs to a solid.
Teuchos::ParameterList mixed_cycle_list(int sweeps, const std::string& polynomial,
                                        double rotations_from_contraction, bool has_w_cycles) {
  Teuchos::ParameterList smoother;
  smoother.set("factory", "NodalIluSmoother").set("sweeps", sweeps).set("polynomial", polynomial);
  Teuchos::ParameterList list = nodal_levels(smoother, coarsest_mixed);
  if (!has_w_cycles) list.sublist("Hierarchy").set(Cycle::w_cycles, false);
  list.sublist("Factories")
      .sublist("Nodes")
      .set(NodalPFactory::rotations, true)
      .set(NodalPFactory::rotations_from, rotations_from_contraction);
  return list;
}

Teuchos::ParameterList braess_sarazin_cycle_list(int sweeps, int schur_sweeps) {
  Teuchos::ParameterList smoother;
  smoother.set("factory", "NodalBraessSarazinSmoother")
      .set("sweeps", sweeps)
      .set("schur sweeps", schur_sweeps);
  Teuchos::ParameterList list = nodal_levels(smoother, coarsest_mixed);
  list.sublist("Factories").sublist("Galerkin").set("schur stabilisation", 0.1);
  return list;
}

// The levels of mixed_cycle_list() but for rotations. Each patch is inverted by itself, with row
// exchanges: nothing grows along an order of elimination.
Teuchos::ParameterList vanka_cycle_list(int sweeps) {
  Teuchos::ParameterList smoother;
  smoother.set("factory", "VankaSmoother").set("sweeps", sweeps).set("patch", "node pair");
  return nodal_levels(smoother, coarsest_mixed);
}

}  // namespace tunica::multigrid
