#include "tunica/foreign/default_settings.hpp"

#include <Teuchos_Array.hpp>

#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"

namespace tunica::foreign {

namespace {

/// Factors of larger systems would take more memory than there is (as "direct unknowns" of
/// fallbacks).
constexpr long long most_factored = 300000;

/// Part of the scalar rows with entries in B2 that have a diagonal in C.
double stabilised_part(const algebra::BlockMatrix& K) {
  const auto B2 = K(1, 0)->getLocalMatrixHost(), mC = K(1, 1)->getLocalMatrixHost();
  const Map &rows = *K(1, 1)->getRowMap(), &columns = *K(1, 1)->getColMap();
  double coupled = 0.0, stabilised = 0.0;
  for (int i = 0; i < mC.numRows(); ++i) {
    const auto b = B2.rowConst(i);
    bool is_coupled = false, has_diagonal = false;
    for (int k = 0; k < b.length; ++k) is_coupled = is_coupled || b.value(k) != 0.0;
    const auto c = mC.rowConst(i);
    for (int k = 0; k < c.length; ++k)
      has_diagonal =
          has_diagonal ||
          (columns.getGlobalElement(c.colidx(k)) == rows.getGlobalElement(i) && c.value(k) != 0.0);
    coupled += is_coupled;
    stabilised += is_coupled && has_diagonal;
  }
  coupled = global_sum(*K.comm(), coupled);
  return coupled > 0.0 ? global_sum(*K.comm(), stabilised) / coupled : 0.0;
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

SolverSetting incomplete_factors() {
  Teuchos::ParameterList list;
  list.set("method", "gmres").set("preconditioner", "ilu").set("fill level", 1);
  return resolved("ILU(1)", list);
}

SolverSetting direct() {
  Teuchos::ParameterList list;
  list.set("method", "direct");
  return resolved("direct", list);
}

/// Iterative settings, the likeliest first.
DefaultChoice iterative(const algebra::BlockMatrix& K) {
  if (K.n_blocks() == 1)
    return {{with_cycle("multigrid, Gauss-Seidel", multigrid::nodal_cycle_list(2, 500)),
             incomplete_factors()},
            "one field"};
  const auto by_factors =
      with_cycle("multigrid, incomplete factors", multigrid::mixed_cycle_list(2));
  const auto by_braess =
      with_cycle("multigrid, Braess-Sarazin", multigrid::braess_sarazin_cycle_list(2, 4));
  const auto by_fields = with_preconditioner("field by field", "block");
  if (stabilised_part(K) > 0.5)
    return {{by_factors, by_braess, by_fields, incomplete_factors()}, "C stabilises"};
  return {{by_braess, by_fields, incomplete_factors()}, "C is zero"};
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
      .integer("direct unknowns", 3000, params::between(0, 1e9),
               "without settings: largest system that is solved by sparse LU at first; larger ones "
               "are where all else fails")
      .entries("Settings", solver_table(),
               std::string(settings_sentence) + "; none: chosen by the matrix");
}

DefaultChoice default_settings(const algebra::BlockMatrix& K, int direct_unknowns) {
  DefaultChoice choice = iterative(K);
  if (K.n_unknowns() > direct_unknowns) {
    if (K.n_unknowns() <= most_factored) choice.settings.push_back(direct());
    return choice;
  }
  choice.settings.insert(choice.settings.begin(), direct());
  choice.reason = formatted("at most %d unknowns", direct_unknowns);
  return choice;
}

}  // namespace tunica::foreign
