#include "tunica/multigrid/coarsening/nodal_coarsening.hpp"

#include <TpetraExt_MatrixMatrix.hpp>

#include "tunica/algebra/independent_set.hpp"
#include "tunica/algebra/picked_matrix.hpp"
#include "tunica/algebra/products/sparse_product.hpp"
#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/multigrid/coarsening/flatness.hpp"

namespace tunica::multigrid {

namespace {

constexpr double no_number = -1.0;
constexpr double much_less = 0.6;

/// Middles of edges have fewer neighbours than corners. Picked first, of quadratic elements in a
/// plane a quarter of the nodes stays, as evenly as of linear ones, where other orders leave a
/// tenth to a fifth: Braess–Sarazin iterations of a flow at Re 40 become 23 in place of 49, of one
/// through obstacles 19 in place of 26, of a porous solid 30 in place of 63, each in less time. In
/// space as many iterations take longer by a third, and where sets are equally large other orders
/// are more even.
constexpr double much_more = 1.1;

/// Part of the nodes that may stay in the next level. Of grids of faces, with five or seven points
/// to a row, half do, and a level has more entries than the finer one: there no two that stay are
/// neighbours of one node. MAC's Stokes flow in space then takes 13 iterations in place of 10, and
/// 5.4 in place of 9.0 s with the set-up. Of quadratic elements 0.4 stay, and 14 iterations become
/// 26 in the same time.
constexpr double most_staying = 0.45;

/// flatness_of_solids up to which elements count as regular.
constexpr double still_regular = 5.0;

/// Of hosts on the level of the nodes and on the next one. Without: none.
struct Hosts {
  Teuchos::RCP<const Vector> here, coarse;  ///< -1 where there is none
  GlobalOrdinal n_coarse = 0;               ///< of all ranks
};

/// Numbers the nodes of the set rank by rank; the number at a ghost is that of its owner, and
/// -1 outside the set.
struct CoarseNumbers {
  Teuchos::RCP<const Map> map;
  Teuchos::RCP<Vector> of_row;
  std::vector<int> rows;  ///< local, of the nodes in the set
  std::vector<GlobalOrdinal> of_column;

