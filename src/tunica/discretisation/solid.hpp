#pragma once
#include <memory>

#include "tunica/assembly/patch_recovery.hpp"
#include "tunica/assembly/solid_assembly.hpp"
#include "tunica/base/outcome.hpp"
#include "tunica/discretisation/mixed_field.hpp"
#include "tunica/discretisation/observable.hpp"
#include "tunica/discretisation/prestretch.hpp"
#include "tunica/discretisation/solid_options.hpp"

namespace tunica::discretisation {

/// The wall in a time step: displacement and pressure. Loads are those of its surfaces and nodal
/// forces from the fluid. Starts at rest where its mesh lies, which is free of stress unless
/// set_prestretch() says otherwise:
///
///   F = (I + ∇d) G      G  per element, from where it is free of stress to the mesh
///
/// Unknown is d, the displacement from the mesh; see assembly::ElementGeometry.
class Solid final : public MixedField {
public:
  /// frames: of the fibres, one per local element, or none. mesh must outlive the object.
  /// Collective.
  Solid(const SolidOptions& options, const fields::FieldMesh& mesh,
        std::vector<materials::Frame> frames);
  ~Solid() override;

  /// G of all local elements. Fibres keep the directions that they have in the mesh. Fails where
  /// det G is not positive. Collective.
  Outcome set_prestretch(std::vector<Mat3> G);
  /// Empty where the mesh is free of stress.
  const std::vector<Mat3>& prestretch() const { return prestretch_.values(); }
  /// Stretch of the tissue's springs in the mesh, on owned and ghost nodes [mm]; empty: none.
  void set_spring_offset(std::vector<Vec3> offset) { spring_offset_ = std::move(offset); }
  const std::vector<Vec3>& spring_offset() const { return spring_offset_; }
  /// From now on Jacobians are those by s in G ← (I + sym ∇s) G, of a wall that stays on its mesh.
  void stay_on_mesh() { stays_on_mesh_ = true; }
  /// Fibre frames, in the mesh.
  const std::vector<materials::Frame>& frames() const { return frames_; }

  void begin_step(const stepping::Clock& clock);
  /// True where subscales see div σ' and have that of the step before.
  bool has_stress_residual() const { return patches_ != nullptr; }
  bool is_static() const { return options_.is_static; }
  /// Goes on with div σ' at x, over-relaxed after Aitken, until the next step begins. Returns the
  /// root mean square of what differs, in parts of it. Collective.
  double renew_stress_force(const algebra::BlockVector& x);
  /// Does without it until the next step begins; false where it does already. Collective.
  bool leave_out_stress_force();
  /// Gives x the prescribed displacements. Collective.
  void prescribe(algebra::BlockVector& x) { surfaces_.impose(surroundings(), x[0]); }
  /// Nodal forces [mN] on the owned nodes, which stay until the next call.
  void set_nodal_force(const std::vector<Vec3>& force) { nodal_force_ = force; }
  /// The right-hand side of these forces [mN] on owned nodes.
  void load_of(const std::vector<Vec3>& force, algebra::BlockVector& b) const;

  /// The displacement and velocity of x at the start; velocity: of owned and ghost nodes.
  /// Collective.
  void start_from(const algebra::BlockVector& x, const std::vector<Vec3>& velocity);
  /// Laws forget how the wall came to x, as if it had been there for long. Collective.
  void settle(const algebra::BlockVector& x);

  /// Per mass at the undeformed position [mm/ms²], instead of the options'; for verification.
  void set_body_force(boundary::VectorField f) { body_force_ = std::move(f); }

  /// A number for each region of the mesh, from 0, the same where pressures are continuous from
  /// one to the other; -1 outside the wall.
  std::vector<int> pressure_parts() const;
  bool moves_as_one(int surface) const { return surfaces_.moves_as_one(surface); }

  /// Velocity of owned and ghost nodes after the last accepted step [mm/ms].
  std::vector<Vec3> velocity() const { return fields::as_vectors(timeline_[0]); }
  const assembly::SolidElements& elements() const { return elements_; }

