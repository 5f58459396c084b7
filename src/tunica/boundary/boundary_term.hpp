#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tunica/assembly/block_assembler.hpp"
#include "tunica/assembly/fluid_shape.hpp"
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::boundary {

using VectorField = std::function<Vec3(const Vec3& x, double time)>;

/// State of the field with which a term is evaluated, on owned and ghost nodes.
struct Surroundings {
  const fields::FieldMesh* mesh = nullptr;
  const std::vector<Vec3>* reference = nullptr;  ///< positions in the undeformed field [mm]
  const std::vector<Vec3>* position = nullptr;   ///< where the field lies at present [mm]
  const std::vector<Vec3>* u = nullptr;          ///< the vector unknown: velocity or displacement
  const std::vector<Vec3>* w = nullptr;          ///< velocity of the mesh, or of the wall [mm/ms]
  double density = 0.0;                          ///< of a fluid; 0 for a wall [mg/mm³]
  double time = 0.0;                             ///< at which loads act [ms]
  /// Where it is not null, it takes the place of prescribed velocities; for verification.
  const VectorField* velocity = nullptr;
  double viscosity = 0.0;  ///< of a fluid [kPa ms]
  double mesh_rate = 0.0;  ///< ∂w/∂x of a mesh that moves [1/ms]
  /// By which springs of the tissue are stretched where the field is undeformed [mm]; null: not.
  const std::vector<Vec3>* spring_offset = nullptr;
  bool follows = true;  ///< false: Jacobians take the surface for one that does not move
};

/// A component of the vector unknown that the nodes of a surface have in common.
struct CommonMotion {
  int component;
  bool has_force;                            ///< a force on them is given, not the component
  std::function<double(double time)> value;  ///< of the component [mm], or of the force [mN]
};

/// A term on one surface of a field. It derives from one or several of the following four classes;
/// a condition of a case may consist of several terms.
class BoundaryTerm {
public:
  virtual ~BoundaryTerm() = default;
};
using Terms = std::vector<std::unique_ptr<BoundaryTerm>>;

/// A term that prescribes the vector unknown, or a part of it, at the nodes of its surface.
class Constraint : public virtual BoundaryTerm {
public:
  /// Components of the vector unknown that the term prescribes at its nodes.
  virtual std::vector<int> prescribed_components() const { return {}; }
  /// Comes before prescribed() of the same surroundings. Collective.
  virtual void prepare(const Surroundings&) {}
  /// Their values; of the others it says nothing.
  virtual Vec3 prescribed(const Surroundings&, int /*node*/) const { return {}; }
  /// Where surfaces meet, the value of the term with the higher one holds.
  virtual int precedence() const { return 0; }
  /// Directions along which the vector unknown stays zero at its nodes, of length 1.
  virtual std::vector<Vec3> held_directions() const { return {}; }
  /// Components that the surface's nodes have in common, as far as no other term prescribes them.
  /// The term outlives what it returns.
  virtual std::vector<CommonMotion> common_motions() const { return {}; }

  /// True where these values are zero at all times.
  virtual bool prescribes_zero() const { return false; }
  /// True where a fluid sticks to its surface: it has the velocity of the wall there, or none.
  virtual bool sticks() const { return false; }
  /// True where what the term gives a fluid belongs to places: its surface does not stretch when
  /// its rim moves.
  virtual bool keeps_place() const { return false; }
  /// True where the term makes a profile of the whole section of a vessel: no plane of symmetry may
  /// cut its surface.
  virtual bool wants_whole_section() const { return false; }
};

/// A term that is a sum over the faces of its surface.
class FaceLoad : public virtual BoundaryTerm {
public:
  /// Adds the part of one face to the residual, and to the Jacobian where K is not null.
  virtual void add(const Surroundings&, const fields::Face&, assembly::NodalResidual&,
                   assembly::BlockAssembler* K) const = 0;
  /// Adds the derivative of add() with respect to where the fluid's mesh lies, w included.
  virtual void add_shape(const Surroundings&, const fields::Face&,
                         assembly::FluidShapeMatrix&) const {}
  /// Adds what one face does, by names of observables.
  virtual void observe(const Surroundings&, const fields::Face&,
                       std::map<std::string, double>& /*sums*/) const {}
  /// Directions along which springs of the term resist a displacement of the face.
  virtual std::vector<Vec3> sprung_directions(const fields::FieldMesh&, const fields::Face&) const {
    return {};
  }
};

/// A term that looks at its surface as a whole, at the flow through it.
class WholeLoad : public virtual BoundaryTerm {
public:
  /// How many products s w vᵀ add_whole() gives the Jacobian, always.
  virtual int rank() const { return 0; }
  /// Adds the part of the whole surface to the residual on owned nodes, and the products to the
  /// Jacobian where K is not null. Collective.
  virtual void add_whole(const Surroundings&, assembly::NodalResidual&,
                         assembly::BlockAssembler* /*K*/) const {}
  /// Shape derivatives of add_whole(). Collective.
  virtual void add_whole_shape(const Surroundings&, assembly::FluidShapeMatrix&) const {}
  /// Adds what the whole surface does, by names of observables, the same on all ranks. Collective.
  virtual void observe_whole(const Surroundings&, std::map<std::string, double>& /*found*/) const {}
};

/// A term that remembers something from step to step, or follows the time scheme of its field.
class Remembering : public virtual BoundaryTerm {
public:
  /// The scheme by which the state moves; outlives the term. Comes before all that follows.
  virtual void follow(const stepping::TimeScheme&) {}
  /// A step begins, of the scheme's present size, or begins again.
  virtual void begin_step() {}
  /// The step is accepted with these surroundings. Collective.
  virtual void end_step(const Surroundings&) {}
  /// State after end_step(), for checkpoints, the same on all ranks; always the same number of
  /// values, none without a state.
  virtual std::vector<double> state() const { return {}; }
  virtual void restore(const std::vector<double>& /*state*/) {}
};

}  // namespace tunica::boundary
