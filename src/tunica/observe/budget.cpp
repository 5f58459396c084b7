#include "tunica/observe/budget.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/discretisation/balance.hpp"
#include "tunica/observe/budget_columns.hpp"

namespace tunica::observe {

// Of what discretisation/balance.cpp has of fluid and wall, with V the volume of the fluid, w the
// velocity of its mesh and ⟨·⟩ the mean over a step, by the rule that has the order of the time
// scheme,
//
//   mass       ∮ u·n da = 0                               to the tolerance of the solver
//   volume     ΔV/Δt = ⟨∮ w·n da⟩ + scheme
//   momentum   L + A + D = I                              D to the tolerance of the solver
//              ΔM/Δt + ⟨∮ ρ u (u − w)·n da⟩ = ⟨I⟩ + scheme
//   energy     ΔE/Δt = ⟨P_L + P_A + P_k + P_d − P_μ − P_β − P_τ − P_w + P_Γ + P_D⟩ + scheme
//
// The powers with small letters are columns of steps.csv, see discretisation/fluid_observables.cpp.
// P_Γ is what the wall gets from the interface and the fluid does not give, where both have other
// velocities there. What is called scheme is what discretisation in time makes of a balance, that
// of momentum also what the convective form of the equations does, which is not conservative, that
// of energy also what relaxes in the wall.

namespace {

double sum_of(const discretisation::Observables& all, const std::string& head) {
  double sum = 0.0;
  for (const auto& o : all)
    if (o.name.rfind(head, 0) == 0) sum += o.value;
  return sum;
}

double volume_at_rest(const fields::FieldMesh& mesh) {
  double V = 0.0;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    if (mesh.is_owned[e]) V += kernels::make_tet4(assembly::gather(mesh.x, mesh.tets[e])).volume;
  return global_sum(*mesh.comm, V);
}

}  // namespace

Budget::Budget(const BudgetSettings& settings, problems::FluidProblem* fluid,
               problems::SolidProblem* wall, bool starts_at_rest, bool has_energy)
    : settings_(settings), fluid_(fluid), wall_(wall), has_energy_(has_energy),
      has_trapezoids_((fluid == nullptr || fluid->time_scheme().order() > 1) &&
                      (wall == nullptr || wall->time_scheme().order() > 1)),
      has_begun_(starts_at_rest) {
  if (fluid_ != nullptr) fluid_->keep_balance();
  if (wall_ != nullptr) wall_->keep_balance();
  if (starts_at_rest && fluid_ != nullptr) before_["volume"] = volume_at_rest(fluid_->mesh());
}

double Budget::at(const Numbers& numbers, const std::string& name) {
  const auto found = numbers.find(name);
  return found == numbers.end() ? 0.0 : found->second;
}

double Budget::weight() const { return std::isinf(step_size_) ? 1.0 : step_size_; }

void Budget::mean(const std::string& column, double value) {
  row_.push_back({column, has_begun_ ? value : std::nan("")});
  if (!has_begun_) return;
  totals_[column] += weight() * value;
  sizes_[column] += weight() * std::abs(value);
}

double Budget::over_step(const std::string& name, double now) {
  double& before = before_.emplace(name, now).first->second;
  const double mean_value = has_trapezoids_ ? 0.5 * (before + now) : now;
  before = now;
  return mean_value;
}

void Budget::instant(const std::string& column, double value) {
  row_.push_back({column, value});
  const double mean_value = over_step(column, value);
  if (!has_begun_) return;
  totals_[column] += weight() * mean_value;
  sizes_[column] += weight() * std::abs(mean_value);
}

double Budget::change(const std::string& name, double now) {
  double& before = before_[name];
  const double rate = (now - before) / step_size_;
  before = now;
  return rate;
}

void Budget::worst(const std::string& name, double value) {
  const auto found = worst_.emplace(name, value).first;
  found->second = std::max(found->second, value);
}

// All numbers of both fields in one reduction.
void Budget::sum_over_ranks() {
  std::vector<double> mine;
  CommPtr comm;
  const auto take = [&](const auto& field, discretisation::Balance& balance) {
    balance = field.balance();
    balance.each([&](double& number) { mine.push_back(number); });
    comm = field.mesh().comm;
  };
  if (fluid_ != nullptr) take(*fluid_, of_fluid_);
  if (wall_ != nullptr) take(*wall_, of_wall_);
  const std::vector<double> all = global_sum(*comm, mine);
  auto next = all.begin();
  const auto put = [&](double& number) { number = *next++; };
  if (fluid_ != nullptr) of_fluid_.each(put);
  if (wall_ != nullptr) of_wall_.each(put);
}

void Budget::add_mass() {
  const discretisation::Balance& b = of_fluid_;
  row_.push_back({"volume_mm3", b.volume});
  instant("inflow_mm3_per_ms", b.swept - b.net_outflow);
  instant("throughput_mm3_per_ms", b.throughput);
  instant("mass_error_mm3_per_ms", b.net_outflow);
  instant("mass_residual_mm3_per_ms", b.mass_residual);
  const double swept = over_step("swept", b.swept);
  mean("volume_scheme_mm3_per_ms", change("volume", b.volume) - swept);
}

void Budget::add_forces() {
  const discretisation::Balance &f = of_fluid_, &w = of_wall_;
  const bool is_coupled = fluid_ != nullptr && wall_ != nullptr;
  Vec3 error = f.error + w.error, reactions = f.reactions + w.reactions;
  // The force of the wall on the fluid and that of the fluid on the wall
  (is_coupled ? error : reactions) += f.interface + w.interface;
  const Vec3 loads = f.loads + w.loads, inertia = loads + reactions + error;
  for (int i = 0; i < 3; ++i) {
    instant(force_column("load", i), loads[i]);
    instant(force_column("reaction", i), reactions[i]);
    instant(force_column("inertia", i), inertia[i]);
    instant(force_column("force_error", i), error[i]);
    const double now = inertia[i] - f.outflow[i], kept = over_step(force_column("carried", i), now);
    mean(force_column("momentum_scheme", i),
         change(force_column("momentum", i), f.momentum[i] + w.momentum[i]) - kept);
  }
  instant("forces_mN", f.forces + w.forces);
  instant("force_residual_mN", f.force_residual + w.force_residual);
}

void Budget::add_energy(const discretisation::Observables& observed) {
  const discretisation::Balance &f = of_fluid_, &w = of_wall_;
  const bool is_coupled = fluid_ != nullptr && wall_ != nullptr;
  const double of_interface = f.interface_power + w.interface_power;
  const double backflow = sum_of(observed, "backflow_power_");
  Numbers found{
      {"load_power", f.load_power + w.load_power + backflow},
      {"reaction_power", f.reaction_power + w.reaction_power + (is_coupled ? 0.0 : of_interface)},
      {"interface_power", is_coupled ? of_interface : 0.0},
      {"power_error", f.power_error + w.power_error}};
  double kept = 0.0;
  for (const Power& power : powers) {
    const auto own = found.find(power.name);
    const double value =
        own != found.end() ? own->second : sum_of(observed, power.name + std::string(power_unit));
    kept += power.sign * value;
    instant(power.name + std::string(power_unit), value);
  }
  const double stored =
      sum_of(observed, "fluid_kinetic_energy_") + sum_of(observed, "wall_kinetic_energy_") +
      sum_of(observed, "elastic_energy_") + sum_of(observed, "volumetric_energy_");
  const double mean_power = over_step("power", kept), rate = change("energy", stored);
  mean(std::string("energy_change") + power_unit, rate);
  mean(std::string("scheme_power") + power_unit, rate - mean_power);
}

void Budget::add_wall(const discretisation::Observables& observed) {
  const discretisation::Balance& b = of_wall_;
  row_.push_back({"wall_volume_mm3", b.volume});
  row_.push_back({"wall_volume_error_mm3", b.volume_error});
  worst("wall volume", std::abs(b.volume_error) / b.volume);
  const double least = sum_of(observed, "min_det_F"), most = sum_of(observed, "max_det_F");
  const auto at = [&](double part) {
    const double J = discretisation::quantile_of_volume_ratio(b.volume_ratios, part);
    return std::min(std::max(J, least), most);
  };
  row_.push_back({"det_F_0", least});
  for (const int percent : {1, 50, 99})
    row_.push_back({"det_F_" + std::to_string(percent), at(0.01 * percent)});
  row_.push_back({"det_F_100", most});
  if (std::isnan(at(0.5))) return;
  worst("det F above", at(0.99) - 1.0);
  worst("det F below", 1.0 - at(0.01));
}

discretisation::Observables Budget::add(double step_size, bool is_converged,
                                        const discretisation::Observables& observed) {
  sum_over_ranks();
  row_.clear();
  step_size_ = step_size;
  // An infinite step of a search for a steady state outweighs all before it.
  if (std::isinf(step_size))
    for (auto& [column, size] : sizes_) totals_[column] = size = 0.0;
  if (fluid_ != nullptr) add_mass();
  add_forces();
  if (has_energy_) add_energy(observed);
  if (wall_ != nullptr) add_wall(observed);
  has_begun_ = true;
  totals_["steps"] += 1.0;
  totals_["unconverged"] += is_converged ? 0.0 : 1.0;
  return row_;
}

fields::State Budget::save() const {
  fields::State state;
  const auto put = [&](const std::string& head, const Numbers& numbers) {
    for (const auto& [name, value] : numbers) state.numbers[head + name] = {value};
  };
  put("before ", before_);
  put("total ", totals_);
  put("size ", sizes_);
  put("worst ", worst_);
  return state;
}

std::string Budget::restore(const fields::State& state) {
  const auto take = [&](const std::string& head, Numbers& numbers) {
    numbers.clear();
    for (const auto& [name, value] : state.numbers)
      if (name.rfind(head, 0) == 0) numbers[name.substr(head.size())] = value.at(0);
  };
  take("before ", before_);
  take("total ", totals_);
  take("size ", sizes_);
  take("worst ", worst_);
  has_begun_ = !totals_.empty() || has_begun_;
  return "";
}

}  // namespace tunica::observe
