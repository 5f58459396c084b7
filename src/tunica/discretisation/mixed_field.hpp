#pragma once
#include <functional>
#include <map>
#include <memory>

#include "tunica/assembly/common_motion.hpp"
#include "tunica/assembly/element_geometry.hpp"
#include "tunica/base/outcome.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/boundary/surface_terms.hpp"
#include "tunica/linear/named_operators.hpp"
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::discretisation {

/// Common base of fluid and wall: a vector and a scalar at each node, with residual and Jacobian as
/// sums over elements and faces, and their history: that of the time scheme of the vector, of
/// elements and of surfaces.
///
/// A step is begun, what it prescribes is fixed, then come residuals and Jacobians in any number,
/// and it is ended or begun anew. Another order throws std::logic_error.
class MixedField : public linear::NamedOperators {
public:
  const fields::FieldMesh& mesh() const { return *mesh_; }
  /// The mesh whose nodes carry the scalars: that of the field, except for scalars that jump.
  const fields::FieldMesh& scalar_mesh() const { return fields::scalar_mesh(*mesh_, split()); }
  /// Null where they do not.
  const fields::SplitMesh* split() const { return split_.get(); }
  /// Graph of the nodes that carry the scalars. Built on first request.
  const fields::NodeGraph& scalar_graph() const;
  /// Elements of all Jacobians so far and the time they took on this rank.
  const Throughput& throughput() const { return throughput_; }

  const algebra::BlockSpacePtr& space() const { return space_; }
  /// F at x, or why x is not admissible (an inverted element), the same on all ranks. Rows of
  /// constrained unknowns are zero. Collective.
  Outcome residual(const algebra::BlockVector& x, algebra::BlockVector& F);
  /// Brings jacobian() to x. Collective.
  void assemble_jacobian(const algebra::BlockVector& x);
  /// Made when it is first asked for: a field that is part of a system does without. Collective
  /// then.
  const fields::BlockOperator& jacobian() const { return matrix(); }
  /// Adds the Jacobian at x to that of a system, but for the products of low rank, which are those
  /// of products() then.
  void add_jacobian(const algebra::BlockVector& x, const assembly::Whole& whole);
  /// Null where the field has none.
  const std::shared_ptr<algebra::LowRank>& products() const { return products_; }
  /// (dxᵀ M dx)^½ with the mass matrices of all unknowns, the norm of [LY1] newstop. Collective.
  double mass_norm(const algebra::BlockVector& dx) const;
  /// Corrects an increment: zero for prescribed unknowns, equal for those that move as one.
  /// Collective.
  void hold_prescribed(algebra::BlockVector& dx) const;

  const stepping::TimeScheme& time_scheme() const { return *scheme_; }
  /// Prescribed unknowns, per local node.
  const assembly::Constraints& constraints() const { return fixed_; }
  /// Histories on elements, by name.
  virtual std::map<std::string, fields::Restartable*> element_histories();
  /// Accepts x as the state of the new time. Collective.
  void end_step(const algebra::BlockVector& x);
  /// History besides x that is not on elements.
  virtual void save_history(fields::State& state) const;
  /// x: of the state. Returns a sentence about what the state does not know and begins anew.
  /// Collective.
  virtual std::string restore_history(const fields::State& state, const algebra::BlockVector& x);

protected:
  /// Parts of a field.
  struct Parts {
    fields::NodalBlocks blocks;
    std::vector<boundary::Condition> conditions;
    const std::vector<boundary::ConditionEntry>& registry;
    std::unique_ptr<stepping::TimeScheme> scheme;
    std::unique_ptr<fields::SplitMesh> split = nullptr;  ///< where scalars jump
    bool is_solid = false;                               ///< vectors are displacements
  };
  /// mesh must outlive the object. Collective.
  MixedField(const fields::FieldMesh& mesh, Parts parts);

  /// Takes the values at x to owned and ghost nodes. Collective.
  virtual void read(const algebra::BlockVector& x) = 0;
  /// False where the values read cannot be assembled, on all ranks alike.
  virtual Outcome is_admissible() const { return Outcome::success(); }
  /// Fills R_, and K where it is not null, for the values read.
  virtual void assemble(assembly::BlockAssembler* K) = 0;
  /// Surroundings for the terms of the surfaces, from the values read.
  virtual boundary::Surroundings surroundings() const = 0;
  /// Remembers something per local element, which goes along where the mesh moves; accept: brings
  /// it to the values read, where a step ends.
  using Accept = std::function<void(stepping::Timeline&)>;
  stepping::Timeline* remember(const std::string& name, stepping::Timeline timeline, Accept accept);
  /// A vector, by the time scheme; values: gives what belongs to the values read.
  using ElementValues = std::function<std::vector<Vec3>()>;
  stepping::Timeline* remember(const std::string& name, const ElementValues& values);
  /// Where a step begins. awaited: what has to be called before there are residuals; null: nothing.
  void begin(const char* awaited);
  /// Sets the call awaited within a step. Throws std::logic_error if none has begun.
  void wait_for(const char* awaited);
  /// Sets the call awaited after a move of the domain, also between steps, which must still be
  /// begun.
  void wait_after_move_for(const char* awaited);
  /// There have been residuals in some step.
  bool has_been_ready() const { return has_been_ready_; }

  /// The elements on which masses are taken.
  virtual const assembly::ElementGeometry& geometry() const = 0;

  const fields::FieldMesh* mesh_;
  std::unique_ptr<fields::SplitMesh> split_;
  std::unique_ptr<stepping::TimeScheme> scheme_;
  stepping::Timeline timeline_;  ///< of the vector
  boundary::SurfaceTerms surfaces_;
  assembly::Constraints fixed_;  ///< per local node
  assembly::NodalResidual R_;

private:
  static constexpr const char* first_call = "begin_step()";

  struct ElementQuantity {
    std::string name;
    std::unique_ptr<stepping::Timeline> timeline;
    Accept accept;
  };

  void check_ready() const;
  void tie_surfaces();
  fields::BlockOperator& matrix() const;
  void fill(assembly::BlockAssembler& K);
  assembly::CommonMotions* common_motions() {
    return common_motions_.is_empty() ? nullptr : &common_motions_;
  }
  /// The displacements or forces of common motions at the present time.
  std::vector<double> motion_values() const;

  fields::NodalBlocks blocks_;
  bool is_solid_;
  algebra::BlockSpacePtr space_;
  mutable std::unique_ptr<fields::BlockOperator> K_;  ///< null before it is asked for
  mutable std::unique_ptr<fields::NodeGraph> scalar_graph_;
  std::shared_ptr<algebra::LowRank> products_;  ///< null where there are none
  std::vector<ElementQuantity> on_elements_;
  std::vector<boundary::CommonMotion> given_motions_;
  assembly::CommonMotions common_motions_;
  Throughput throughput_;
  const char* awaited_ = first_call;  ///< has to come before a residual; null: nothing
  bool has_begun_ = false, has_been_ready_ = false;
};

}  // namespace tunica::discretisation
