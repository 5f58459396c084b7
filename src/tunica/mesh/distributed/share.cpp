#include "tunica/mesh/distributed/share.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/mesh/distributed/rows.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::mesh {

namespace {

constexpr std::size_t tets_at_once = std::size_t{1} << 17;  ///< in messages

long long largest(const Comm& comm, std::size_t mine) {
  return static_cast<long long>(global_max(comm, static_cast<double>(mine)));
}

/// Some ranks, each once.
class Ranks {
public:
  void add(int rank) {
    if (std::find(ranks_.begin(), ranks_.begin() + count_, rank) == ranks_.begin() + count_)
      ranks_[count_++] = rank;
  }
  const int* begin() const { return ranks_.data(); }
  const int* end() const { return ranks_.data() + count_; }

private:
  std::array<int, 5> ranks_{};
  int count_ = 0;
};

/// Who needs a tetrahedron: its part, and the owners of its vertices.
class TetRanks {
public:
  TetRanks(const Slab& slab, const SlabPartition& partition)
      : slab_(slab), partition_(partition), used_(vertices_of(slab.rows.tets)),
        owner_(fetch(*slab.comm, used_, partition.vertex_owner, slab.vertices)) {}
  Ranks operator()(std::size_t tet) const {
    Ranks ranks;
    ranks.add(partition_.tet_part[tet]);
    for (const int v : slab_.rows.tets[tet]) ranks.add(owner_[place_of(v, used_)]);
    return ranks;
  }

private:
  const Slab& slab_;
  const SlabPartition& partition_;
  std::vector<int> used_, owner_;
};

/// Sends an item of some tetrahedra to those who need them; adds what comes.
template <class Of, class Item>
void send(const Comm& comm, std::size_t first, std::size_t end, const TetRanks& ranks_of,
          const Of& item_of, std::vector<Item>& received) {
  std::vector<Item> items;
  std::vector<int> ranks;
  for (std::size_t t = first; t < end; ++t)
    for (const int r : ranks_of(t)) {
      items.push_back(item_of(t));
      ranks.push_back(r);
    }
  const std::vector<Item> some = exchange_to(comm, items, ranks).items;
  received.insert(received.end(), some.begin(), some.end());
}

/// items[k] ← items[order[k]]
template <class Item>
void reorder(std::vector<Item>& items, const std::vector<int>& order) {
  std::vector<Item> ordered;
  ordered.reserve(items.size());
  for (const int k : order) ordered.push_back(items[k]);
  items.swap(ordered);
}

/// How many tetrahedra will come.
std::size_t count_tets(const Slab& slab, const TetRanks& ranks_of) {
  std::vector<int> counts(slab.comm->getSize(), 0);
  for (std::size_t t = 0; t < slab.rows.tets.size(); ++t)
    for (const int r : ranks_of(t)) ++counts[r];
  std::size_t total = 0;
  for (const int n : exchange_counts(*slab.comm, counts)) total += static_cast<std::size_t>(n);
  return total;
}

/// Tetrahedra with all that is theirs, in the order of the whole; their vertices still have its
/// numbers.
void move_tets(const Slab& slab, const SlabPartition& partition, Share& share) {
  const Comm& comm = *slab.comm;
  const TetRanks ranks_of(slab, partition);
  const std::size_t total = count_tets(slab, ranks_of), mine = slab.rows.tets.size();
  Mesh& mesh = share.mesh;
  mesh.tets.reserve(total);
  mesh.tet_region.reserve(total);
  share.tet_part.reserve(total);
  share.numbers.tets.reserve(total);
  for (const TetVectors& vectors : slab.rows.tet_vectors) {
    mesh.tet_vectors.push_back({vectors.name, {}});
    mesh.tet_vectors.back().values.reserve(total);
  }
  const long long first_tet = slab.place().first_tet;
  const auto rounds = static_cast<std::size_t>(largest(comm, mine)) / tets_at_once + 1;
  for (std::size_t round = 0; round < rounds; ++round) {
    const std::size_t first = std::min(mine, round * tets_at_once);
    const std::size_t end = std::min(mine, first + tets_at_once);
    const auto move = [&](const auto& item_of, auto& received) {
      send(comm, first, end, ranks_of, item_of, received);
    };
    move([&](std::size_t t) { return slab.rows.tets[t]; }, mesh.tets);
    move([&](std::size_t t) { return slab.rows.tet_region[t]; }, mesh.tet_region);
    move([&](std::size_t t) { return partition.tet_part[t]; }, share.tet_part);
    move([&](std::size_t t) { return first_tet + static_cast<long long>(t); }, share.numbers.tets);
    for (std::size_t k = 0; k < mesh.tet_vectors.size(); ++k)
      move([&](std::size_t t) { return slab.rows.tet_vectors[k].values[t]; },
           mesh.tet_vectors[k].values);
  }
}

void sort_tets(Share& share) {
  std::vector<int> order(share.numbers.tets.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&numbers = share.numbers.tets](int a, int b) { return numbers[a] < numbers[b]; });
  reorder(share.numbers.tets, order);
  reorder(share.mesh.tets, order);
  reorder(share.mesh.tet_region, order);
  reorder(share.tet_part, order);
  for (TetVectors& vectors : share.mesh.tet_vectors) reorder(vectors.values, order);
}

