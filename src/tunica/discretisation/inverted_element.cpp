#include "tunica/discretisation/inverted_element.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include "tunica/base/reduce.hpp"

namespace tunica::discretisation {

// The rank that holds the least value sends it and all others add zeros; of several such ranks the
// first one does. NaN counts as −∞: no value could be worse.
NamedElement least_element(const fields::FieldMesh& mesh, double value, int element) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double badness = element < 0 ? infinity : std::isnan(value) ? -infinity : value;
  const double worst = global_min(*mesh.comm, badness);
  const int rank = mesh.comm->getRank();
  const bool may_speak = element >= 0 && badness == worst;
  const double speaker = global_min(*mesh.comm, may_speak ? rank : mesh.comm->getSize());
  std::vector<double> told(6, 0.0);  // centre, value, number, region
  if (rank == static_cast<int>(speaker)) {
    for (const int a : mesh.tets[element])
      for (int i = 0; i < 3; ++i) told[i] += 0.25 * mesh.x[a][i];
    told[3] = value;
    told[4] = static_cast<double>(mesh.tet_number[element]);
    told[5] = mesh.region[element];
  }
  told = global_sum(*mesh.comm, told);
  std::ostringstream text;
  text << "element " << static_cast<long long>(told[4]) << " of \""
       << mesh.regions[static_cast<std::size_t>(told[5])] << "\" at (" << told[0] << ", " << told[1]
       << ", " << told[2] << ") of the undeformed mesh";
  return {text.str(), told[3]};
}

// All ranks take part in naming the worst element; one without an inverted one has no candidate.
Outcome check_inversion(const fields::FieldMesh& mesh, double smallest, int element,
                        const std::string& measure) {
  const bool is_fine = element < 0 || smallest > 0.0;  // false for NaN too
  if (all_agree(*mesh.comm, is_fine)) return Outcome::success();
  const NamedElement worst = least_element(mesh, smallest, is_fine ? -1 : element);
  std::ostringstream text;
  text << worst.name << " is inverted (" << measure << " = " << worst.value << ")";
  return Outcome::failure(text.str());
}

// min_e V_e; a NaN ends the search, since no comparison with it would be true.
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
