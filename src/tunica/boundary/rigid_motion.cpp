#include "tunica/boundary/rigid_motion.hpp"

#include <Teuchos_LAPACK.hpp>
#include <algorithm>
#include <cmath>

#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"

namespace tunica::boundary {

namespace {

using Vec6 = std::array<double, 6>;

/// The eigenvectors of a symmetric n × n matrix whose eigenvalues are at most so large, or at
/// least.
std::vector<std::vector<double>> eigenvectors(std::vector<double> A, int n, double low,
                                              double high) {
  if (n == 0) return {};
  std::vector<double> values(n), work(8 * n);
  int info = 0;
  Teuchos::LAPACK<int, double>().SYEV('V', 'U', n, A.data(), n, values.data(), work.data(),
                                      static_cast<int>(work.size()), &info);
  std::vector<std::vector<double>> found;
  for (int k = 0; k < n; ++k)
    if (values[k] >= low && values[k] <= high)
      found.emplace_back(A.begin() + n * k, A.begin() + n * (k + 1));
  return found;
}

/// The six motions at a point.
class Motions {
public:
  explicit Motions(const fields::FieldMesh& mesh) {
    std::vector<double> sums(4, 0.0);
    for (int a = 0; a < mesh.n_owned; ++a) {
      for (int i = 0; i < 3; ++i) sums[i] += mesh.x[a][i];
      sums[3] += 1.0;
    }
    sums = global_sum(*mesh.comm, sums);
    middle_ = 1.0 / sums[3] * Vec3{sums[0], sums[1], sums[2]};
    double squares = 0.0;
    for (int a = 0; a < mesh.n_owned; ++a) {
      const Vec3 r = mesh.x[a] - middle_;
      squares += dot(r, r);
    }
    size_ = std::sqrt(global_sum(*mesh.comm, squares) / sums[3]);
  }
  /// Their components along v at x.
  Vec6 along(const Vec3& v, const Vec3& x) const {
    const Vec3 moment = 1.0 / size_ * cross(x - middle_, v);  // v·(e × r) = e·(r × v)
    return {v[0], v[1], v[2], moment[0], moment[1], moment[2]};
  }

private:
  Vec3 middle_{};
  double size_ = 1.0;
};

/// Σ m mᵀ of the calling rank, by columns.
class Gram {
public:
  void add(const Vec6& m) {
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) sums_[6 * i + j] += m[i] * m[j];
  }
  std::vector<double> total(const Comm& comm) const { return global_sum(comm, sums_); }

private:
  std::vector<double> sums_ = std::vector<double>(36, 0.0);
};

void add_prescribed(const assembly::Constraints& fixed, const fields::FieldMesh& mesh,
                    const Motions& motions, Gram& M) {
  for (int a = 0; a < mesh.n_owned; ++a)
    for (int i = 0; i < 3; ++i) {
      Vec3 e{};
      e[i] = 1.0;
      const Vec3 held = e - fixed.project(a, e);  // a row of I − P
      if (norm(held) > 0.0) M.add(motions.along(held, mesh.x[a]));
    }
}

// What moves as one does so where its value is given, or else differs nowhere from its mean.
void add_common(const SurfaceTerms& terms, const fields::FieldMesh& mesh, const Motions& motions,
                Gram& M) {
  for (const auto& [surface, motion] : terms.common_motions()) {
    Vec3 e{};
    e[motion.component] = 1.0;
    std::vector<double> mean(7, 0.0);
    for (int a = 0; a < mesh.n_owned; ++a) {
      if (!mesh.is_on(a, surface)) continue;
      const Vec6 m = motions.along(e, mesh.x[a]);
      for (int i = 0; i < 6; ++i) mean[i] += m[i];
      mean[6] += 1.0;
    }
    mean = global_sum(*mesh.comm, mean);
    for (int a = 0; a < mesh.n_owned; ++a) {
      if (!mesh.is_on(a, surface)) continue;
      Vec6 m = motions.along(e, mesh.x[a]);
      for (int i = 0; i < 6; ++i) m[i] -= motion.has_force ? mean[i] / mean[6] : 0.0;
      M.add(m);
    }
  }
}

void add_springs(const SurfaceTerms& terms, const fields::FieldMesh& mesh, const Motions& motions,
                 Gram& M) {
  for (const fields::Face& face : mesh.faces)
    if (face.is_owned)
      for (const Vec3& v : terms.sprung_directions(mesh, face))
        for (const int a : face.nodes) M.add(motions.along(v, mesh.x[a]));
}

/// A subspace of directions by its axes where it has as many as its dimension, else by vectors.
std::string directions(const std::vector<std::vector<double>>& basis) {
  std::vector<std::string> axes, vectors;
  for (int i = 0; i < 3; ++i) {
    double part = 0.0;
    for (const auto& v : basis) part += v[i] * v[i];
    if (part > 1.0 - 1e-6) axes.emplace_back(1, "xyz"[i]);
  }
  for (const auto& v : basis) vectors.push_back(formatted("(%.2g, %.2g, %.2g)", v[0], v[1], v[2]));
  return listed(axes.size() == basis.size() ? axes : vectors);
}

constexpr double round_off = 1e-8;

/// Directions that the translations, or rotations, among motions have. first: 0 or 3.
std::vector<std::vector<double>> span(const std::vector<std::vector<double>>& motions, int first) {
  std::vector<double> A(9, 0.0);
  for (const auto& m : motions)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) A[3 * i + j] += m[first + i] * m[first + j];
  return eigenvectors(A, 3, round_off, 1e300);
}

/// Those of the motions, and sums of them, that do not turn.
std::vector<std::vector<double>> translations(const std::vector<std::vector<double>>& motions) {
  const int n = static_cast<int>(motions.size());
  std::vector<double> A(n * n, 0.0);
  for (int k = 0; k < n; ++k)
    for (int l = 0; l < n; ++l)
      for (int i = 3; i < 6; ++i) A[n * k + l] += motions[k][i] * motions[l][i];
  std::vector<std::vector<double>> found;
  for (const auto& weights : eigenvectors(A, n, -1e300, round_off)) {
    found.emplace_back(6, 0.0);
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < 6; ++i) found.back()[i] += weights[k] * motions[k][i];
  }
  return found;
}

}  // namespace

std::string free_rigid_motions(const SurfaceTerms& terms, const fields::FieldMesh& mesh) {
  const Motions motions(mesh);
  Gram M;
  add_prescribed(terms.constraints(), mesh, motions, M);
  add_common(terms, mesh, motions, M);
  add_springs(terms, mesh, motions, M);
  const std::vector<double> total = M.total(*mesh.comm);
  double trace = 0.0;
  for (int i = 0; i < 6; ++i) trace += total[7 * i];
  const auto free = eigenvectors(total, 6, -1e300, round_off * std::max(trace, 1e-300));
  const auto sliding = span(translations(free), 0), turning = span(free, 3);
  std::string text;
  if (!sliding.empty()) text = "sliding in " + directions(sliding);
  if (!turning.empty())
    text += (text.empty() ? "turning about " : ", and turning about ") + directions(turning);
  return text;
}

}  // namespace tunica::boundary
