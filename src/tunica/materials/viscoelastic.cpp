#include "tunica/materials/viscoelastic.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::materials {

double Viscoelastic::factor(const Past& past) const {
  return past.step > 0.0 ? beta_ * std::exp(-0.5 * past.step / tau_) : 0.0;
}

Sym3 Viscoelastic::fading_stress(const Sym3& elastic, const Past& past) const {
  Sym3 Q{};
  if (past.step == 0.0) return Q;
  const double *Q_before = past.state, *elastic_before = past.state + 6;
  const double kept = std::exp(-past.step / tau_), new_part = factor(past);
  for (int I = 0; I < 6; ++I)
    Q[I] = kept * Q_before[I] + new_part * (elastic[I] - elastic_before[I]);
  return Q;
}

void Viscoelastic::add_fading_stress(Sym3& S, const Past& past) const {
  const Sym3 Q = fading_stress(S, past);
  for (int I = 0; I < 6; ++I) S[I] += Q[I];
}

void Viscoelastic::add_fading_stress(Sym3Of<Pack>& S, const PackedPast& past) const {
  for (int lane = 0; lane < Pack::size; ++lane) {
    Sym3 mine = tunica::lane_of(S, lane);
    add_fading_stress(mine, past[lane]);
    set_lane(S, lane, mine);
  }
}

namespace {

// D' = (1 + β e^(−Δt/(2τ))) D_e
template <class Real>
void stiffen(Sym3MapOf<Real>& D, const Real& factor) {
  for (auto& row : D)
    for (Real& entry : row) entry *= factor;
}

}  // namespace

Sym3 Viscoelastic::stress(const Sym3& C, const Frame& frame, const Past& past) const {
  Sym3 S = elastic_->stress(C, frame, past);
  add_fading_stress(S, past);
  return S;
}

StressTangent Viscoelastic::response(const Sym3& C, const Frame& frame, const Past& past) const {
  StressTangent at = elastic_->response(C, frame, past);
  add_fading_stress(at.S, past);
  stiffen(at.D, 1.0 + factor(past));
  return at;
}

Sym3Of<Pack> Viscoelastic::packed_stress(const Sym3Of<Pack>& C, const FrameOf<Pack>& frame,
                                         const PackedPast& past) const {
  Sym3Of<Pack> S = elastic_->packed_stress(C, frame, past);
  add_fading_stress(S, past);
  return S;
}

StressTangentOf<Pack> Viscoelastic::packed_response(const Sym3Of<Pack>& C,
                                                    const FrameOf<Pack>& frame,
                                                    const PackedPast& past) const {
  StressTangentOf<Pack> at = elastic_->packed_response(C, frame, past);
  add_fading_stress(at.S, past);
  Pack stiffer;
  for (int lane = 0; lane < Pack::size; ++lane) stiffer.set(lane, 1.0 + factor(past[lane]));
  stiffen(at.D, stiffer);
  return at;
}

void Viscoelastic::remember(const Sym3& C, const Frame& frame, const Past& past,
                            double* state) const {
  const Sym3 elastic = elastic_->stress(C, frame, past);
  const Sym3 Q = fading_stress(elastic, past);
  std::copy(elastic.begin(), elastic.end(), std::copy(Q.begin(), Q.end(), state));
}

}  // namespace tunica::materials
