#include "tunica/problems/following_surfaces.hpp"

#include <algorithm>

#include "tunica/base/reduce.hpp"

namespace tunica::problems {

using discretisation::Extent;

namespace {

int n_surfaces(const fields::FieldMesh& mesh, int node) {
  return mesh.node_surfaces.end(node) - mesh.node_surfaces.begin(node);
}

/// Surfaces that have an edge: what has none, as a sphere around all, hangs on nothing.
std::vector<char> with_edges(const fields::FieldMesh& mesh) {
  std::vector<double> found(mesh.surfaces.size(), 0.0);
  for (int a = 0; a < mesh.n_owned; ++a)
    if (n_surfaces(mesh, a) > 1)
      for (int k = mesh.node_surfaces.begin(a); k < mesh.node_surfaces.end(a); ++k)
        found[mesh.node_surfaces.surface(k)] = 1.0;
  std::vector<char> has_edge;
  for (const double sum : global_sum(*mesh.comm, found)) has_edge.push_back(sum > 0.0);
  return has_edge;
}

}  // namespace

FollowingSurfaces::FollowingSurfaces(const Teuchos::ParameterList& solver,
                                     const fields::FieldMesh& mesh,
                                     const std::vector<int>& interface,
                                     const std::vector<int>& at_rest)
    : solver_(solver), mesh_(&mesh), on_surface_(mesh.n_nodes(), 0), on_line_(mesh.n_nodes(), 0) {
  std::vector<char> follows = with_edges(mesh);
  for (const int s : at_rest) follows[s] = 0;
  for (int a = 0; a < mesh.n_nodes(); ++a) {
    const int count = n_surfaces(mesh, a);
    const bool is_on_interface = mesh.is_on_any(a, interface);
    if (is_on_interface && count > 1 && a < mesh.n_owned) rim_.push_back(a);
    bool all_follow = !is_on_interface;
    for (int k = mesh.node_surfaces.begin(a); k < mesh.node_surfaces.end(a); ++k)
      all_follow = all_follow && follows[mesh.node_surfaces.surface(k)];
    on_surface_[a] = all_follow && count == 1;
    on_line_[a] = all_follow && count == 2;
  }
}

// A clamped wall keeps still as well as iterative solvers keep its rows.
bool FollowingSurfaces::moves_rim(const MultiVector& values) const {
  constexpr double still = 1e-12;
  const auto view = values.getLocalViewHost(read_only);
  const auto squares = [&](int a) {
    double sum = 0.0;
    for (std::size_t i = 0; i < view.extent(1); ++i) sum += view(a, i) * view(a, i);
    return sum;
  };
  std::vector<double> sums{0.0, 0.0};  // of the rim, of all
  for (const int a : rim_) sums[0] += squares(a);
  for (int a = 0; a < mesh_->n_owned; ++a) sums[1] += squares(a);
  sums = global_sum(*mesh_->comm, sums);
  return sums[0] > still * still * sums[1];
}

std::vector<char> FollowingSurfaces::is_given(Extent extent) const {
  std::vector<char> given;
  for (const char is_free : extent == Extent::lines ? on_line_ : on_surface_)
    given.push_back(is_free ? 0 : 1);
  return given;
}

const FollowingSurfaces::Stages& FollowingSurfaces::stages() const {
  if (stages_.empty())
    for (const Extent extent : {Extent::lines, Extent::surfaces})
      stages_.push_back(std::make_unique<Stage>(solver_, *mesh_, is_given(extent), extent));
  return stages_;
}

Outcome FollowingSurfaces::extend(MultiVector& values, std::optional<double> tolerance) {
  if (!moves_rim(values)) {
    for (const auto& stage : stages_) stage->problem.start_from(values);  // zero there
    return Outcome::success();
  }
  for (const auto& stage : stages())
    if (const Outcome outcome = stage->problem.extend(values, tolerance); outcome.is_failure())
      return outcome;
  return Outcome::success();
}

void FollowingSurfaces::extend_roughly(double tolerance, MultiVector& values) const {
  if (!moves_rim(values)) return;
  for (const auto& stage : stages()) stage->problem.extend_roughly(tolerance, values);
}

void FollowingSurfaces::start_from(const MultiVector& values) {
  if (!moves_rim(values)) return;
  for (const auto& stage : stages()) stage->problem.start_from(values);
}

}  // namespace tunica::problems
