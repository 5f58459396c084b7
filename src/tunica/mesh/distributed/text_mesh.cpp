#include "tunica/mesh/distributed/text_mesh.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/sort_once.hpp"
#include "tunica/mesh/distributed/broadcast.hpp"
#include "tunica/mesh/distributed/rows.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/formats/number_tags.hpp"
#include "tunica/mesh/read.hpp"
#include "tunica/mesh/text.hpp"

namespace tunica::mesh {
namespace {

using Triple = std::array<int, 3>;

Triple ascending(Triple v) {
  std::sort(v.begin(), v.end());
  return v;
}

/// Which ranks have the lowest vertices of these faces, which are in their order.
std::vector<int> counts_by_lowest(const Slab& slab, const std::vector<Triple>& faces) {
  std::vector<int> lowest;
  lowest.reserve(faces.size());
  for (const Triple& face : faces) lowest.push_back(face[0]);
  return rows_by_rank(*slab.comm, lowest, slab.vertices);
}

/// The rows as the file has them: regions and surfaces are its tags.
class TextMesh {
public:
  TextMesh(const std::string& path, const CommPtr& comm, int rows_at_once)
      : path_(path), comm_(*comm), rows_(comm, rows_at_once) {
    slab_.comm = comm;
    rows_.run([&](RowStream& rows) {
      text_reader(path)(rows);
      check_number("vertices", rows.vertices.count(), 1);
      check_number("tetrahedra on a rank", rows.tets.count(), comm->getSize());
    });
    take_vertices();
    take_tets();
    take_triangles();
    take_vectors();
  }

  Slab finish() {
    check_corners(mesh_.tets, "volume");
    check_corners(mesh_.triangles, "surface");
    mesh_.regions = number(rows_.region_names, "region", mesh_.tet_region);
    orient();
    drop_untagged_triangles();
    mesh_.surfaces = number(rows_.surface_names, "surface", mesh_.triangle_surface);
    drop_unused_vertices();
    return std::move(slab_);
  }

private:
  void check_number(const std::string& what, long long count, int ranks) const {
    TUNICA_CHECK(
        count / ranks < std::numeric_limits<int>::max(),
        path_ + ": " + std::to_string(count / ranks) + " " + what + ", more than can be numbered");
  }

  void take_vertices() {
    mesh_.vertices = rows_.vertices.take_portions();
    slab_.vertices = rows_.vertices.count();
  }

  void take_tets() {
    const std::vector<TetRow> rows = rows_.tets.take_portions();
    slab_.tets = rows_.tets.count();
    TUNICA_CHECK(slab_.tets > 0, path_ + ": the file has no tetrahedra");
    mesh_.tets.reserve(rows.size());
    mesh_.tet_region.reserve(rows.size());
    tet_number_.reserve(rows.size());
    for (const TetRow& row : rows) {
      mesh_.tets.push_back(row.corners);
      mesh_.tet_region.push_back(row.tag);
      tet_number_.push_back(row.number);
    }
  }

  void take_triangles() {
    for (const TriangleRow& row : rows_.triangles.take_portions()) {
      mesh_.triangles.push_back(row.corners);
      mesh_.triangle_surface.push_back(row.tag);
    }
    slab_.triangles = rows_.triangles.count();
  }

  void take_vectors() {
    std::vector<std::string> names = rows_.vector_names;
    broadcast(comm_, names);
    for (const std::string& name : names)
      mesh_.tet_vectors.push_back({name, std::vector<Vec3>(mesh_.tets.size(), Vec3{})});
    const std::vector<VectorRow> rows = rows_.vectors.take_portions();
    std::vector<int> ranks;
    ranks.reserve(rows.size());
    for (const VectorRow& row : rows) ranks.push_back(rank_of_row(row.tet, slab_.tets, comm_));
    const long long first = slab_.place().first_tet;
    for (const VectorRow& row : exchange_to(comm_, rows, ranks).items)
      mesh_.tet_vectors[row.set].values[row.tet - first] = row.value;
  }

  template <std::size_t N>
  void check_corners(const std::vector<std::array<int, N>>& elements, const std::string& kind) {
    const Place place = slab_.place();
    const long long first = N == 4 ? place.first_tet : place.first_triangle;
    on_all(comm_, [&] {
      for (std::size_t e = 0; e < elements.size(); ++e)
        for (const int v : elements[e])
          TUNICA_CHECK(v >= 0 && v < slab_.vertices,
                       path_ + ": " + kind + " element " +
                           std::to_string(first + static_cast<long long>(e) + 1) + " has point " +
                           std::to_string(v + 1LL) + ", but the file has " +
                           std::to_string(slab_.vertices) + " points");
    });
  }

  /// Replaces the tags of the file by places among those that any rank uses.
  std::vector<Tag> number(const std::map<int, std::string>& names, const std::string& kind,
                          std::vector<int>& tags) {
    std::vector<int> used = tags;
    sort_once(used);
    used = gather_rows(comm_, used);
    std::vector<Tag> all = number_tags(names, kind, used);
    broadcast(comm_, all);
    for (int& tag : tags)
      tag = static_cast<int>(
          std::lower_bound(all.begin(), all.end(), tag,
                           [](const Tag& a, int number) { return a.id < number; }) -
          all.begin());
    return all;
  }

