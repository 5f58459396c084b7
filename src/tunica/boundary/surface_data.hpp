#pragma once
#include <vector>

#include "tunica/boundary/condition.hpp"
#include "tunica/stepping/time_function.hpp"

namespace tunica::boundary {

/// Vectors that a file gives at points of a surface, at one time or at several: velocities that
/// were measured, a motion that was seen in images.
///
///   v(x, t) = a(t) Σ_k N_k(t) Σ_i w_i(x) v_i(t_k)
///
///   v_i(t_k)  of point i at time k; a(t) the amplitude
///   N_k       cubic splines with N_k(t_l) = δ_kl, of the period if there is one
///   w_i       of the point that x is, or what the linear function of least squares through the
///             points around x makes of them: exact where the vectors are linear in space
class SurfaceData {
public:
  /// list: a resolved list with the keys of add_surface_data_keys(). Throws Error that names file
  /// and line, or that the points lie elsewhere than the surface. Collective.
  SurfaceData(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int surface);

  /// The time at which it is evaluated [ms].
  void set_time(double time);
  /// At a local node of the surface.
  Vec3 operator()(int node) const;

private:
  stepping::TimeFunction amplitude_;
  std::vector<stepping::TimeFunction> shares_;  ///< N_k
  std::vector<double> factors_;                 ///< a N_k at the present time
  std::vector<int> place_;                      ///< per local node: its values; -1: none
  std::vector<Vec3> values_;                    ///< per place and time
};

/// The surface's velocity, from a file.
class VelocityData final : public Constraint {
public:
  explicit VelocityData(SurfaceData data) : data_(std::move(data)) {}
  bool keeps_place() const override { return true; }
  std::vector<int> prescribed_components() const override { return {0, 1, 2}; }
  int precedence() const override { return 1; }
  void prepare(const Surroundings& s) override { data_.set_time(s.time); }
  Vec3 prescribed(const Surroundings&, int node) const override { return data_(node); }

private:
  SurfaceData data_;
};

/// Components of the surface's displacement, from a file.
class DisplacementData final : public Constraint {
public:
  DisplacementData(SurfaceData data, std::vector<int> components)
      : data_(std::move(data)), components_(std::move(components)) {}
  std::vector<int> prescribed_components() const override { return components_; }
  void prepare(const Surroundings& s) override { data_.set_time(s.time); }
  Vec3 prescribed(const Surroundings&, int node) const override { return data_(node); }

private:
  SurfaceData data_;
  std::vector<int> components_;
};

/// "velocity from file" of a fluid and "displacement from file" of a wall.
ConditionEntry velocity_from_file();
ConditionEntry displacement_from_file();

}  // namespace tunica::boundary
