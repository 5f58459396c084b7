#pragma once
#include <memory>

#include "tunica/fields/field_mesh.hpp"

namespace tunica::problems {

/// Effect of the steps of a search for a prestress, s on nodes.
class PrestressMethod {
public:
  virtual ~PrestressMethod() = default;
  /// The prestretch after a step s, on owned nodes, from the present one. Collective.
  virtual std::vector<Mat3> prestretch_after(const std::vector<Vec3>& s,
                                             const std::vector<Mat3>& present) = 0;
  /// The last one stays.
  virtual void keep() {}
  /// A load step begins; or it was given up, and all goes back to where it began.
  virtual void begin_load() {}
  virtual void undo_load() {}
  /// PrestressPoint::shape, and back.
  virtual std::vector<Vec3> shape() const { return {}; }
  virtual void start_from(const std::vector<Vec3>& /*shape*/) {}
};

/// "stress-free shape" or "deformation gradient" (prestress.hpp). mesh must outlive it.
std::unique_ptr<PrestressMethod> make_prestress_method(bool is_by_shape,
                                                       const fields::FieldMesh& mesh);

}  // namespace tunica::problems
