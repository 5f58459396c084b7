#pragma once
#include <functional>
#include <memory>

#include "tunica/assembly/fluid_shape.hpp"
#include "tunica/base/outcome.hpp"
#include "tunica/boundary/surface_forces.hpp"
#include "tunica/discretisation/fluid_options.hpp"
#include "tunica/discretisation/mixed_field.hpp"
#include "tunica/discretisation/observable.hpp"

namespace tunica::discretisation {

/// The fluid on a moving mesh in a time step: velocity and pressure. Starts at rest on the
/// undeformed mesh.
class Fluid final : public MixedField {
public:
  /// mesh must outlive the object. Collective.
  Fluid(const FluidOptions& options, const fields::FieldMesh& mesh);
  ~Fluid() override;

  /// Takes x for the state at the start, instead of rest. Collective.
  void start_from(const algebra::BlockVector& x);
  void begin_step(const stepping::Clock& clock);
  /// Moves the mesh to the displacement d of all local nodes; the mesh velocity and the velocity
  /// on the interface are those that the time scheme sees between d_past, its past of the mesh's
  /// displacement, and d. Fails where an element is inverted, and says which.
  Outcome set_domain(const std::vector<Vec3>& d, const std::vector<Vec3>& d_past);
  /// Makes the velocity on the interface an unknown as far as free, per local node, leaves it free
  /// (assembly::Constraints): the motion of the wall is not known beforehand. A fluid that was
  /// closed now has a pressure that the wall bears.
  void release_interface(const std::vector<Mat3>& free);
  /// Gives x the prescribed velocities and fixes what stays constant in a Newton solve.
  void prescribe(algebra::BlockVector& x);
  /// Fixes it on the present domain: the stabilisation parameters and the body force.
  void fix_coefficients();
  /// Shifts the pressure of an enclosed fluid, which is known up to a constant, to a mean of zero.
  void fix_pressure_level(algebra::BlockVector& x) const;

  /// Brings shape_jacobian() to x on the present domain, whose mesh has the velocity of
  /// set_domain(). Collective.
  void assemble_shape_jacobian(const algebra::BlockVector& x);
  const assembly::FluidShapeMatrix& shape_jacobian() const { return *shape_; }

  /// Consistent nodal forces [mN] on what bounds the fluid: minus the momentum residual at x, on
  /// owned nodes. Meaningful where the velocity is prescribed.
  std::vector<Vec3> reaction(const algebra::BlockVector& x);

  /// Replaces body force per mass and velocity on "velocity" surfaces by functions; for
  /// verification.
  void set_body_force(boundary::VectorField f) { body_force_ = std::move(f); }
  void set_boundary_velocity(boundary::VectorField u) { boundary_velocity_ = std::move(u); }

  double density() const { return options_.density; }  ///< [mg/mm³]
  /// Indices into FieldMesh::surfaces: where the fluid may pass.
  std::vector<int> open_surfaces() const;
  /// Those that do not stretch with their rims.
  std::vector<int> staying_surfaces() const;
  const std::vector<Vec3>& positions() const { return position_; }  ///< current, local nodes
  const assembly::FluidElements& elements() const { return elements_; }

  Observables observe(const algebra::BlockVector& x) const;
  /// Of x, within its step. Collective.
  Balance balance(const algebra::BlockVector& x);
  /// Area, pressure and forces of the surfaces (indices into FieldMesh::surfaces), and the inflow
  /// of those that the case does not list, at the end of a step.
  Observables observe_surfaces(const algebra::BlockVector& x, const std::vector<int>& surfaces);

  /// Tangential traction of the fluid on what it sticks to, on owned nodes; zero elsewhere [kPa].
  /// Collective.
  std::vector<Vec3> wall_shear_stress(const algebra::BlockVector& x);

  // NamedOperators: the parts of the paper's Schur complement
  std::vector<std::string> operator_names() const override;
  Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string& name) const override;

private:
  boundary::Surroundings surroundings() const override;
  /// That by which τ is chosen.
  const std::vector<Vec3>& expected_velocity() const {
    return options_.has_predicted_tau ? predicted_ : local_.u_old;
  }
  /// Viscous forces of the values read, per local element.
  std::vector<Vec3> viscous_forces() const;
  /// Volume of fluid that leaves through the face [mm³/ms]; u on local nodes.
  double outflow(const fields::Face& face, const std::vector<Vec3>& u) const;
  void check_closed_flow(const algebra::BlockVector& x) const;
  void read(const algebra::BlockVector& x) override;
  void assemble(assembly::BlockAssembler* K) override;
  const assembly::ElementGeometry& geometry() const override { return elements_.geometry; }
  void observe_volume(const assembly::FluidFields& state, Observables& found) const;
  /// Sums of the values read, on one surface and this rank.
  struct SurfaceSums {
    double area, pressure, inflow;
    Vec3 pressure_force;
  };
  SurfaceSums sums_over(int surface) const;
  /// Forces on all surfaces predicted by the stress of the elements, for the values read.
  boundary::NodalShares tractions() const;
  /// Forces on the given ones of all surfaces, this rank's part.
  std::vector<Vec3> forces(const algebra::BlockVector& x, const std::vector<int>& surfaces);
  void find_open_surfaces();
  void mark_walls();
  /// The surfaces that the fluid sticks to.
  std::vector<int> walls() const;
  void add_faces(Balance& balance) const;
  void observe_open_surfaces(const assembly::FluidFields& state, Observables& found) const;

  FluidOptions options_;
  assembly::FluidElements elements_;
  boundary::VectorField body_force_, boundary_velocity_;

  std::vector<Vec3> position_;
  stepping::Timeline* subscales_ = nullptr;  ///< null where they have no inertia
  stepping::Timeline* viscous_ = nullptr;    ///< of the viscous force; null where it is left out
  std::vector<Vec3> predicted_;              ///< velocity expected at the new time, local nodes
  assembly::FluidFields local_;              ///< ghosted copies; u and p at the point of evaluation
  std::unique_ptr<assembly::FluidShapeMatrix> shape_;  ///< null before it is asked for
  std::vector<char> is_open_;                          ///< per surface: the fluid may pass
  bool is_closed_ = false;                             ///< no surface lets the fluid out
  double time_ = 0.0;
};

}  // namespace tunica::discretisation
