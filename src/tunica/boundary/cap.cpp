#include "tunica/boundary/cap.hpp"

#include <Teuchos_DefaultSerialComm.hpp>
#include <map>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/laplace_p1.hpp"
#include "tunica/kernels/surface_tri3.hpp"
#include "tunica/linear/direct/direct_factor.hpp"

namespace tunica::boundary {

namespace {

// A triangle as it travels: per corner its vertex, its position, and whether it is on the rim.
constexpr int corner_size = 5, triangle_size = 3 * corner_size;

std::vector<double> packed_faces(const fields::FieldMesh& mesh, int surface,
                                 const std::vector<int>& planes) {
  const fields::NodeSurfaces& on = mesh.node_surfaces;
  const auto ends_at = [&](int a) {
    for (int k = on.begin(a); k < on.end(a); ++k)
      if (on.surface(k) != surface &&
          std::find(planes.begin(), planes.end(), on.surface(k)) == planes.end())
        return true;
    return false;
  };
  std::vector<double> packed;
  for (const fields::Face& face : mesh.faces) {
    if (face.surface != surface || !face.is_owned) continue;
    for (const int a : face.nodes) {
      packed.push_back(mesh.vertex[a]);
      packed.insert(packed.end(), mesh.x[a].begin(), mesh.x[a].end());
      packed.push_back(ends_at(a) ? 1.0 : 0.0);
    }
  }
  return packed;
}

/// All ranks' numbers, one after the other.
std::vector<double> all_of(const Comm& comm, const std::vector<double>& mine) {
  const auto count = static_cast<long long>(mine.size());
  std::vector<double> parts(global_sum(comm, count), 0.0);
  std::copy(mine.begin(), mine.end(), parts.begin() + sum_before(comm, count));
  return global_sum(comm, parts);
}

std::array<Vec3, 3> corners(const Cap& cap, const std::array<int, 3>& t) {
  return assembly::gather(cap.x, t);
}

double area(const Cap& cap, const std::array<int, 3>& t) {
  return norm(kernels::area_normal(corners(cap, t)));
}

/// The nodes within the rim, numbered; -1 on it.
std::vector<int> unknowns_of(const Cap& cap, int& count) {
  std::vector<int> number(cap.vertex.size(), -1);
  count = 0;
  for (int a = 0; a < cap.n_nodes(); ++a)
    if (!cap.is_rim[a]) number[a] = count++;
  TUNICA_CHECK(count > 0,
               "a flow rate needs vertices of the surface within its rim, but all of "
               "them lie on it. Refine the mesh there.");
  return number;
}

/// ∫ ∇N_a·∇N_b and ∫ N_a N_b on a triangle.
struct Element {
  std::array<std::array<double, 3>, 3> L;
  double M[3][3];

