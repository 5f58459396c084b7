#pragma once
#include "tunica/output/field_writer.hpp"
#include "tunica/params/table.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/stepping/clock.hpp"

namespace tunica::observe {

/// Over which steps the wall shear stress is averaged.
struct ShearAverages {
  double from;             ///< [ms]
  bool is_steady = false;  ///< such a flow is sought
};

/// The wall shear stress τ of the last step, and what has become of it over time:
///
///   TAWSS = 1/T ∫ |τ| dt,   OSI = ½ (1 − |∫ τ dt| / ∫ |τ| dt),   RRT = 1/((1 − 2 OSI) TAWSS)
///
///   TAWSS  time average   kPa      OSI  oscillatory shear index, 0 to ½   1
///   RRT    relative residence time   1/kPa
///
/// Integrals are sums over the steps from a time of the case on, usually the beginning of the last
/// beat. On the way to a steady flow steps are no times: TAWSS = |τ|, OSI = 0, RRT = 1/|τ| of the
/// present τ. Source: [HG04].
class WallShear final : public fields::Restartable {
public:
  /// fluid must outlive the object.
  WallShear(const ShearAverages& averages, problems::FluidProblem& fluid);

  /// The clock's step is made. Collective.
  void accept(const stepping::Clock& clock);
  /// On owned nodes, zero away from walls; averages from when they begin.
  std::vector<output::Array> arrays() const;
  /// max_wall_shear_stress_kPa. Collective.
  discretisation::Observables observe() const;

  // Restartable: the integrals, which begin anew where the case has another time for them
  fields::State save() const override;
  std::string restore(const fields::State& state) override;

private:
  problems::FluidProblem* fluid_;
  ShearAverages averages_;
  double duration_ = 0.0;                ///< T [ms]
  std::vector<Vec3> stress_, integral_;  ///< owned nodes
  std::vector<double> integral_of_size_;
};

/// Adds the key "averages from" to an "Output" list, and its value in a resolved one [ms].
void add_wall_shear_keys(params::Table& table);
double averages_from(const Teuchos::ParameterList& output);

}  // namespace tunica::observe