  void orient() {
    const std::vector<int> used = vertices_of(mesh_.tets);
    const std::vector<Vec3> x = fetch(comm_, used, mesh_.vertices, slab_.vertices);
    const auto at = [&](int v) { return x[place_of(v, used)]; };
    const auto volume = [&](const std::array<int, 4>& v) {
      return signed_volume(at(v[0]), at(v[1]), at(v[2]), at(v[3]));
    };
    const bool are_mine_negative =
        std::all_of(mesh_.tets.begin(), mesh_.tets.end(),
                    [&](const std::array<int, 4>& tet) { return volume(tet) < 0.0; });
    if (all_agree(comm_, are_mine_negative))
      for (auto& tet : mesh_.tets) std::swap(tet[2], tet[3]);
    on_all(comm_, [&] {
      for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
        const double V = volume(mesh_.tets[t]);
        TUNICA_CHECK(V > 0.0, path_ + ": inverted element: element " +
                                  std::to_string(tet_number_[t]) + " of region \"" +
                                  mesh_.regions[mesh_.tet_region[t]].name + "\" at " +
                                  show(at(mesh_.tets[t][0])) + " has volume " + show(V) +
                                  ", expected a positive one");
      }
    });
    std::vector<long long>().swap(tet_number_);
  }

  /// Which of these faces, ascending, have one tetrahedron only: asked where the lowest vertex is.
  std::vector<char> are_on_boundary(const std::vector<Triple>& asked) const {
    // 1. To those who answer, who say of which vertices they need the faces.
    const Received<Triple> there = exchange(comm_, asked, counts_by_lowest(slab_, asked));
    std::vector<Triple> known = there.items;
    sort_once(known);
    std::vector<char> is_lowest(mesh_.vertices.size(), 0);
    for (const Triple& face : known) is_lowest[face[0] - slab_.place().first_vertex] = 1;
    // 2. Faces of tetrahedra to them.
    const std::vector<int> used = vertices_of(mesh_.tets);
    const std::vector<char> is_wanted = fetch(comm_, used, is_lowest, slab_.vertices);
    std::vector<Triple> sides;
    for (const auto& tet : mesh_.tets)
      for (const auto& f : tet_faces) {
        const Triple side = ascending({tet[f[0]], tet[f[1]], tet[f[2]]});
        if (is_wanted[place_of(side[0], used)] != 0) sides.push_back(side);
      }
    std::sort(sides.begin(), sides.end());
    std::vector<int> count(known.size(), 0);
    const auto place = [&](const Triple& face) {
      return static_cast<std::size_t>(std::lower_bound(known.begin(), known.end(), face) -
                                      known.begin());
    };
    for (const Triple& side : exchange(comm_, sides, counts_by_lowest(slab_, sides)).items) {
      const std::size_t k = place(side);
      if (k < known.size() && known[k] == side) ++count[k];
    }
    // 3. And back.
    std::vector<char> answers;
    for (const Triple& face : there.items) answers.push_back(count[place(face)] == 1);
    return exchange(comm_, answers, there.counts).items;
  }

  void drop_untagged_triangles() {
    std::vector<Triple> asked;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
      if (mesh_.triangle_surface[i] == 0) asked.push_back(ascending(mesh_.triangles[i]));
    if (global_sum(comm_, static_cast<long long>(asked.size())) == 0) return;
    sort_once(asked);
    const std::vector<char> is_boundary = are_on_boundary(asked);
    std::vector<Triple> kept;
    std::vector<int> tags;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      if (mesh_.triangle_surface[i] == 0) {
        const Triple face = ascending(mesh_.triangles[i]);
        if (is_boundary[std::lower_bound(asked.begin(), asked.end(), face) - asked.begin()] == 0)
          continue;
      }
      kept.push_back(mesh_.triangles[i]);
      tags.push_back(mesh_.triangle_surface[i]);
    }
    const auto mine = static_cast<long long>(kept.size());
    const long long first = sum_before(comm_, mine);
    slab_.triangles = global_sum(comm_, mine);
    mesh_.triangles = spread(comm_, kept, first, slab_.triangles);
    mesh_.triangle_surface = spread(comm_, tags, first, slab_.triangles);
  }

  void drop_unused_vertices() {
    const std::vector<int> of_tets = vertices_of(mesh_.tets);
    const std::vector<int> of_triangles = vertices_of(mesh_.triangles);
    std::vector<int> used;
    std::set_union(of_tets.begin(), of_tets.end(), of_triangles.begin(), of_triangles.end(),
                   std::back_inserter(used));
    std::vector<int> number(mesh_.vertices.size(), -1);
    const long long first_row = slab_.place().first_vertex;
    for (const int v : exchange(comm_, used, rows_by_rank(comm_, used, slab_.vertices)).items)
      number[v - first_row] = 0;
    const auto mine =
        static_cast<long long>(number.size()) - std::count(number.begin(), number.end(), -1);
    const long long total = global_sum(comm_, mine), first = sum_before(comm_, mine);
    if (total == slab_.vertices) return;
    std::vector<Vec3> kept;
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] < 0) continue;
      number[v] = static_cast<int>(first + static_cast<long long>(kept.size()));
      kept.push_back(mesh_.vertices[v]);
    }
    const std::vector<int> now = fetch(comm_, used, number, slab_.vertices);
    for (auto& tet : mesh_.tets)
      for (int& v : tet) v = now[place_of(v, used)];
    for (auto& triangle : mesh_.triangles)
      for (int& v : triangle) v = now[place_of(v, used)];
    mesh_.vertices = spread(comm_, kept, first, total);
    slab_.vertices = total;
  }

  const std::string& path_;
  const Comm& comm_;
  RowStream rows_;
  Slab slab_;
  Mesh& mesh_ = slab_.rows;
  std::vector<long long> tet_number_;  ///< in the file
};

}  // namespace

Slab read_text_mesh(const std::string& path, const CommPtr& comm, int rows_at_once) {
  return TextMesh(path, comm, rows_at_once).finish();
}

}  // namespace tunica::mesh
