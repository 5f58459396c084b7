#include "tunica/mesh/faces.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "tunica/base/error.hpp"
#include "tunica/mesh/text.hpp"

namespace tunica::mesh {
namespace {

/// One side of a face: the tetrahedron there, and whether sorting its outward vertices took
/// an even permutation. The two sides of a face differ in that.
struct Side {
  std::array<int, 3> vertices;
  int tet;
  bool is_even;
};

Side make_side(std::array<int, 3> v, int tet) {
  bool is_even = true;
  const auto order = [&](int i, int j) {
    if (v[i] <= v[j]) return;
    std::swap(v[i], v[j]);
    is_even = !is_even;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return {v, tet, is_even};
}

constexpr std::size_t sides_at_once = std::size_t{1} << 20;

/// Joins the sides of a face, of which two are right and come one after the other.
class FaceBuilder {
public:
  FaceBuilder(const Excerpt& part, const std::string& name,
              const std::function<void(const Face&)>& visit)
      : part_(part), name_(name), visit_(visit) {}

  void add(const Side& side) {
    if (!is_begun_ || face_.vertices != side.vertices) {
      finish();
      is_begun_ = true;
      face_ = {side.vertices, {side.tet, -1}};
      is_even_ = side.is_even;
      return;
    }
    const auto where = [&] { return " at " + show(centre(part_.mesh, face_.vertices)); };
    TUNICA_CHECK(face_.is_boundary(), name_ + ": the face" + where() + " belongs to tetrahedra " +
                                          part_.tet(face_.tets[0]) + ", " +
                                          part_.tet(face_.tets[1]) + " and " + part_.tet(side.tet) +
                                          ", expected at most two. Remove duplicate elements.");
    TUNICA_CHECK(is_even_ != side.is_even,
                 name_ + ": tetrahedra " + part_.tet(face_.tets[0]) + " and " +
                     part_.tet(side.tet) + " lie on the same side of their common face" + where() +
                     ". The mesh overlaps itself; make it anew.");
    face_.tets[1] = side.tet;
  }

  void finish() {
    if (is_begun_) visit_(face_);
    is_begun_ = false;
  }

private:
  const Excerpt& part_;
  const std::string& name_;
  const std::function<void(const Face&)>& visit_;
  bool is_begun_ = false, is_even_ = false;
  Face face_{};
};

/// work(side) for all sides of which the part has the lowest vertex, in the order of tetrahedra.
template <class Work>
void for_sides(const Excerpt& part, const Work& work) {
  const auto& tets = part.mesh.tets;
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (const auto& f : tet_faces) {
      const Side side =
          make_side({tets[t][f[0]], tets[t][f[1]], tets[t][f[2]]}, static_cast<int>(t));
      if (part.has(side.vertices[0])) work(side);
    }
}

/// By vertex: the sides of which it is the lowest.
std::vector<int> count_sides(const Excerpt& part) {
  std::vector<int> counts(part.mesh.vertices.size(), 0);
  for_sides(part, [&](const Side& side) { ++counts[side.vertices[0]]; });
  return counts;
}

/// Up to which lowest vertices the sides of faces are taken at a time.
std::vector<int> portions(const std::vector<int>& counts) {
  std::vector<int> ends;
  std::size_t taken = 0;
  for (std::size_t v = 0; v < counts.size(); ++v) {
    taken += static_cast<std::size_t>(counts[v]);
    if (taken < sides_at_once) continue;
    ends.push_back(static_cast<int>(v) + 1);
    taken = 0;
  }
  ends.push_back(static_cast<int>(counts.size()));
  return ends;
}

/// The sides of a range of lowest vertices, sorted by vertices and tetrahedra: each into the bucket
/// of its lowest vertex, of which none is large.
void find_sides(const Excerpt& part, const std::vector<int>& counts, int first, int end,
                std::vector<Side>& sides) {
  std::vector<int> next(end - first + 1, 0);
  std::partial_sum(counts.begin() + first, counts.begin() + end, next.begin() + 1);
  sides.resize(next.back());
  for_sides(part, [&](const Side& side) {
    const int lowest = side.vertices[0];
    if (lowest >= first && lowest < end) sides[next[lowest - first]++] = side;
  });
  // Now next[i] is where bucket i ends.
  auto begin = sides.begin();
  for (int i = 0; i < end - first; ++i) {
    const auto last = sides.begin() + next[i];
    std::sort(begin, last, [](const Side& a, const Side& b) {
      return std::tie(a.vertices, a.tet) < std::tie(b.vertices, b.tet);
    });
    begin = last;
  }
}

}  // namespace

void for_each_face(const Excerpt& part, const std::string& name,
                   const std::function<void(const Face&)>& visit) {
  const std::vector<int> counts = count_sides(part);
  std::vector<Side> sides;
  int first = 0;
  for (const int end : portions(counts)) {
    find_sides(part, counts, first, end, sides);
    FaceBuilder builder(part, name, visit);
    for (const Side& side : sides) builder.add(side);
    builder.finish();
    first = end;
  }
}

std::vector<Face> faces(const Mesh& mesh, const std::string& name) {
  std::vector<Face> result;
  result.reserve(2 * mesh.tets.size() + mesh.triangles.size());
  for_each_face(Excerpt(mesh), name, [&result](const Face& face) { result.push_back(face); });
  return result;
}

const Face* find_face(const std::vector<Face>& sorted_faces, std::array<int, 3> vertices) {
  std::sort(vertices.begin(), vertices.end());
  const auto found =
      std::lower_bound(sorted_faces.begin(), sorted_faces.end(), vertices,
                       [](const Face& f, const std::array<int, 3>& v) { return f.vertices < v; });
  return found != sorted_faces.end() && found->vertices == vertices ? &*found : nullptr;
}

std::array<Vec3, 4> corners(const Mesh& mesh, int t) {
  const auto& tet = mesh.tets[t];
  return {mesh.vertices[tet[0]], mesh.vertices[tet[1]], mesh.vertices[tet[2]],
          mesh.vertices[tet[3]]};
}

double volume(const Mesh& mesh, int t) {
  const auto x = corners(mesh, t);
  return signed_volume(x[0], x[1], x[2], x[3]);
}

Vec3 centre(const Mesh& mesh, const std::array<int, 3>& triangle) {
  return (1.0 / 3.0) *
         (mesh.vertices[triangle[0]] + mesh.vertices[triangle[1]] + mesh.vertices[triangle[2]]);
}

double area(const Mesh& mesh, const std::array<int, 3>& triangle) {
  const Vec3& a = mesh.vertices[triangle[0]];
  return 0.5 * norm(cross(mesh.vertices[triangle[1]] - a, mesh.vertices[triangle[2]] - a));
}

}  // namespace tunica::mesh
