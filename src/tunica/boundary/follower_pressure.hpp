#pragma once
#include "tunica/boundary/condition.hpp"
#include "tunica/stepping/time_function.hpp"

namespace tunica::boundary {

/// A pressure on the wall that follows its deformed surface and pushes against the outward normal:
///
///   R[a] += ∫ N_a p n da,   with its derivative by the displacement
class FollowerPressure final : public FaceLoad {
public:
  /// list: a resolved list with "pressure" [kPa] and "Amplitude".
  explicit FollowerPressure(const Teuchos::ParameterList& list);

  void add(const Surroundings& s, const fields::Face& face, assembly::NodalResidual& R,
           assembly::BlockAssembler* K) const override;

private:
  double pressure_;  ///< [kPa]
  stepping::TimeFunction amplitude_;
};

/// "pressure" of a wall.
ConditionEntry follower_pressure();

}  // namespace tunica::boundary
