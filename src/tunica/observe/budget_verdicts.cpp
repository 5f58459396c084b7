#include <algorithm>
#include <cmath>

#include "tunica/base/formatted.hpp"
#include "tunica/observe/budget.hpp"
#include "tunica/observe/budget_columns.hpp"

namespace tunica::observe {

namespace {

constexpr const char* budget_key = "budget";
constexpr const char* solver_bound_key = "budget solver bound";
constexpr const char* scheme_bound_key = "budget scheme bound";

/// det F between these is usual, as for the warnings of a run.
constexpr double usual_change_of_volume = 0.1;

/// Residuals of single vertices do not cancel as their sum does.
constexpr double of_vertices = 10.0;

/// All where there is nothing to be part of.
double part_of(double amount, double whole) {
  if (amount == 0.0) return 0.0;
  return whole == 0.0 ? 1.0 : amount / whole;
}

/// Of what solvers left, or of what the discretisation made.
Verdict of_solver(const std::string& of, const std::string& sentence, double amount, double whole,
                  double bound) {
  return {of, sentence, amount, whole, part_of(amount, whole), bound, true};
}
Verdict of_scheme(const std::string& of, const std::string& sentence, double amount, double whole,
                  double bound) {
  return {of, sentence, amount, whole, part_of(amount, whole), bound, false};
}

std::string amounts(const char* what, double amount, double whole, const char* of) {
  return formatted("%s %.2g of %.3g %s", what, amount, whole, of);
}

}  // namespace

void add_budget_keys(params::Table& table) {
  table
      .flag(budget_key, true,
            "keep a budget of mass, momentum, energy and volume: budget.csv, with totals and "
            "verdicts at the end of the run")
      .number(solver_bound_key, 1e-6, params::positive(), "1",
              "largest error that solvers may leave in a total, in parts of what flows or acts")
      .number(scheme_bound_key, 0.05, params::positive(), "1",
              "largest part of a total that the discretisation may take out or bring in");
}

BudgetSettings budget_settings(const Teuchos::ParameterList& output) {
  if (!output.isParameter(budget_key)) return {};
  return {output.get<bool>(budget_key), output.get<double>(solver_bound_key),
          output.get<double>(scheme_bound_key)};
}

std::string text_of(const Verdict& v) {
  return formatted("%s: %s: %.1e, %s %g", v.of.c_str(), v.sentence.c_str(), v.part,
                   v.is_kept() ? "within" : "BEYOND", v.bound);
}

std::vector<Verdict> Budget::verdicts() const {
  std::vector<Verdict> all;
  if (fluid_ != nullptr) add_verdicts_of_flow(all);
  add_verdicts_of_forces(all);
  if (has_energy_) add_verdicts_of_energy(all);
  if (wall_ != nullptr) add_verdicts_of_wall(all);
  const double of_forces = part_of(total("force_residual_mN"), total("forces_mN"));
  const double of_mass = part_of(total("mass_residual_mm3_per_ms"), total("throughput_mm3_per_ms"));
  all.push_back(of_solver("residuals",
                          formatted("solvers left %.1e of the forces, %.1e of the flow at vertices",
                                    of_forces, of_mass),
                          std::max(of_forces, of_mass), 1.0, of_vertices * settings_.solver_bound));
  const double steps = total("steps"), unconverged = total("unconverged");
  all.push_back(of_solver("steps", formatted("%.0f of %.0f are not converged", unconverged, steps),
                          unconverged, steps, 0.0));
  return all;
}

void Budget::add_verdicts_of_flow(std::vector<Verdict>& all) const {
  constexpr const char* flowed = "mm^3 that flowed";
  const double flow = total("throughput_mm3_per_ms");
  const double lost = size("mass_error_mm3_per_ms");
  const double made = std::abs(total("volume_scheme_mm3_per_ms"));
  all.push_back(of_solver("mass", amounts("solvers lost or gained", lost, flow, flowed), lost, flow,
                          settings_.solver_bound));
  all.push_back(of_scheme("volume", amounts("time steps made", made, flow, flowed), made, flow,
                          settings_.scheme_bound));
}

void Budget::add_verdicts_of_forces(std::vector<Verdict>& all) const {
  constexpr const char* acted = "mN ms that acted";
  Vec3 error{}, scheme{};
  for (int i = 0; i < 3; ++i) {
    error[i] = size(force_column("force_error", i));
    scheme[i] = total(force_column("momentum_scheme", i));
  }
  const double forces = total("forces_mN"), left = norm(error), made = norm(scheme);
  all.push_back(of_solver("forces", amounts("solvers left", left, forces, acted), left, forces,
                          settings_.solver_bound));
  all.push_back(of_scheme("momentum", amounts("the scheme made", made, forces, acted), made, forces,
                          settings_.scheme_bound));
}

// What the discretisation takes out by one term and brings in by another does not cancel.
void Budget::add_verdicts_of_energy(std::vector<Verdict>& all) const {
  constexpr const char* work_done = "kPa mm^3 of work";
  const double left = size(std::string("power_error") + power_unit);
  double work = 0.0, made = 0.0;
  for (const char* name : physical_powers) work += 0.5 * size(name + std::string(power_unit));
  for (const char* name : powers_of_scheme) made += std::abs(total(name + std::string(power_unit)));
  all.push_back(of_solver("energy", amounts("solvers left", left, work, work_done), left, work,
                          settings_.solver_bound));
  all.push_back(of_scheme("losses", amounts("the scheme took", made, work, work_done), made, work,
                          settings_.scheme_bound));
}

void Budget::add_verdicts_of_wall(std::vector<Verdict>& all) const {
  const double left = at(worst_, "wall volume");
  all.push_back(of_solver("wall volume", formatted("solvers left at most %.2g of it", left), left,
                          1.0, settings_.solver_bound));
  if (worst_.count("det F above") == 0) return;
  const double off = std::max(at(worst_, "det F above"), at(worst_, "det F below"));
  all.push_back(of_scheme("det F", formatted("98 %% of the elements within %.2g of 1", off), off,
                          1.0, usual_change_of_volume));
}

discretisation::Observables Budget::energies() const {
  discretisation::Observables all;
  if (!has_energy_) return all;
  for (const Power& power : powers)
    all.push_back({power.name, power.sign * total(power.name + std::string(power_unit))});
  for (const char* name : {"scheme_power", "energy_change"})
    all.push_back({name, total(name + std::string(power_unit))});
  return all;
}

}  // namespace tunica::observe