  CoarseNumbers(const CrsGraph& nodes, const std::vector<char>& is_coarse, const Hosts& hosts)
      : of_row(Teuchos::rcp(new Vector(nodes.getRowMap()))) {
    const Map& own_nodes = *nodes.getRowMap();
    for (int i = 0; i < static_cast<int>(n_local(own_nodes)); ++i)
      if (is_coarse[nodes.getColMap()->getLocalElement(own_nodes.getGlobalElement(i))])
        rows.push_back(i);
    // The set has flags at ghosts, too; their numbers come from the owners.
    of_row->putScalar(no_number);
    number(own_nodes, hosts);
    const Vector all = algebra::on_columns(nodes, *of_row);
    const auto view = all.getLocalViewHost(read_only);
    of_column.resize(view.extent(0));
    for (std::size_t c = 0; c < of_column.size(); ++c)
      of_column[c] = static_cast<GlobalOrdinal>(view(c, 0));
  }

private:
  // A node with the number of its host takes the number that the host has on the next level; all
  // others are numbered rank by rank, behind the n_coarse hosts.
  void number(const Map& own_nodes, const Hosts& hosts) {
    std::vector<GlobalOrdinal> numbers(rows.size(), -1);
    std::size_t n_new = rows.size();
    if (!hosts.here.is_null()) {
      const auto here = hosts.here->getLocalViewHost(read_only);
      const auto coarse = hosts.coarse->getLocalViewHost(read_only);
      for (std::size_t c = 0; c < rows.size(); ++c)
        if (static_cast<GlobalOrdinal>(here(rows[c], 0)) == own_nodes.getGlobalElement(rows[c]) &&
            coarse(rows[c], 0) != no_number) {
          numbers[c] = static_cast<GlobalOrdinal>(coarse(rows[c], 0));
          --n_new;
        }
    }
    const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
    const Map fresh(unknown, n_new, 0, own_nodes.getComm());
    int next = 0;
    for (GlobalOrdinal& number : numbers)
      if (number < 0) number = hosts.n_coarse + fresh.getGlobalElement(next++);
    map = Teuchos::rcp(new Map(fresh));
    if (!hosts.here.is_null()) map = map_of(numbers, own_nodes.getComm());
    const auto view = of_row->getLocalViewHost(read_write);
    for (std::size_t c = 0; c < rows.size(); ++c)
      view(rows[c], 0) = static_cast<double>(numbers[c]);
  }
};

/// The order with those nodes first that have another value than this.
Vector first_without(double value, const Vector& values, const Vector& order) {
  Vector result(order, Teuchos::Copy);
  // A shift beyond the range of the order puts a node before all others and keeps their order.
  const double beyond = 1.0 + 2.0 * order.normInf();
  const auto at_node = values.getLocalViewHost(read_only);
  const auto view = result.getLocalViewHost(read_write);
  for (std::size_t i = 0; i < view.extent(0); ++i)
    if (at_node(i, 0) != value) view(i, 0) -= beyond;
  return result;
}

/// The order by numbers of neighbours: those with most first for a sign of -1, with fewest for 1.
Vector by_neighbours(double sign, const CrsGraph& nodes, const Vector& order) {
  Vector result(order, Teuchos::Copy);
  const double beyond = sign * (1.0 + 2.0 * order.normInf());
  const auto view = result.getLocalViewHost(read_write);
  for (std::size_t i = 0; i < view.extent(0); ++i)
    view(i, 0) += beyond * static_cast<double>(nodes.getNumEntriesInLocalRow(static_cast<int>(i)));
  return result;
}

/// Nodes of a set, of all ranks.
double size_of(const std::vector<char>& set, const CrsGraph& nodes) {
  double n = 0.0;
  for (const GlobalOrdinal node : global_numbers(*nodes.getRowMap()))
    n += set[nodes.getColMap()->getLocalElement(node)];
  return global_sum(*nodes.getComm(), n);
}

/// The second set where it is much smaller.
const std::vector<char>& much_smaller(const CrsGraph& nodes, const std::vector<char>& a,
                                      const std::vector<char>& b) {
  return size_of(b, nodes) < much_less * size_of(a, nodes) ? b : a;
}

/// Nodes without neighbours, unless the graph has no others.
void leave_out_single_nodes(const CrsGraph& nodes, std::vector<char>& is_coarse) {
  // Fixed nodes, where systems keep only the diagonal: a sweep solves for them, and coarser levels
  // would carry them along for nothing.
  Vector is_single(nodes.getRowMap());
  {
    const auto single = is_single.getLocalViewHost(overwrite_all);
    for (std::size_t i = 0; i < single.extent(0); ++i)
      single(i, 0) = nodes.getNumEntriesInLocalRow(static_cast<int>(i)) <= 1 ? 1.0 : 0.0;
  }
  if (is_single.norm1() == static_cast<double>(is_single.getGlobalLength())) return;
  const Vector on_all = algebra::on_columns(nodes, is_single);
  const auto single = on_all.getLocalViewHost(read_only);
  for (std::size_t c = 0; c < is_coarse.size(); ++c)
    if (single(c, 0) > 0.0) is_coarse[c] = 0;
}

/// Flags of the columns: the nodes between fields, none without.
std::vector<char> flags_between(const CrsGraph& nodes, const Teuchos::RCP<const Vector>& between) {
  std::vector<char> flags(n_local(*nodes.getColMap()), 0);
  if (between.is_null()) return flags;
  const Vector on_all = algebra::on_columns(nodes, *between);
  const auto view = on_all.getLocalViewHost(read_only);
  for (std::size_t c = 0; c < flags.size(); ++c) flags[c] = view(c, 0) != 0.0;
  return flags;
}

// P of means. Between fields a node has parents between fields alone: one in the softer field would
// take on the stiffness of the other.
Teuchos::RCP<const CrsMatrix> averaging(const CrsGraph& nodes, const CoarseNumbers& coarse,
                                        const std::vector<char>& is_between) {
  const auto graph = nodes.getLocalGraphHost();
  std::vector<std::size_t> lengths;
  for (int i = 0; i < static_cast<int>(n_local_rows(nodes)); ++i)
    lengths.push_back(graph.row_map(i + 1) - graph.row_map(i));
  algebra::EntryRows entries(lengths);
  std::vector<GlobalOrdinal> parents;
  for (int i = 0; i < static_cast<int>(lengths.size()); ++i) {
    const auto column = nodes.getColMap()->getLocalElement(nodes.getRowMap()->getGlobalElement(i));
    // P_ij = 1/n_i for the n_i parents j of node i; a node that stays is its own
    parents.clear();
    if (coarse.of_column[column] >= 0)
      parents.push_back(coarse.of_column[column]);
    else
      for (auto k = graph.row_map(i); k < graph.row_map(i + 1); ++k)
        if (const auto j = graph.entries(k);
            coarse.of_column[j] >= 0 && (!is_between[column] || is_between[j]))
          parents.push_back(coarse.of_column[j]);
    for (const GlobalOrdinal parent : parents)
      entries.add(i, parent, 1.0 / static_cast<double>(parents.size()));
  }
  return entries.take(nodes.getRowMap(), coarse.map);
}

/// G M, G the graph of the nodes: by node, what any of its neighbours has in M. Of P these are the
/// parents of neighbours.
CrsMatrix of_neighbours(const Teuchos::RCP<const CrsGraph>& nodes, const CrsMatrix& M) {
  CrsMatrix GM(nodes->getRowMap(), 0);
  algebra::multiply_graphs(*algebra::matrix_on(nodes, 1.0), M, GM);
  return GM;
}

/// Neighbours, and their neighbours: the entries of G G.
Teuchos::RCP<const CrsGraph> two_steps(const Teuchos::RCP<const CrsGraph>& nodes) {
  return of_neighbours(nodes, *algebra::matrix_on(nodes, 1.0)).getCrsGraph();
}

/// Coarse nodes are neighbours where any of their children are: the entries of Pᵀ G P.
Teuchos::RCP<const CrsGraph> coarse_graph(const Teuchos::RCP<const CrsGraph>& nodes,
                                          const CrsMatrix& P) {
  CrsMatrix PtGP(P.getDomainMap(), 0);
  Tpetra::MatrixMatrix::Multiply(P, true, of_neighbours(nodes, P), false, PtGP);
  return PtGP.getCrsGraph();
}

Teuchos::RCP<const Vector> at_rows(const Vector& values, const CoarseNumbers& coarse) {
  const auto result = Teuchos::rcp(new Vector(coarse.map));
  algebra::pick_rows(coarse.rows, values, *result);
  return result;
}

algebra::NodePlaces at_rows(const algebra::NodePlaces& all, const CoarseNumbers& coarse) {
  if (all.coordinates.is_null()) return {};
  const auto coordinates = Teuchos::rcp(new MultiVector(coarse.map, 3));
  algebra::pick_rows(coarse.rows, *all.coordinates, *coordinates);
  return {coordinates, at_rows(*all.in_solid, coarse)};
}

}  // namespace

NodalCoarsening::NodalCoarsening(const Teuchos::RCP<const CrsGraph>& nodes, const Vector& order,
                                 const Teuchos::RCP<const Vector>& between,
                                 const algebra::NodePlaces& places,
                                 std::shared_ptr<NodalCoarsening> vectors, bool is_plane)
    : vectors_(std::move(vectors)),
      is_plane_(is_plane), levels_{{nodes, Teuchos::rcp(new Vector(order, Teuchos::Copy)),
                                    Teuchos::null, between, places}},
      flatness_(flatness_of_solids(*nodes, places)) {}

// Followers are scalars, which have no rotations, hence no places.
NodalCoarsening::NodalCoarsening(const Teuchos::RCP<const CrsGraph>& nodes, const Vector& order,
                                 const Vector& hosts, std::shared_ptr<NodalCoarsening> leader)
    : leader_(std::move(leader)), levels_{{nodes, Teuchos::rcp(new Vector(order, Teuchos::Copy)),
                                           Teuchos::rcp(new Vector(hosts, Teuchos::Copy)),
                                           Teuchos::null}} {}

// n_c[i] = numbers[host_i]: where the host is on the next level, -1 where it does not stay
Vector NodalCoarsening::numbers_of_hosts(int level) {
  const Vector& hosts = *levels_[level].hosts;
  const Vector& numbers = *leader_->at(level).numbers;
  Vector result(hosts.getMap());
  const auto from = numbers.getLocalViewHost(read_only), host = hosts.getLocalViewHost(read_only);
  const auto to = result.getLocalViewHost(overwrite_all);
  for (std::size_t i = 0; i < to.extent(0); ++i)
    to(i, 0) =
        host(i, 0) == no_number
            ? no_number
            : from(numbers.getMap()->getLocalElement(static_cast<GlobalOrdinal>(host(i, 0))), 0);
  return result;
}

std::vector<char> NodalCoarsening::chosen_nodes(const CrsGraph& nodes, const Level& level,
                                                const Teuchos::RCP<const Vector>& first,
                                                double value) const {
  const auto set_by = [&](const Vector& order) {
    return algebra::independent_set(nodes,
                                    first.is_null() ? order : first_without(value, *first, order));
  };
  // Which order leaves fewer nodes differs from mesh to mesh by up to a factor of two; else that of
  // the mesh needs fewer iterations (walls of 25 : 1: 20 for 27, a coupled system 6 for 9).
  std::vector<char> is_coarse =
      much_smaller(nodes, set_by(*level.order), set_by(by_neighbours(-1.0, nodes, *level.order)));
  leave_out_single_nodes(nodes, is_coarse);
  if (!is_plane_ || levels_.size() > 1) return is_coarse;
  std::vector<char> even = set_by(by_neighbours(1.0, nodes, *level.order));
  leave_out_single_nodes(nodes, even);
  const double n_even = size_of(even, nodes);
  const bool is_denser = n_even > much_more * size_of(is_coarse, nodes) &&
                         n_even <= most_staying * static_cast<double>(nodes.getGlobalNumRows());
  return is_denser ? even : is_coarse;
}

// One level: the set of nodes that stay, of G or, where too many would, of G G; their numbers, P,
// and the graph of Pᵀ G P. Followers pick nodes with staying hosts first, other nodes those between
// fields.
void NodalCoarsening::coarsen() {
  Level& level = levels_.back();
  Hosts hosts;
  Teuchos::RCP<const Vector> first;  // nodes with another value than that come first
  double value = 0.0;
  if (leader_) {
    const int here = static_cast<int>(levels_.size()) - 1;
    const auto coarse = Teuchos::rcp(new Vector(numbers_of_hosts(here)));
    const auto n_coarse = leader_->prolongator(here)->getDomainMap()->getGlobalNumElements();
    hosts = {level.hosts, coarse, static_cast<GlobalOrdinal>(n_coarse)};
    first = coarse;
    value = no_number;
  } else if (!level.between.is_null()) {
    first = level.between;
  }
  Teuchos::RCP<const CrsGraph> nodes = level.nodes;
  std::vector<char> is_coarse = chosen_nodes(*nodes, level, first, value);
  const double n_coarse = size_of(is_coarse, *nodes);
  const auto n_nodes = static_cast<double>(nodes->getGlobalNumRows());
  if (vectors_ ? vectors_->is_wide(static_cast<int>(levels_.size()) - 1)
               : !leader_ && n_coarse > most_staying * n_nodes) {
    const Teuchos::RCP<const CrsGraph> wide = two_steps(nodes);
    std::vector<char> fewer = chosen_nodes(*wide, level, first, value);
    level.is_wide = size_of(fewer, *wide) < much_less * n_coarse;  // not of nodes all by themselves
    if (level.is_wide) {
      nodes = wide;
      is_coarse = std::move(fewer);
    }
  }
  const CoarseNumbers coarse(*nodes, is_coarse, hosts);
  level.P = averaging(*nodes, coarse, flags_between(*nodes, level.between));
  level.numbers = coarse.of_row;
  level.coarse_rows = coarse.rows;
  levels_.push_back({coarse_graph(level.nodes, *level.P), at_rows(*level.order, coarse),
                     leader_ ? at_rows(*hosts.coarse, coarse) : Teuchos::null,
                     level.between.is_null() ? Teuchos::null : at_rows(*level.between, coarse),
                     at_rows(level.places, coarse)});
  if (level.places.coordinates.is_null()) level.nodes = Teuchos::null;
}

std::shared_ptr<const RigidInterpolation> NodalCoarsening::rigid(int level) {
  const Level &fine = at(level), &coarse = levels_[level + 1];
  if (fine.places.coordinates.is_null()) return nullptr;
  const CrsMatrix around = of_neighbours(fine.nodes, *fine.P);
  RigidSource source{*fine.nodes, *fine.P, around, fine.places, coarse.places, fine.coarse_rows};
  source.fine_between = fine.between;
  source.coarse_between = coarse.between;
  source.keeps_exact_means = flatness_ <= still_regular;
  return std::make_shared<const RigidInterpolation>(rigid_interpolation(source));
}

Teuchos::RCP<const Vector> NodalCoarsening::hosts(int level) {
  while (leader_ && static_cast<int>(levels_.size()) <= level) coarsen();
  return leader_ ? levels_[level].hosts : Teuchos::null;
}

// P of a level exists once the next one does.
const NodalCoarsening::Level& NodalCoarsening::at(int level) {
  while (static_cast<int>(levels_.size()) <= level + 1) coarsen();
  return levels_[level];
}

}  // namespace tunica::multigrid