/// Gives the vertices of the share numbers of its own.
void number_vertices(Share& share) {
  share.numbers.vertices = vertices_of(share.mesh.tets);
  for (auto& tet : share.mesh.tets)
    for (int& v : tet) v = place_of(v, share.numbers.vertices);
}

struct Triangle {
  std::array<int, 3> vertices;
  int surface;
  long long number;
  std::array<int, 2> regions;
};

/// Takes up triangles with the whole's numbers, sorted by their own. Throws where one has a vertex
/// that the rank does not know: no tetrahedron at its lowest vertex has it.
void take_triangles(std::vector<Triangle> triangles, const std::string& name, Share& share) {
  std::sort(triangles.begin(), triangles.end(),
            [](const Triangle& a, const Triangle& b) { return a.number < b.number; });
  Mesh& mesh = share.mesh;
  mesh.triangles.clear();
  mesh.triangle_surface.clear();
  share.numbers.triangles.clear();
  share.regions_beside.clear();
  for (const Triangle& t : triangles) {
    std::array<int, 3> local{};
    for (std::size_t i = 0; i < 3; ++i) {
      local[i] = place_of(t.vertices[i], share.numbers.vertices);
      TUNICA_CHECK(local[i] >= 0, name + ": triangle " + std::to_string(t.number) +
                                      " of surface \"" + mesh.surfaces[t.surface].name +
                                      "\" is not a face of any tetrahedron");
    }
    mesh.triangles.push_back(local);
    mesh.triangle_surface.push_back(t.surface);
    share.numbers.triangles.push_back(t.number);
    share.regions_beside.push_back(t.regions);
  }
}

/// Triangles to the owners of their lowest vertices.
std::vector<Triangle> triangles_to_check(const Slab& slab, const SlabPartition& partition) {
  const std::vector<int> used = vertices_of(slab.rows.triangles);
  const std::vector<int> owner = fetch(*slab.comm, used, partition.vertex_owner, slab.vertices);
  std::vector<Triangle> all;
  std::vector<int> ranks;
  const long long first = slab.place().first_triangle;
  for (std::size_t i = 0; i < slab.rows.triangles.size(); ++i) {
    const auto& v = slab.rows.triangles[i];
    all.push_back({v, slab.rows.triangle_surface[i], first + static_cast<long long>(i), {-1, -1}});
    ranks.push_back(owner[place_of(*std::min_element(v.begin(), v.end()), used)]);
  }
  return exchange_to(*slab.comm, all, ranks).items;
}

/// Checked triangles to all who need them: owners of their vertices, parts of their tetrahedra.
std::vector<Triangle> triangles_to_keep(const Share& share, const std::vector<int>& owner,
                                        const Covering& covered) {
  const auto beside = regions_beside(share.mesh, covered);
  std::vector<Triangle> all;
  std::vector<int> ranks;
  for (std::size_t i = 0; i < share.mesh.triangles.size(); ++i) {
    Triangle t{{}, share.mesh.triangle_surface[i], share.numbers.triangles[i], beside[i]};
    Ranks needed;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(share.mesh.triangles[i][k]);
      t.vertices[k] = share.numbers.vertices[v];
      needed.add(owner[v]);
    }
    for (const int tet : covered.tets[i])
      if (tet >= 0) needed.add(share.tet_part[tet]);
    for (const int r : needed) {
      all.push_back(t);
      ranks.push_back(r);
    }
  }
  return exchange_to(*share.comm, all, ranks).items;
}

