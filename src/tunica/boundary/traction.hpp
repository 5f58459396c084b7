#pragma once
#include "tunica/boundary/condition.hpp"
#include "tunica/stepping/time_function.hpp"

namespace tunica::boundary {

/// Prescribed σ n = t:
///
///   R[a] −= ∫ N_a t dA
///
///   t  amplitude(time) times the traction given, or −p n  kPa
///
/// On the fluid's surface where it lies at present; on the undeformed wall (a dead load).
class Traction : public FaceLoad {
public:
  /// list: the resolved list of one of the conditions below.
  Traction(const Teuchos::ParameterList& list, bool on_undeformed);

  void add(const Surroundings& s, const fields::Face& face, assembly::NodalResidual& R,
           assembly::BlockAssembler* K) const override;
  void add_shape(const Surroundings& s, const fields::Face& face,
                 assembly::FluidShapeMatrix& S) const override;
  /// traction_power_kPa_mm3_per_ms: ∫ t·u da.
  void observe(const Surroundings& s, const fields::Face& face,
               std::map<std::string, double>& sums) const override;

private:
  kernels::SurfaceResidual load(const Surroundings& s, const fields::Face& face) const;

  bool on_undeformed_;
  bool is_normal_;     ///< t = −p n
  Vec3 traction_{};    ///< [kPa]
  double pressure_{};  ///< [kPa]
  stepping::TimeFunction amplitude_;
};

constexpr const char* traction_power = "traction_power_kPa_mm3_per_ms";

/// "traction" and "pressure" of a fluid, with backflow stabilisation; "traction" of a wall.
ConditionEntry open_traction();
ConditionEntry open_pressure();
ConditionEntry dead_traction();

}  // namespace tunica::boundary