  Observables observe(const algebra::BlockVector& x) const;
  /// Of x, within its step. Collective.
  Balance balance(const algebra::BlockVector& x);
  /// Area of the surfaces (indices into FieldMesh::surfaces), displacement of those that are not
  /// clamped and forces on those that hold the wall, at the end of a step.
  Observables observe_surfaces(const algebra::BlockVector& x, const std::vector<int>& surfaces);

  // MixedField
  void save_history(fields::State& state) const override;
  std::string restore_history(const fields::State& state, const algebra::BlockVector& x) override;
  std::map<std::string, fields::Restartable*> element_histories() override;

  // NamedOperators: the parts of the paper's Schur complement
  std::vector<std::string> operator_names() const override;
  Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string& name) const override;

private:
  struct Summary;
  /// A local element with its values at the vertices.
  void add_element(std::size_t e, const std::array<Vec3, 4>& d, const std::array<Vec3, 4>& v,
                   const std::array<double, 4>& p, Summary& s) const;
  static Observables observables_of(const Summary& s, const Comm& comm, bool has_interface);
  void set_elements();
  void follow_prestretch();
  void set_coefficients();
  /// Gives the laws what they remember before a step of this size.
  void begin_laws(double step);
  void set_inertia_loads();
  void add_body_force(std::vector<Vec3>& rows) const;
  /// Force that drives the subscales in addition to the linear residual, at the displacement d.
  std::vector<Vec3> stress_force_at(const std::vector<Vec3>& d) const;
  /// ∫ a·b over the elements of all ranks, constant in each. Collective.
  double product_over_elements(const std::vector<Vec3>& a, const std::vector<Vec3>& b) const;
  /// Its subscale has inertia, where subscales have.
  bool is_nearly_incompressible(std::size_t element) const;
  /// On one surface and this rank; displacement: its integral over the undeformed surface.
  struct SurfaceSums {
    double area, undeformed_area;
    Vec3 displacement;
  };
  SurfaceSums sums_over(int surface, const std::vector<Vec3>& d) const;
  /// Forces on all surfaces that hold the wall, this rank's part.
  std::vector<Vec3> reaction_forces(const algebra::BlockVector& x);
  boundary::Surroundings surroundings() const override;
  void read(const algebra::BlockVector& x) override;
  Outcome is_admissible() const override;
  void assemble(assembly::BlockAssembler* K) override;
  const assembly::ElementGeometry& geometry() const override { return elements_.geometry; }

  SolidOptions options_;
  std::vector<std::unique_ptr<materials::WallLaw>> laws_;  ///< per layer
  std::vector<char> is_at_layer_;  ///< per element: it touches another material; empty where
                                   ///< the pressure follows the jump
  assembly::SolidElements elements_;

  stepping::Timeline* subscales_ = nullptr;  ///< null where they have no inertia
  stepping::Timeline* of_laws_ = nullptr;    ///< what they remember; null where none does
  double unit_inertia_ = -1.0;               ///< of the coefficients: the scheme's for unit density
  assembly::SolidFields local_;              ///< of the point of evaluation
  std::vector<Vec3> v_;                      ///< velocity there
  std::vector<Vec3> past_;                   ///< of the displacement, local nodes
  Prestretch prestretch_;
  std::vector<Vec3> spring_offset_;
  std::vector<materials::Frame> frames_;  ///< in the mesh; those of the elements are where they are
                                          ///< free of stress
  std::unique_ptr<assembly::PatchRecovery> patches_;  ///< null where subscales do without div σ'
  std::vector<Vec3> stress_change_;  ///< that the last renewal found, before it was relaxed
  double stress_relaxation_ = 1.0;
  std::vector<Vec3> nodal_force_;
  boundary::VectorField body_force_;
  double time_ = 0.0;
  bool stays_on_mesh_ = false;
};

}  // namespace tunica::discretisation
