#pragma once
#include <cmath>
#include <memory>
#include <tunica/boundary/registry.hpp>
#include <tunica/kernels/surface_tri3.hpp>

namespace example {

using namespace tunica;

/// A ring of pressure that travels along z over the undeformed outer surface of a wall:
///
///   R[a] −= ∫ N_a t dA,   t = −p exp(−((z − ct)/w)²) n
///
///   p  peak pressure   kPa     c  speed    mm/ms
///   n  outward normal  1       w  width    mm
///
/// It does not follow the deformation, so that the Jacobian has no part of it.
class Squeeze final : public boundary::FaceLoad {
public:
  /// list: a resolved list with "pressure", "speed" and "width".
  explicit Squeeze(const Teuchos::ParameterList& list)
      : pressure_(list.get<double>("pressure")), speed_(list.get<double>("speed")),
        width_(list.get<double>("width")) {}

  void add(const boundary::Surroundings& s, const fields::Face& face, assembly::NodalResidual& R,
           assembly::BlockAssembler*) const override {
    std::array<Vec3, 3> x;
    for (int a = 0; a < 3; ++a) x[a] = (*s.reference)[face.nodes[a]];
    const double z = (x[0][2] + x[1][2] + x[2][2]) / 3.0;
    const double p = pressure_ * std::exp(-std::pow((z - speed_ * s.time) / width_, 2));
    const Vec3 n = unit(kernels::area_normal(x));
    R.add(*s.mesh, face, kernels::dead_traction(x, -p * n));
  }

private:
  double pressure_, speed_, width_;
};

/// "squeeze" of a surface of the wall.
inline boundary::ConditionEntry squeeze() {
  using boundary::Drive;
  params::Table table;
  table.number("pressure", std::nullopt, params::any(), "kPa", "at the peak")
      .number("speed", 0.0, params::any(), "mm/ms", "of the peak along z")
      .number("width", 1.0, params::positive(), "mm", "where it has fallen to 1/e");
  return {boundary::Field::wall, "squeeze", table,
          [](const Teuchos::ParameterList& list, const fields::FieldMesh&, int) {
            return boundary::terms(std::make_unique<Squeeze>(list));
          },
          [](const Teuchos::ParameterList& list) {
            Drive drive;
            drive.kind = Drive::Kind::pressure;
            drive.size = list.get<double>("pressure");
            return drive;
          }};
}

}  // namespace example
