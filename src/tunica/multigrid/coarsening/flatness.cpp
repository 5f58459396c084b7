#include "tunica/multigrid/coarsening/flatness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::multigrid {

// exp(Σ_a ln(h_max/h_min)_a / n) over the n nodes of solids that have neighbours
double flatness_of_solids(const CrsGraph& nodes, const algebra::NodePlaces& places) {
  if (places.coordinates.is_null()) return 1.0;
  MultiVector all(nodes.getColMap(), 3);
  all.doImport(*places.coordinates, Import(places.coordinates->getMap(), nodes.getColMap()),
               insert);
  const auto own = places.coordinates->getLocalViewHost(read_only);
  const auto x = all.getLocalViewHost(read_only);
  const auto in_solid = places.in_solid->getLocalViewHost(read_only);
  const auto graph = nodes.getLocalGraphHost();
  double logarithms = 0.0, n = 0.0;
  for (std::size_t a = 0; a < own.extent(0); ++a) {
    if (in_solid(a, 0) == 0.0) continue;
    double shortest = std::numeric_limits<double>::max(), longest = 0.0;
    for (auto k = graph.row_map(a); k < graph.row_map(a + 1); ++k) {
      double square = 0.0;
      for (int i = 0; i < 3; ++i) square += std::pow(x(graph.entries(k), i) - own(a, i), 2);
      if (square == 0.0) continue;
      shortest = std::min(shortest, square);
      longest = std::max(longest, square);
    }
    if (longest == 0.0) continue;
    // Squares of lengths, hence the half
    logarithms += 0.5 * std::log(longest / shortest);
    n += 1.0;
  }
  const auto& comm = *nodes.getComm();
  const double nodes_of_all = global_sum(comm, n);
  return nodes_of_all > 0.0 ? std::exp(global_sum(comm, logarithms) / nodes_of_all) : 1.0;
}

}  // namespace tunica::multigrid
