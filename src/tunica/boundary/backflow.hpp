#pragma once
#include "tunica/boundary/boundary_term.hpp"
#include "tunica/params/table.hpp"

namespace tunica::boundary {

/// Takes out the energy that inflow through an open surface brings in:
///
///   R[a] −= β ρ ∫ N_a (c·n)₋ u da,   c = u − w,  (x)₋ = min(x, 0)
class Backflow final : public FaceLoad {
public:
  explicit Backflow(double beta) : beta_(beta) {}

  void add(const Surroundings& s, const fields::Face& face, assembly::NodalResidual& R,
           assembly::BlockAssembler* K) const override;
  void add_shape(const Surroundings& s, const fields::Face& face,
                 assembly::FluidShapeMatrix& S) const override;
  /// backflow_power_kPa_mm3_per_ms: −β ρ ∫ (c·n)₋ |u|² da.
  void observe(const Surroundings& s, const fields::Face& face,
               std::map<std::string, double>& sums) const override;

private:
  double beta_;
};

constexpr const char* backflow_power = "backflow_power_kPa_mm3_per_ms";

/// Adds the key "backflow stabilisation".
void add_backflow_key(params::Table& table);

}  // namespace tunica::boundary
