#pragma once
#include "tunica/base/tensor.hpp"
#include "tunica/params/table.hpp"

namespace tunica::stepping {

/// Newmark's scheme in displacement form:
///
///   a = (d − dⁿ⁻¹)/(βΔt²) − vⁿ⁻¹/(βΔt) − (1 − 2β)/(2β) aⁿ⁻¹
///   v = vⁿ⁻¹ + (1 − γ)Δt aⁿ⁻¹ + γΔt a
///
/// Source: [LY1] section 4.1; β = 0.625, γ = 1 there.
struct Newmark {
  double beta;
  double gamma;
  double dt;

  Vec3 acceleration(const Vec3& d, const Vec3& d_old, const Vec3& v_old, const Vec3& a_old) const {
    return 1.0 / (beta * dt * dt) * (d - d_old) - history(v_old, a_old);
  }
  Vec3 velocity(const Vec3& a, const Vec3& v_old, const Vec3& a_old) const {
    return v_old + dt * ((1.0 - gamma) * a_old + gamma * a);
  }
  /// r of ρ a = αd − r with α = ρ/(βΔt²).
  Vec3 load(double density, const Vec3& d_old, const Vec3& v_old, const Vec3& a_old) const {
    return density * (1.0 / (beta * dt * dt) * d_old + history(v_old, a_old));
  }
  double alpha(double density) const { return density / (beta * dt * dt); }

private:
  Vec3 history(const Vec3& v_old, const Vec3& a_old) const {
    return 1.0 / (beta * dt) * v_old + (1.0 - 2.0 * beta) / (2.0 * beta) * a_old;
  }
};

params::Table newmark_table();

}  // namespace tunica::stepping
