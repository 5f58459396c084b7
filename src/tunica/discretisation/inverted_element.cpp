#include "tunica/discretisation/inverted_element.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include "tunica/base/reduce.hpp"

namespace tunica::discretisation {

Outcome check_inversion(const fields::FieldMesh& mesh, double smallest, int element,
                        const std::string& measure) {
  const bool is_fine = element < 0 || smallest > 0.0;  // false for NaN too
  if (all_agree(*mesh.comm, is_fine)) return Outcome::success();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double badness = is_fine ? infinity : std::isnan(smallest) ? -infinity : smallest;
  const double worst = global_min(*mesh.comm, badness);
  const int rank = mesh.comm->getRank();
  const double speaker =
      global_min(*mesh.comm, !is_fine && badness == worst ? rank : mesh.comm->getSize());
  Vec3 centre{};
  double value = 0.0, number = 0.0;
  if (rank == static_cast<int>(speaker)) {
    for (const int a : mesh.tets[element]) centre += 0.25 * mesh.x[a];
    value = smallest;
    number = static_cast<double>(mesh.tet_number[element]);
  }
  for (double& c : centre) c = global_sum(*mesh.comm, c);
  value = global_sum(*mesh.comm, value);
  number = global_sum(*mesh.comm, number);
  std::ostringstream text;
  text << "element " << static_cast<long long>(number) << " at (" << centre[0] << ", " << centre[1]
       << ", " << centre[2] << ") of the undeformed mesh is inverted (" << measure << " = " << value
       << ")";
  return Outcome::failure(text.str());
}

Outcome check_volumes(const fields::FieldMesh& mesh, const assembly::ElementGeometry& geometry) {
  double smallest = 1.0;
  int worst = -1;
  for (std::size_t e = 0; e < geometry.size() && !std::isnan(smallest); ++e) {
    const double volume = geometry[e].volume;
    if (worst >= 0 && volume >= smallest) continue;
    smallest = volume;
    worst = static_cast<int>(e);
  }
  return check_inversion(mesh, smallest, worst, "volume in mm^3");
}

}  // namespace tunica::discretisation
