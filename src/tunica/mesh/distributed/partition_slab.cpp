#include "tunica/mesh/distributed/partition_slab.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/mesh/distributed/cut_points.hpp"
#include "tunica/mesh/distributed/rows.hpp"
#include "tunica/mesh/partition.hpp"
#include "tunica/params/nearest.hpp"

namespace tunica::mesh {

namespace {

constexpr long long most_tets_for_metis = 100000;

bool is_of_wall(char fields) { return (fields & in_wall) != 0; }

SlabPartition partition_on_root(const Slab& slab, const std::vector<bool>& region_is_fluid,
                                const std::string& name) {
  const Comm& comm = *slab.comm;
  const Mesh whole = gathered(slab);
  Partition found;
  on_root(comm, [&] { found = partition(whole, comm.getSize(), region_is_fluid, name); });
  return {spread(comm, found.tet_part, 0, slab.tets),
          spread(comm, found.vertex_owner, 0, slab.vertices)};
}

/// What the vertices of the slab's tetrahedra are: an item of each, in the order of the numbers.
template <class Item>
class OfVertices {
public:
  OfVertices(const Slab& slab, const std::vector<int>& numbers, const std::vector<Item>& of_rows)
      : numbers_(numbers), items_(fetch(*slab.comm, numbers, of_rows, slab.vertices)) {}
  Item operator()(int vertex) const { return items_[place_of(vertex, numbers_)]; }

private:
  const std::vector<int>& numbers_;
  std::vector<Item> items_;
};

/// Parts of the fluid and of the wall that touch.
struct Touch {
  int fluid, wall;
  long long tets;
};

/// On rank 0: how often the parts of the two fields meet in a tetrahedron.
std::vector<Touch> touches(const Slab& slab, const OfVertices<char>& fields,
                           const OfVertices<int>& part) {
  std::map<std::pair<int, int>, long long> counts;
  for (const auto& tet : slab.rows.tets) {
    std::array<bool, 4> is_wall{};
    for (int i = 0; i < 4; ++i) is_wall[i] = is_of_wall(fields(tet[i]));
    if (std::count(is_wall.begin(), is_wall.end(), is_wall[0]) == 4) continue;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        if (!is_wall[i] && is_wall[j]) ++counts[{part(tet[i]), part(tet[j])}];
  }
  std::vector<Touch> mine;
  for (const auto& [parts, tets] : counts) mine.push_back({parts.first, parts.second, tets});
  std::map<std::pair<int, int>, long long> sums;
  for (const Touch& t : gather_rows(*slab.comm, mine)) sums[{t.fluid, t.wall}] += t.tets;
  std::vector<Touch> all;
  for (const auto& [parts, tets] : sums) all.push_back({parts.first, parts.second, tets});
  return all;
}

/// Which rank gets each part of the wall: the closest pairs first.
std::vector<int> ranks_of_wall(std::vector<Touch> all, int ranks) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Touch& a, const Touch& b) { return a.tets > b.tets; });
  std::vector<int> rank_of(ranks, -1);
  std::vector<char> is_taken(ranks, 0);
  for (const Touch& t : all) {
    if (rank_of[t.wall] >= 0 || is_taken[t.fluid]) continue;
    rank_of[t.wall] = t.fluid;
    is_taken[t.fluid] = 1;
  }
  for (int& rank : rank_of) {
    if (rank >= 0) continue;
    const auto free = std::find(is_taken.begin(), is_taken.end(), 0);
    *free = 1;
    rank = static_cast<int>(free - is_taken.begin());
  }
  return rank_of;
}

/// The owner of most of four vertices; of several the lowest.
int part_of(std::array<int, 4> owners) {
  std::sort(owners.begin(), owners.end());
  int best = owners[0], most = 0;
  for (const int owner : owners) {
    const int count = static_cast<int>(std::count(owners.begin(), owners.end(), owner));
    if (count > most) {
      best = owner;
      most = count;
    }
  }
  return best;
}

