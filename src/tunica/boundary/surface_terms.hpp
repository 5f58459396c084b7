#pragma once
#include "tunica/boundary/registry.hpp"
#include "tunica/fields/state.hpp"

namespace tunica::boundary {

/// The terms of all surfaces of a field.
class SurfaceTerms {
public:
  /// A surface that the mesh lacks is left out: the case was checked against the mesh. Collective.
  SurfaceTerms(const std::vector<Condition>& conditions,
               const std::vector<ConditionEntry>& registry, const fields::FieldMesh& mesh);

  /// True where the case says anything of the surface, or this.
  bool has_condition(int surface) const { return !conditions_[surface].empty(); }
  bool has_condition(int surface, const std::string& kind) const;
  /// True where a fluid sticks to the surface.
  bool sticks(int surface) const;
  /// True where no term of the surface prescribes anything, or makes it move as one.
  bool is_natural(int surface) const;
  /// True where a term of the surface prescribes the component of the vector unknown, or makes it
  /// move as one.
  bool prescribes(int surface, int component) const;
  /// True where a fluid's surface does not stretch with its rim: a term gives it velocities at
  /// places, or they are zero in all components.
  bool keeps_place(int surface) const;
  bool moves_as_one(int surface) const;
  bool has_held_directions(int surface) const;
  /// Directions along which springs of the face's surface resist a displacement.
  std::vector<Vec3> sprung_directions(const fields::FieldMesh& mesh,
                                      const fields::Face& face) const;
  /// The part of v along which the vector unknown is free there.
  Vec3 free_part(int surface, const Vec3& v) const;
  bool is_interface(int surface) const { return has_condition(surface, interface_condition); }

  /// Constraints prescribed by the terms, for each local node.
  const assembly::Constraints& constraints() const { return fixed_; }
  /// Common motions, each with its surface.
  std::vector<std::pair<int, CommonMotion>> common_motions() const;
  /// Gives what is prescribed of the vector unknown its values on owned nodes. Collective.
  void impose(const Surroundings& s, Vector& u);

  /// Products of vectors that the terms add to a Jacobian.
  int rank() const;
  /// Adds all faces, in the order of the mesh, and then whole surfaces to the residual, and to K
  /// where it is not null. Collective.
  void add(const Surroundings& s, assembly::NodalResidual& R, assembly::BlockAssembler* K) const;
  /// Adds the derivatives with respect to where a fluid's mesh lies. Collective.
  void add_shape(const Surroundings& s, assembly::FluidShapeMatrix& S) const;
  /// Load of the terms of one surface on the field, this rank's part: minus their residual, summed
  /// over all nodes [mN]. Collective.
  Vec3 load(const Surroundings& s, int surface) const;
  void observe(const Surroundings& s, const fields::Face& face,
               std::map<std::string, double>& sums) const;
  void observe_whole(const Surroundings& s, std::map<std::string, double>& found) const;

  /// The states of the terms, see Remembering.
  void follow(const stepping::TimeScheme& scheme);
  void begin_step();
  void end_step(const Surroundings& s);
  /// As numbers of the state, by condition and surface.
  void save(fields::State& state) const;
  /// Returns a sentence about each condition that the state does not know, which begins anew.
  std::string restore(const fields::State& state);

private:
  void take(std::unique_ptr<BoundaryTerm> term, int surface);
  /// Throws Error where a component is given along the normal of a plane. Collective.
  void constrain();
  /// Throws Error where a profile would be made of a part of a section. Collective.
  void check_sections() const;
  std::vector<double> state_of(int surface) const;
  /// Under which it is saved.
  std::string name_of_state(int surface) const;

  const fields::FieldMesh* mesh_;
  std::vector<Condition> kept_;
  std::vector<std::vector<const Condition*>> conditions_;  ///< per surface
  Terms terms_;
  /// Terms by kind, per surface.
  std::vector<std::vector<Constraint*>> constraints_;
  std::vector<std::vector<FaceLoad*>> face_loads_;
  std::vector<std::vector<WholeLoad*>> whole_loads_;
  std::vector<std::vector<Remembering*>> remembering_;
  assembly::Constraints fixed_;
  int highest_precedence_ = 0;
};

}  // namespace tunica::boundary