  explicit Element(const std::array<Vec3, 3>& x) : L(kernels::laplace_p1(x)) {
    const double A = norm(kernels::area_normal(x));
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) M[a][b] = A / 12.0 * (a == b ? 2.0 : 1.0);
  }
};

// (re, im) of each node:  [ν L  −ω M] [φ_r]   [M 1]
//                         [ω M   ν L] [φ_i] = [ 0 ]
ComplexProfile solve(const Cap& cap, double omega, double nu) {
  int n = 0;
  const std::vector<int> number = unknowns_of(cap, n);
  const CommPtr alone = Teuchos::rcp(new Teuchos::SerialComm<int>);
  const Teuchos::RCP<const Map> map = Teuchos::rcp(new Map(2 * n, 0, alone));
  std::map<std::pair<int, int>, double> entries;
  MultiVector b(map, 1), phi(map, 1);
  for (const auto& t : cap.triangles) {
    const Element element(corners(cap, t));
    for (int a = 0; a < 3; ++a) {
      const int row = number[t[a]];
      if (row < 0) continue;
      for (int c = 0; c < 3; ++c) {
        b.sumIntoLocalValue(2 * row, 0, element.M[a][c]);
        const int column = number[t[c]];
        if (column < 0) continue;
        entries[{2 * row, 2 * column}] += nu * element.L[a][c];
        entries[{2 * row, 2 * column + 1}] -= omega * element.M[a][c];
        entries[{2 * row + 1, 2 * column}] += omega * element.M[a][c];
        entries[{2 * row + 1, 2 * column + 1}] += nu * element.L[a][c];
      }
    }
  }
  std::vector<std::size_t> lengths(2 * n, 0);
  for (const auto& [place, value] : entries) ++lengths[place.first];
  const auto K = Teuchos::rcp(new CrsMatrix(map, Teuchos::ArrayView<const std::size_t>(lengths)));
  for (const auto& [place, value] : entries)
    K->insertGlobalValues(place.first, Teuchos::tuple<GlobalOrdinal>(place.second),
                          Teuchos::tuple(value));
  K->fillComplete();
  linear::DirectFactor factor(K);
  factor.refresh();
  factor.apply(b, phi);
  ComplexProfile all(cap.vertex.size());
  const auto values = phi.getLocalViewHost(read_only);
  for (int a = 0; a < cap.n_nodes(); ++a)
    if (number[a] >= 0) all[a] = {values(2 * number[a], 0), values(2 * number[a] + 1, 0)};
  return all;
}

/// Divides by the integral.
template <class Number>
std::vector<Number> normalised(const Cap& cap, std::vector<Number> f) {
  Number total = 0.0;
  for (const auto& t : cap.triangles) total += area(cap, t) / 3.0 * (f[t[0]] + f[t[1]] + f[t[2]]);
  for (Number& value : f) value /= total;
  return f;
}

}  // namespace

int Cap::find(int vertex_number) const {
  const auto found = std::lower_bound(vertex.begin(), vertex.end(), vertex_number);
  return found != vertex.end() && *found == vertex_number ? static_cast<int>(found - vertex.begin())
                                                          : -1;
}

Cap gather_cap(const fields::FieldMesh& mesh, int surface, const std::vector<int>& planes) {
  const std::vector<double> all = all_of(*mesh.comm, packed_faces(mesh, surface, planes));
  Cap cap;
  std::map<int, std::size_t> corner_of;  // of a vertex: one of its places in all
  for (std::size_t k = 0; k < all.size(); k += corner_size)
    corner_of.emplace(static_cast<int>(all[k]), k);
  for (const auto& [vertex, k] : corner_of) {
    cap.vertex.push_back(vertex);
    cap.x.push_back({all[k + 1], all[k + 2], all[k + 3]});
    cap.is_rim.push_back(all[k + 4] != 0.0);
  }
  for (std::size_t k = 0; k < all.size(); k += triangle_size) {
    std::array<int, 3> t;
    for (int a = 0; a < 3; ++a) t[a] = cap.find(static_cast<int>(all[k + corner_size * a]));
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    cap.triangles.push_back(t);
  }
  std::sort(cap.triangles.begin(), cap.triangles.end());
  return cap;
}

double integral(const Cap& cap, const std::vector<double>& f) {
  double sum = 0.0;
  for (const auto& t : cap.triangles) sum += area(cap, t) / 3.0 * (f[t[0]] + f[t[1]] + f[t[2]]);
  return sum;
}

Profile flat_profile(const Cap& cap) {
  int count = 0;
  unknowns_of(cap, count);
  Profile one;
  for (const char is_rim : cap.is_rim) one.push_back(is_rim ? 0.0 : 1.0);
  return normalised(cap, one);
}

Profile harmonic_profile(const Cap& cap) {
  const ComplexProfile phi = solve(cap, 0.0, 1.0);
  Profile real;
  for (const auto& value : phi) real.push_back(value.real());
  return normalised(cap, real);
}

ComplexProfile womersley_profile(const Cap& cap, double omega, double nu) {
  return normalised(cap, solve(cap, omega, nu));
}

}  // namespace tunica::boundary