SlabPartition partition_by_planes(const Slab& slab, const std::vector<char>& fields) {
  const CommPtr& comm = slab.comm;
  SlabPartition found;
  found.vertex_owner.assign(slab.rows.vertices.size(), 0);
  for (const bool of_wall : {false, true}) {
    std::vector<Vec3> points;
    std::vector<std::size_t> rows;
    for (std::size_t v = 0; v < fields.size(); ++v)
      if (is_of_wall(fields[v]) == of_wall) {
        points.push_back(slab.rows.vertices[v]);
        rows.push_back(v);
      }
    if (global_sum(*comm, static_cast<double>(points.size())) == 0.0) continue;
    const std::vector<int> parts = cut_by_planes(points, comm);
    for (std::size_t k = 0; k < rows.size(); ++k) found.vertex_owner[rows[k]] = parts[k];
  }
  const std::vector<int> used = vertices_of(slab.rows.tets);
  {
    const OfVertices<char> fields_of(slab, used, fields);
    const OfVertices<int> parts(slab, used, found.vertex_owner);
    std::vector<int> rank_of(comm->getSize(), 0);
    const std::vector<Touch> all = touches(slab, fields_of, parts);
    if (comm->getRank() == 0) rank_of = ranks_of_wall(all, comm->getSize());
    Teuchos::broadcast(*comm, 0, comm->getSize(), rank_of.data());
    for (std::size_t v = 0; v < fields.size(); ++v)
      if (is_of_wall(fields[v])) found.vertex_owner[v] = rank_of[found.vertex_owner[v]];
  }
  const OfVertices<int> owner(slab, used, found.vertex_owner);
  found.tet_part.reserve(slab.rows.tets.size());
  for (const auto& t : slab.rows.tets)
    found.tet_part.push_back(part_of({owner(t[0]), owner(t[1]), owner(t[2]), owner(t[3])}));
  return found;
}

}  // namespace

std::vector<std::string> partitioner_names() { return {"automatic", "metis", "geometric"}; }

Partitioner partitioner_of(const std::string& name) {
  const std::vector<std::string> names = partitioner_names();
  const auto found = std::find(names.begin(), names.end(), name);
  TUNICA_CHECK(found != names.end(),
               "unknown partitioner \"" + name + "\". " + params::did_you_mean(name, names));
  return static_cast<Partitioner>(found - names.begin());
}

SlabPartition partition(const Slab& slab, const std::vector<bool>& region_is_fluid,
                        const std::vector<char>& fields, Partitioner by, const std::string& name) {
  const int ranks = slab.comm->getSize();
  TUNICA_CHECK(ranks <= slab.tets, name + ": more ranks than elements: " + std::to_string(ranks) +
                                       " ranks, " + std::to_string(slab.tets) +
                                       " tetrahedra. Use fewer ranks.");
  if (ranks == 1)
    return {std::vector<int>(slab.rows.tets.size(), 0),
            std::vector<int>(slab.rows.vertices.size(), 0)};
  if (by == Partitioner::automatic)
    by = slab.tets <= most_tets_for_metis ? Partitioner::metis : Partitioner::geometric;
  if (by == Partitioner::metis) return partition_on_root(slab, region_is_fluid, name);
  return partition_by_planes(slab, fields);
}

Balance balance(const Slab& slab, const std::vector<char>& fields, const SlabPartition& partition) {
  const CommPtr& comm = slab.comm;
  const auto ranks = static_cast<std::size_t>(comm->getSize());
  std::vector<double> owned(2 * ranks, 0.0);
  for (std::size_t v = 0; v < fields.size(); ++v) {
    const auto owner = static_cast<std::size_t>(partition.vertex_owner[v]);
    owned[owner] += (fields[v] & in_fluid) != 0;
    owned[ranks + owner] += is_of_wall(fields[v]);
  }
  owned = global_sum(*comm, owned);
  const auto worst = [&](std::size_t first) {
    double sum = 0.0, most = 0.0;
    for (std::size_t r = first; r < first + ranks; ++r) {
      sum += owned[r];
      most = std::max(most, owned[r]);
    }
    return sum > 0.0 ? most * static_cast<double>(ranks) / sum : 1.0;
  };
  const std::vector<int> used = vertices_of(slab.rows.tets);
  const OfVertices<int> owner(slab, used, partition.vertex_owner);
  double cut = 0.0;
  for (const auto& t : slab.rows.tets) {
    const int first = owner(t[0]);
    cut += owner(t[1]) != first || owner(t[2]) != first || owner(t[3]) != first;
  }
  return {worst(0), worst(ranks), global_sum(*comm, cut) / static_cast<double>(slab.tets)};
}

}  // namespace tunica::mesh
