#include "tunica/run/initial_state.hpp"

#include <algorithm>
#include <memory>
#include <optional>

#include "tunica/base/agreement.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/fields/tet_search.hpp"
#include "tunica/io/messages.hpp"
#include "tunica/output/stored_fields.hpp"

namespace tunica::run {

namespace {

/// Values of one grid of another run at any points.
class Interpolation {
public:
  Interpolation(const output::StoredFields& stored, const std::string& grid)
      : stored_(&stored), grid_(grid), mesh_(stored.mesh(grid)),
        search_(mesh_.x, mesh_.tets, mesh_.region) {}

  /// Places of the owned nodes of a mesh. by_region: each in the part of the grid that has the name
  /// of the node's region, where there is one.
  std::vector<fields::TetSearch::Spot> places(const fields::FieldMesh& mesh, bool by_region) const {
    std::vector<int> region(mesh.n_nodes(), -1);
    if (by_region)
      for (std::size_t e = 0; e < mesh.tets.size(); ++e)
        for (const int a : mesh.tets[e]) region[a] = region_named(mesh.regions[mesh.region[e]]);
    std::vector<fields::TetSearch::Spot> all;
    for (int a = 0; a < mesh.n_owned; ++a) all.push_back(search_.find(mesh.x[a], region[a]));
    return all;
  }

  /// Σ_a N_a(X) q_a of an array at these places, into the entries of x; false where the other run
  /// does not have it.
  bool interpolate(const std::string& array, int columns,
                   const std::vector<fields::TetSearch::Spot>& places, Vector& x) const {
    const std::vector<double> q = stored_->values(grid_, array, columns);
    if (q.empty()) return false;
    const auto view = x.getLocalViewHost(overwrite_all);
    for (std::size_t k = 0; k < places.size(); ++k)
      for (int i = 0; i < columns; ++i) {
        double sum = 0.0;
        for (int a = 0; a < 4; ++a)
          sum += places[k].weights[a] * q[columns * places[k].vertices[a] + i];
        view(columns * k + i, 0) = sum;
      }
    return true;
  }

private:
  int region_named(const std::string& name) const {
    const auto found = std::find(mesh_.regions.begin(), mesh_.regions.end(), name);
    if (found == mesh_.regions.end()) return -1;
    const int r = static_cast<int>(found - mesh_.regions.begin());
    const bool is_used = std::count(mesh_.region.begin(), mesh_.region.end(), r) > 0;
    return is_used ? r : -1;
  }

  const output::StoredFields* stored_;
  std::string grid_;
  output::StoredFields::Mesh mesh_;
  fields::TetSearch search_;
};

/// "12 of 904 nodes of the fluid lie outside, up to 0.031 mm". Collective.
std::string about_outside(const std::vector<fields::TetSearch::Spot>& places,
                          const std::string& field, const Comm& comm) {
  constexpr double round_off = 1e-9;  // mm
  double outside = 0.0, farthest = 0.0;
  for (const auto& place : places) {
    outside += place.distance > round_off ? 1.0 : 0.0;
    farthest = std::max(farthest, place.distance);
  }
  const auto sums = global_sum(comm, {outside, static_cast<double>(places.size())});
  farthest = global_max(comm, farthest);
  std::string text = field + ": ";
  text += sums[0] == 0.0 ? "no node lies outside of its mesh"
                         : formatted("%.0f of %.0f nodes lie outside of its mesh, up to %.2g mm",
                                     sums[0], sums[1], farthest);
  return text;
}

using Lines = std::vector<std::string>;

std::optional<Interpolation> of_grid(const output::StoredFields& stored, const std::string& grid,
                                     const Comm& comm) {
  std::optional<Interpolation> from;
  on_all(comm, [&] {
    if (stored.has(grid)) from.emplace(stored, grid);
  });
  return from;
}

// u, p of the fluid
void start_fluid(const output::StoredFields& stored, problems::FluidProblem& fluid, Lines& lines) {
  const auto from = of_grid(stored, "fluid", *fluid.mesh().comm);
  if (!from) return lines.push_back("fluid: that run has none; it begins at rest");
  const auto places = from->places(fluid.mesh(), false);
  algebra::BlockVector x(fluid.space());
  x.assign(fluid.state());
  from->interpolate("velocity", 3, places, x["velocity"]);
  from->interpolate("pressure", 1, places, x["pressure"]);
  fluid.start_from(x);
  lines.push_back(about_outside(places, "fluid", *fluid.mesh().comm));
}

// d, ḋ of the wall, and p, which jumps between its layers
void start_wall(const output::StoredFields& stored, problems::SolidProblem& wall, Lines& lines) {
  const auto from = of_grid(stored, "wall", *wall.mesh().comm);
  if (!from) return lines.push_back("wall: that run has none; it begins at rest");
  const auto places = from->places(wall.mesh(), false);
  algebra::BlockVector x(wall.space());
  x.assign(wall.state());
  Vector rate(x["displacement"].getMap());
  from->interpolate("displacement", 3, places, x["displacement"]);
  from->interpolate("velocity", 3, places, rate);
  from->interpolate("pressure", 1, from->places(wall.scalar_mesh(), true), x["pressure"]);
  wall.start_from(x, rate);
  lines.push_back(about_outside(places, "wall", *wall.mesh().comm));
}

}  // namespace

Outcome take_initial_state(const setup::InitialState& from, FieldProblems& problems) {
  const Comm& comm = *problems.domain->comm;
  std::optional<output::StoredFields> stored;
  on_all(comm, [&] { stored.emplace(from.folder, from.time); });
  Lines lines;
  if (problems.fluid) start_fluid(*stored, *problems.fluid, lines);
  if (problems.wall) start_wall(*stored, *problems.wall, lines);
  if (comm.getRank() == 0) {
    io::print_line("initial state: " + from.folder + formatted(" at %g ms", stored->time()));
    for (const std::string& line : lines) io::print_line("  " + line);
  }
  if (!problems.motion) return Outcome::success();
  const fields::InterfaceTransfer& interface = *problems.domain->interface;
  const Outcome moved = problems.motion->start_from(
      interface.to_fluid(interface.from_wall(problems.wall->displacement())));
  return moved.at("the initial state");
}

}  // namespace tunica::run
