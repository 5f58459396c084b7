#include "tunica/problems/tissue_hold.hpp"

#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/surface_tri3.hpp"

namespace tunica::problems {

namespace {

/// Springs of a surface; their stiffness is zero where there are none.
struct Springs {
  double stiffness = 0.0;  ///< [kPa/mm]
  bool is_normal = false;
};

Springs springs_of(const boundary::Condition& condition) {
  if (condition.kind() != "support") return {};
  return {condition.list.get<double>("stiffness"),
          condition.list.get<std::string>("direction") == "normal"};
}

}  // namespace

bool has_springs(const std::vector<boundary::Condition>& conditions) {
  for (const boundary::Condition& condition : conditions)
    if (springs_of(condition).stiffness > 0.0) return true;
  return false;
}

// t = k |N·ō| or k |ō|, ō the mean of o over a face;  (Σ A t²/Σ A)^½ and max t
TissueHold tissue_hold(const std::vector<boundary::Condition>& conditions,
                       const fields::FieldMesh& mesh, const std::vector<Vec3>& offset) {
  TissueHold mine;
  std::vector<double> sums(2, 0.0);  // Σ A t², Σ A
  for (const boundary::Condition& condition : conditions) {
    const Springs springs = springs_of(condition);
    if (springs.stiffness == 0.0 || offset.empty()) continue;
    const int surface = mesh.surface_index(condition.surface);
    for (const fields::Face& face : mesh.faces) {
      if (face.surface != surface || !face.is_owned) continue;
      const auto x = assembly::gather(mesh.x, face.nodes), o = assembly::gather(offset, face.nodes);
      const Vec3 n = kernels::area_normal(x), mean = 1.0 / 3.0 * (o[0] + o[1] + o[2]);
      const double area = norm(n);
      const double stretch = springs.is_normal ? std::abs(dot(n, mean)) / area : norm(mean);
      const double t = springs.stiffness * stretch;
      sums[0] += area * t * t;
      sums[1] += area;
      if (t <= mine.most) continue;
      mine.most = t;
      mine.at = 1.0 / 3.0 * (x[0] + x[1] + x[2]);
    }
  }
  const Comm& comm = *mesh.comm;
  const std::vector<double> all = global_sum(comm, sums);
  TissueHold hold;
  if (all[1] > 0.0) hold.mean = std::sqrt(all[0] / all[1]);
  hold.most = global_max(comm, mine.most);
  // Of ranks that have the largest, the greatest coordinates: one face, but for exact ties.
  constexpr double nowhere = -1e300;
  for (int i = 0; i < 3; ++i)
    hold.at[i] = global_max(comm, mine.most == hold.most ? mine.at[i] : nowhere);
  return hold;
}

}  // namespace tunica::problems