/// What triangles cover of the faces on all ranks. Throws Error on all alike.
Covering check_faces(const Share& share, const std::string& name) {
  Covering covered;
  on_all(*share.comm, [&] {
    const Excerpt mine = share.excerpt();
    check_shapes(mine, name);
    covered = covering(mine, name);
  });
  const auto bare =
      static_cast<long long>(global_sum(*share.comm, static_cast<double>(covered.bare)));
  on_all(*share.comm, [&] {
    if (covered.bare > 0) throw Error(bare_faces(bare, covered.first_bare, name));
  });
  return covered;
}

}  // namespace

GhostValues::GhostValues(const CommPtr& comm, const std::vector<int>& owner,
                         const std::vector<int>& numbers)
    : comm_(comm), from_(comm->getSize(), 0) {
  for (std::size_t v = 0; v < owner.size(); ++v)
    if (owner[v] != comm->getRank()) ghosts_.push_back(static_cast<int>(v));
  std::stable_sort(ghosts_.begin(), ghosts_.end(),
                   [&owner](int a, int b) { return owner[a] < owner[b]; });
  std::vector<int> wanted;
  for (const int v : ghosts_) {
    ++from_[owner[v]];
    wanted.push_back(numbers[v]);
  }
  Received<int> asked = exchange(*comm, wanted, from_);
  to_ = std::move(asked.counts);
  for (const int number : asked.items) sent_.push_back(place_of(number, numbers));
}

Share distribute(Slab slab, const SlabPartition& partition, const std::string& name) {
  Share share;
  share.comm = slab.comm;
  share.tets = slab.tets;
  share.mesh.regions = slab.rows.regions;
  share.mesh.surfaces = slab.rows.surfaces;
  std::vector<Triangle> triangles = triangles_to_check(slab, partition);
  move_tets(slab, partition, share);
  const std::vector<Vec3> x = std::move(slab.rows.vertices);
  slab.rows = {};
  sort_tets(share);
  number_vertices(share);
  share.mesh.vertices = fetch(*share.comm, share.numbers.vertices, x, slab.vertices);
  const std::vector<int> owner =
      fetch(*share.comm, share.numbers.vertices, partition.vertex_owner, slab.vertices);
  for (const int rank : owner) share.is_owned.push_back(rank == share.comm->getRank());

  on_all(*share.comm, [&] { take_triangles(std::move(triangles), name, share); });
  const Covering covered = check_faces(share, name);
  triangles = triangles_to_keep(share, owner, covered);
  take_triangles(std::move(triangles), name, share);
  share.ghosts = GhostValues(share.comm, owner, share.numbers.vertices);
  return share;
}

Share share_of(Slab slab, const std::vector<bool>& region_is_fluid, Partitioner by,
               const std::string& name) {
  const std::vector<char> fields = vertex_fields(slab, region_is_fluid, name);
  const SlabPartition parts = partition(slab, region_is_fluid, fields, by, name);
  return distribute(std::move(slab), parts, name);
}

void check_interface(const Share& share, const std::vector<std::string>& fluid,
                     const std::vector<std::string>& wall,
                     const std::vector<std::string>& interface) {
  const Excerpt mine = share.excerpt();
  std::optional<InterfaceCheck> check;
  on_all(*share.comm, [&] {
    check.emplace(mine, share.regions_beside, fluid, wall, interface);
    check->check_neighbours();
  });
  const auto summed = [&](long long count) {
    return static_cast<long long>(global_sum(*share.comm, static_cast<double>(count)));
  };
  const long long alone = summed(check->alone()), triangles = summed(check->triangles());
  on_all(*share.comm, [&] {
    if (check->alone() > 0) throw Error(check->nonconforming(alone, triangles));
  });
  on_all(*share.comm, [&] { check->check_elsewhere(); });
}

std::vector<char> marked_regions(const Mesh& mesh, const std::vector<int>& regions) {
  std::vector<char> is_in(mesh.regions.size(), 0);
  for (const int r : regions) is_in[r] = 1;
  return is_in;
}

}  // namespace tunica::mesh
