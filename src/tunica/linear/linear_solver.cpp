#include "tunica/linear/linear_solver.hpp"

#include "tunica/base/told_apart.hpp"
#include "tunica/linear/solvers/direct_solver.hpp"
#include "tunica/linear/solvers/fallbacks.hpp"
#include "tunica/linear/solvers/solver_chain.hpp"

namespace tunica::linear {

namespace {

/// The keys of a Krylov method that may be one within a preconditioner.
params::Table inner_krylov_table(const SolverDefaults& defaults, bool has_restart,
                                 bool has_recycling = false) {
  params::Table table;
  add_preconditioner_keys(table, defaults);
  table.integer("max iterations", 200, params::between(1, 1e6), "cap on the iterations")
      .number("refresh factor", 1.0, params::non_negative(), "1",
              "within a time step, set up a new preconditioner when the iterations lost by keeping "
              "the old one reach this multiple of the cost of a set-up, and during a solve that a "
              "new one would end sooner; 0: a new one for each matrix");
  if (has_recycling)
    table.integer("recycle", defaults.recycled, params::between(0, 1000),
                  "search directions kept from one right-hand side to the next of the same matrix; "
                  "they need the memory of twice as many vectors");
  if (has_restart)
    table.integer("restart", 200, params::between(1, 1e6), "basis vectors between restarts");
  return table;
}

params::Table krylov_table(const SolverDefaults& defaults, bool has_restart,
                           bool has_recycling = false) {
  params::Table table = inner_krylov_table(defaults, has_restart, has_recycling);
  if (has_recycling)
    table.integer(give_up_at, 0, params::between(0, 1e6),
                  "without \"fallbacks\", a solve that gains no factor 10 in 20 iterations ends "
                  "where at that pace more than so many are to come; 0: at \"max iterations\"");
  add_fallback_keys(table, defaults.fallbacks);
  return table;
}

params::Table direct_table() {
  params::Table table("sparse LU of all unknowns");
  table.number("most operations", 0.0, params::non_negative(), "1",
               "largest number of operations for the factors, per entry of the matrix; beyond, the "
               "solver cannot be set up; 0: any");
  return table;
}

}  // namespace

params::Table linear_solver_table(const SolverDefaults& defaults) {
  // Other methods take no preconditioner that solves within.
  SolverDefaults linear = defaults;
  linear.has_fields = false;
  params::Table table("Solves the linear systems of Newton's method.");
  table.variant("method", "gcr",
                {{"direct", direct_table()},
                 {"flexible gmres", krylov_table(defaults, true)},
                 {"gmres", krylov_table(linear, true)},
                 {"gcr", krylov_table(defaults, true, true)},
                 {"bicgstab", krylov_table(linear, false)},
                 {"tfqmr", krylov_table(linear, false)},
                 {"fixed point", krylov_table(defaults, false)}},
                "sparse direct (MUMPS), a Krylov method (of Belos, except GCR), or the "
                "preconditioner alone, iterated (fixed point)");
  return table;
}

// A field within a preconditioner has no fields in its turn, and no fallbacks: the method around it
// takes care of what is left.
params::Table inner_solver_table(SolverDefaults defaults) {
  defaults.has_fields = false;
  defaults.recycled = 0;
  params::Table table("Solves for one field within a preconditioner.");
  table
      .variant("method", "gcr",
               {{"direct", direct_table()},
                {"gcr", inner_krylov_table(defaults, true, true)},
                {"fixed point", inner_krylov_table(defaults, false)}},
               "sparse direct (MUMPS), GCR, or the preconditioner alone, applied \"max "
               "iterations\" times (fixed point)")
      .number("tolerance", 0.1, params::Range{0.0, 1.0, false, true}, "1",
              "ends at this relative residual, or at \"max iterations\"");
  return table;
}

std::unique_ptr<LinearSolver> make_linear_solver(const Teuchos::ParameterList& options,
                                                 const algebra::BlockMatrix& K,
                                                 const NamedOperators& operators) {
  if (options.get<std::string>("method") == "direct") {
    const char* const key = "most operations";
    return std::make_unique<DirectSolver>(
        K, options.isParameter(key) ? options.get<double>(key) : 0.0);
  }
  // A solver within a preconditioner lacks the key.
  const bool may_fall_back = options.isParameter("fallbacks") && !fallbacks_of(options).empty();
  if (may_fall_back) return std::make_unique<SolverChain>(options, K, operators);
  return std::make_unique<KrylovSolver>(options, K, operators);
}

void add_costs(const SolveReport& of_one, SolveReport& all) {
  all.iterations += of_one.iterations;
  all.operator_applications += of_one.operator_applications;
  all.setup_seconds += of_one.setup_seconds;
  all.solve_seconds += of_one.solve_seconds;
}

std::string describe_unconverged(const SolveReport& report) {
  const auto [found, wanted] = told_apart(report.true_residual, report.tolerance);
  return "the linear solver (" + report.method + ") reached a relative residual of " + found +
         " instead of " + wanted + " in " + std::to_string(report.iterations) + " iterations";
}

}  // namespace tunica::linear
