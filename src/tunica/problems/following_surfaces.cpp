#include "tunica/problems/following_surfaces.hpp"

#include <algorithm>

#include "tunica/base/reduce.hpp"

namespace tunica::problems {

using discretisation::Edges;
using discretisation::Extent;

namespace {

Edges edges_of_faces(const fields::FieldMesh& mesh) {
  Edges edges;
  for (const fields::Face& face : mesh.faces)
    for (int k = 0; k < 3; ++k) edges.insert(discretisation::edge_of(face, k));
  return edges;
}

/// Flags of the nodes that edges lead to from flagged ones, on any ranks. Collective.
std::vector<char> reached(const fields::FieldMesh& mesh, std::vector<char> flags,
                          const Edges& edges) {
  // The rank's own edges until nothing changes, then the owners' flags to ghosts, until no rank
  // finds more.
  for (bool changes = true; changes;) {
    bool found = false;
    for (bool again = true; again;) {
      again = false;
      for (const auto& [a, b] : edges)
        if (flags[a] != flags[b]) flags[a] = flags[b] = again = found = true;
    }
    Vector owned(mesh.node_map);
    {
      const auto view = owned.getLocalViewHost(overwrite_all);
      for (int a = 0; a < mesh.n_owned; ++a) view(a, 0) = flags[a];
    }
    const std::vector<double> all = fields::ghosted_scalars(mesh, owned);
    for (int a = 0; a < mesh.n_nodes(); ++a) {
      found = found || flags[a] != static_cast<char>(all[a]);
      flags[a] = static_cast<char>(all[a]);
    }
    changes = !all_agree(*mesh.comm, !found);
  }
  return flags;
}

/// All but the nodes that are free and hang on others: the rest of the system would be singular.
std::vector<char> given_nodes(const fields::FieldMesh& mesh, const std::vector<char>& is_free,
                              const Edges& edges) {
  std::vector<char> is_given;
  for (const char free : is_free) is_given.push_back(!free);
  // What no edge ties to a given node stays where it is, at zero.
  const std::vector<char> hangs = reached(mesh, is_given, edges);
  for (std::size_t a = 0; a < hangs.size(); ++a) is_given[a] = is_given[a] || !hangs[a];
  return is_given;
}

}  // namespace

// A node on one surface, which follows, is free in it; on two that do, along their line. One that
// is on a third surface, on one that stays or on the interface is given.
FollowingSurfaces::FollowingSurfaces(MeshMotionSettings settings, const fields::FieldMesh& mesh,
                                     const std::vector<int>& interface,
                                     const std::vector<int>& staying)
    : settings_(std::move(settings)), mesh_(&mesh), on_surface_(mesh.n_nodes(), 0),
      on_line_(mesh.n_nodes(), 0) {
  std::vector<char> follows(mesh.surfaces.size(), 1);
  for (const std::vector<int>* others : {&interface, &staying})
    for (const int s : *others) follows[s] = 0;
  for (int a = 0; a < mesh.n_nodes(); ++a) {
    int count = 0, following = 0;
    for (int k = mesh.node_surfaces.begin(a); k < mesh.node_surfaces.end(a); ++k) {
      ++count;
      following += follows[mesh.node_surfaces.surface(k)];
    }
    on_surface_[a] = count == 1 && following == 1;
    on_line_[a] = count == 2 && following == 2;
    if (a >= mesh.n_owned || !mesh.is_on_any(a, interface)) continue;
    interface_.push_back(a);
    if (following > 0) rim_.push_back(a);
  }
}

// A clamped wall keeps still as well as iterative solvers keep its rows.
bool FollowingSurfaces::moves_rim(const MultiVector& values) const {
  constexpr double still = 1e-12;
  const auto view = values.getLocalViewHost(read_only);
  const auto squares = [&](const std::vector<int>& nodes) {
    double sum = 0.0;
    for (const int a : nodes)
      for (std::size_t i = 0; i < view.extent(1); ++i) sum += view(a, i) * view(a, i);
    return sum;
  };
  const auto sums =
      global_sum(*mesh_->comm, std::vector<double>{squares(rim_), squares(interface_)});
  // |d|_rim > 10⁻¹² |d|_interface
  return sums[0] > still * still * sums[1];
}

// −(γ d')' = 0 along lines with their ends given, then the law in surfaces with their edges given
FollowingSurfaces::Stages& FollowingSurfaces::stages() {
  if (!stages_.empty()) return stages_;
  const std::vector<char> on_lines =
      given_nodes(*mesh_, on_line_, discretisation::edges_of_lines(*mesh_));
  const std::vector<char> on_surfaces = given_nodes(*mesh_, on_surface_, edges_of_faces(*mesh_));
  Stages both;
  both.emplace_back(settings_, *mesh_, on_lines, Extent::lines);
  both.emplace_back(settings_, *mesh_, on_surfaces, Extent::surfaces);
  stages_ = std::move(both);
  return stages_;
}

// Lines first, which are edges of the surfaces.
Outcome FollowingSurfaces::extend(MultiVector& values, const ExtensionAccuracy& accuracy) {
  if (!moves_rim(values)) {
    for (auto& stage : stages_) stage.problem().start_from(values);  // zero there
    return Outcome::success();
  }
  for (auto& stage : stages())
    if (const Outcome outcome = stage.problem().extend(values, accuracy); outcome.is_failure())
      return outcome;
  return Outcome::success();
}

void FollowingSurfaces::extend_roughly(double tolerance, MultiVector& values) {
  if (!moves_rim(values)) return;
  for (auto& stage : stages()) stage.problem().extend_roughly(tolerance, values);
}

// The start of iterative solvers is that of a run which has not been interrupted.
void FollowingSurfaces::start_from(const MultiVector& values) {
  if (moves_rim(values)) stages();
  for (auto& stage : stages_) stage.problem().start_from(values);
}

}  // namespace tunica::problems
