#pragma once
#include "tunica/boundary/boundary_term.hpp"
#include "tunica/params/table.hpp"
#include "tunica/stepping/time_function.hpp"

namespace tunica::boundary {

/// Prescribed σ n = t:
///
///   R[a] −= ∫ N_a t dA
///
///   t  amplitude(time) times the traction given, or −p n  kPa
///
/// On the fluid's surface where it lies at present; on the undeformed wall (a dead load).
class Traction : public BoundaryTerm {
public:
  /// list: a resolved list of traction_table() or normal_traction_table().
  Traction(const Teuchos::ParameterList& list, bool on_undeformed);

  void add(const Surroundings& s, const fields::Face& face, assembly::NodalResidual& R,
           assembly::BlockAssembler* K) const override;
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

}  // namespace tunica::boundary
