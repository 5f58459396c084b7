#include "tunica/mesh/distributed/cut_points.hpp"

#include <Zoltan2_BasicVectorAdapter.hpp>
#include <Zoltan2_PartitioningProblem.hpp>
#include <numeric>

#include "tunica/base/reduce.hpp"
#include "tunica/mesh/distributed/rows.hpp"

namespace tunica::mesh {

namespace {

/// Layers of a made mesh lie across the axes. A cut through one of them, which balance asks for, is
/// a line where the layer is tilted a little, and anything where it is not.
std::vector<Vec3> tilted_points(const std::vector<Vec3>& points) {
  constexpr double a = 0.011, b = 0.017, c = 0.023;
  std::vector<Vec3> tilted;
  tilted.reserve(points.size());
  for (const auto& [x, y, z] : points)
    tilted.push_back({x + a * y + b * z, y + b * z + c * x, z + c * x + a * y});
  return tilted;
}

/// points: the rank's portion of all. Zoltan's bisection takes no rank without any.
std::vector<int> bisected(const std::vector<Vec3>& points, long long total, const CommPtr& comm) {
  using Types = Zoltan2::BasicUserTypes<double, LocalOrdinal, GlobalOrdinal>;
  using Adapter = Zoltan2::BasicVectorAdapter<Types>;

  std::vector<GlobalOrdinal> numbers(points.size());
  std::iota(numbers.begin(), numbers.end(), portion_of(total, *comm).first);
  const std::vector<Vec3> tilted = tilted_points(points);
  const double* x = tilted.front().data();
  Adapter adapter(static_cast<LocalOrdinal>(points.size()), numbers.data(), x, x + 1, x + 2, 3, 3,
                  3);
  Teuchos::ParameterList list;
  list.set("algorithm", "rcb");
  list.set("num_global_parts", comm->getSize());
  list.set("imbalance_tolerance", 1.01);
  list.sublist("zoltan_parameters").set("DEBUG_LEVEL", "0");
  Zoltan2::PartitioningProblem<Adapter> problem(&adapter, &list, comm);
  problem.solve();
  const int* parts = problem.getSolution().getPartListView();
  return {parts, parts + points.size()};
}

}  // namespace

std::vector<int> cut_by_planes(const std::vector<Vec3>& points, const CommPtr& comm) {
  const int ranks = comm->getSize();
  const auto mine = static_cast<long long>(points.size());
  const long long first = sum_before(*comm, mine), total = global_sum(*comm, mine);
  std::vector<int> rows(points.size());
  std::iota(rows.begin(), rows.end(), static_cast<int>(first));
  if (total < ranks) return rows;  // a part for each
  const std::vector<Vec3> even = spread(*comm, points, first, total);
  return fetch(*comm, rows, bisected(even, total, comm), total);
}

}  // namespace tunica::mesh
