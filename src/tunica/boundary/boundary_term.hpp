#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tunica/assembly/block_assembler.hpp"

namespace tunica::boundary {

using VectorField = std::function<Vec3(const Vec3& x, double time)>;

/// What a term sees of its field when it is evaluated, on owned and ghost nodes.
struct Surroundings {
  const fields::FieldMesh* mesh;
  const std::vector<Vec3>* reference;  ///< positions in the undeformed field [mm]
  const std::vector<Vec3>* position;   ///< where the field lies at present [mm]
  const std::vector<Vec3>* u;          ///< the vector unknown: velocity or displacement
  const std::vector<Vec3>* w;          ///< velocity of the mesh; null for a wall [mm/ms]
  double density;                      ///< of a fluid; 0 for a wall [mg/mm³]
  double time;                         ///< at which loads act [ms]
  /// Where it is not null, it takes the place of prescribed velocities; for verification.
  const VectorField* velocity = nullptr;
};

/// What happens on one surface of a field. A term adds to residual and Jacobian, or prescribes
/// components of the vector unknown, or both. A condition of a case may be made of several terms.
class BoundaryTerm {
public:
  virtual ~BoundaryTerm() = default;

  /// Components of the vector unknown that the term prescribes at its nodes.
  virtual std::vector<int> prescribed_components() const { return {}; }
  /// Their values; of the others it says nothing.
  virtual Vec3 prescribed(const Surroundings&, int /*node*/) const { return {}; }
  /// Where surfaces meet, the value of the term with the higher one holds.
  virtual int precedence() const { return 0; }

  /// Adds the part of one face to the residual, and to the Jacobian where K is not null.
  virtual void add(const Surroundings&, const fields::Face&, assembly::NodalResidual&,
                   assembly::BlockAssembler* /*K*/) const {}

  /// Adds what one face does, by names of observables.
  virtual void observe(const Surroundings&, const fields::Face&,
                       std::map<std::string, double>& /*sums*/) const {}
};

using Terms = std::vector<std::unique_ptr<BoundaryTerm>>;

}  // namespace tunica::boundary
