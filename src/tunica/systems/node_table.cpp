#include "tunica/systems/node_table.hpp"

#include <algorithm>
#include <string>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/sort_once.hpp"
#include "tunica/systems/node_map_file.hpp"

namespace tunica::systems {

namespace {

Unknowns regular(int components, bool is_by_node, long long n_vector, long long n_scalar,
                 const Comm& comm) {
  TUNICA_CHECK(n_vector % components == 0,
               "System: A has " + std::to_string(n_vector) +
                   " rows, which \"components\" = " + std::to_string(components) +
                   " does not divide. Give a \"node map\" that says which rows belong to a node.");
  Unknowns mine;
  mine.total = n_vector + n_scalar;
  const long long n = n_vector / components;
  const Portion vectors = portion_of(n_vector, comm), scalars = portion_of(n_scalar, comm);
  for (long long k = vectors.first; k < vectors.first + vectors.count; ++k)
    mine.vectors.push_back({is_by_node ? k / components : k % n,
                            static_cast<int>(is_by_node ? k % components : k / n), 0});
  for (long long k = scalars.first; k < scalars.first + scalars.count; ++k)
    mine.scalars.push_back({k, 0, 0});
  return mine;
}

/// The nodes of the vectors by the numbers of their scalars. Collective.
void renumber(const ScalarsBeside& beside, long long n_nodes, const Comm& comm,
              std::vector<Unknown>& vectors) {
  std::vector<long long> nodes;
  for (const Unknown& unknown : vectors) nodes.push_back(unknown.node);
  sort_once(nodes);
  const Fetched<long long> scalar_of(comm, std::move(nodes), beside.of_node, n_nodes);
  for (Unknown& unknown : vectors) unknown.node = scalar_of(unknown.node);
}

/// Unknowns on the ranks that keep their nodes, and the way back.
class Kept {
public:
  Kept(const Comm& comm, const std::vector<Unknown>& unknowns, long long nodes_of_rank)
      : comm_(comm) {
    for (const Unknown& unknown : unknowns)
      ranks_.push_back(static_cast<int>(unknown.node / nodes_of_rank));
    received_ = exchange_to(comm, unknowns, ranks_);
  }
  std::vector<Unknown>& items() { return received_.items; }

  /// What has been made of them, in the order in which they were. Collective.
  std::vector<Unknown> sent_back() const {
    const Received<Unknown> back = exchange(comm_, received_.items, received_.counts);
    std::vector<std::size_t> next(back.counts.size(), 0);
    for (std::size_t r = 1; r < next.size(); ++r)
      next[r] = next[r - 1] + static_cast<std::size_t>(back.counts[r - 1]);
    std::vector<Unknown> ordered;
    for (const int rank : ranks_) ordered.push_back(back.items[next[rank]++]);
    return ordered;
  }

private:
  const Comm& comm_;
  std::vector<int> ranks_;
  Received<Unknown> received_;
};

/// Each rank keeps the nodes of an equal part of their numbers, which may have gaps, and sees all
/// unknowns of a node, in the order of the file.
class NodeKeeper {
public:
  /// n_lone: scalars that may stand at a node without vectors.
  NodeKeeper(const Comm& comm, int components, std::string path, const Unknowns& unknowns,
             long long n_lone)
      : comm_(comm), components_(components), n_lone_(n_lone), path_(std::move(path)),
        nodes_of_rank_(largest_node(unknowns) / comm.getSize() + 1),
        vectors_(comm, unknowns.vectors, nodes_of_rank_),
        scalars_(comm, unknowns.scalars, nodes_of_rank_) {
    for (auto* const kept : {&vectors_, &scalars_})
      for (const Unknown& unknown : kept->items()) nodes_.push_back(unknown.node);
    sort_once(nodes_);
    taken_.assign(nodes_.size(), 0);
  }

  /// Nodes get the numbers 0, 1, … in the order of those of the file.
  NodeTable table() {
    take_components();
    throw_first_fault();
    const auto mine = static_cast<long long>(nodes_.size());
    const long long first = sum_before(comm_, mine);
    for (auto* const kept : {&vectors_, &scalars_})
      for (Unknown& unknown : kept->items()) unknown.node = first + place_of(unknown.node, nodes_);
    NodeTable table;
    table.components = components_;
    table.n_nodes = global_sum(comm_, mine);
    table.is_shared = are_shared();
    for (const Unknown& unknown : vectors_.sent_back()) {
      table.vector_node.push_back(unknown.node);
      table.component.push_back(unknown.component);
    }
    for (const Unknown& unknown : scalars_.sent_back()) table.scalar_node.push_back(unknown.node);
    return table;
  }

private:
  bool are_shared() const {
    long long lone_scalars = 0, lone_vectors = 0;
    for (const unsigned has : taken_) {
      lone_scalars += has == scalar_bit();
      lone_vectors += (has & scalar_bit()) == 0;
    }
    lone_scalars = global_sum(comm_, lone_scalars);
    return global_sum(comm_, lone_vectors) == 0 && lone_scalars <= n_lone_ &&
           lone_scalars < global_sum(comm_, static_cast<long long>(taken_.size()));
  }
  long long largest_node(const Unknowns& unknowns) const {
    long long mine = 0, largest = 0;
    for (const auto* const list : {&unknowns.vectors, &unknowns.scalars})
      for (const Unknown& unknown : *list) mine = std::max(mine, unknown.node);
    Teuchos::reduceAll(comm_, Teuchos::REDUCE_MAX, 1, &mine, &largest);
    return largest;
  }
  unsigned scalar_bit() const { return 1U << components_; }

  void take_components() {
    for (Unknown& unknown : vectors_.items()) {
      unsigned& taken = taken_[place_of(unknown.node, nodes_)];
      if (unknown.component == next_component) unknown.component = count(taken);
      const std::string component = std::to_string(unknown.component);
      if (unknown.component < 0 || unknown.component >= components_)
        return fail(unknown, "component " + component + " of node " + std::to_string(unknown.node) +
                                 ", but \"components\" is " + std::to_string(components_));
      if ((taken >> unknown.component & 1U) != 0)
        return fail(unknown, "node " + std::to_string(unknown.node) +
                                 " has two unknowns of component " + component);
      taken |= 1U << unknown.component;
    }
    for (const Unknown& unknown : scalars_.items()) {
      unsigned& taken = taken_[place_of(unknown.node, nodes_)];
      if ((taken & scalar_bit()) != 0)
        return fail(unknown, "node " + std::to_string(unknown.node) + " has two scalar unknowns");
      taken |= scalar_bit();
    }
  }
  static int count(unsigned bits) {
    int n = 0;
    for (; bits != 0; bits &= bits - 1) ++n;
    return n;
  }
  void fail(const Unknown& unknown, const std::string& problem) {
    fault_ = complaint(path_, unknown.line, problem);
    line_of_fault_ = unknown.line;
  }
  /// That of the first line, of all ranks.
  void throw_first_fault() const {
    long long first = 0;
    Teuchos::reduceAll(comm_, Teuchos::REDUCE_MIN, 1, &line_of_fault_, &first);
    throw_if_any<Error>(comm_, line_of_fault_ == first ? fault_ : "");
  }

  const Comm& comm_;
  int components_;
  long long n_lone_;
  std::string path_;
  long long nodes_of_rank_;
  Kept vectors_, scalars_;
  std::vector<long long> nodes_;
  std::vector<unsigned> taken_;  ///< of each node: a bit of each component, one of the scalar
  std::string fault_;
  long long line_of_fault_ = std::numeric_limits<long long>::max();
};

}  // namespace

// Where scalars are found beside vectors those alone are few, and share the coarse nodes of the
// others. Where a file says so they may be second pressures at the layers of a wall, which are
// better left to themselves (Vanka's sweeps on a coupled system: 13 iterations for 10).
NodeTable make_node_table(const Teuchos::ParameterList& options, long long n_vector,
                          long long n_scalar, long long n_border, const ScalarsBeside& beside,
                          const CommPtr& comm, std::size_t lines_at_once) {
  const int components = options.get<int>("components");
  const auto& file = options.get<std::string>("node map");
  Unknowns unknowns = file.empty()
                          ? regular(components, options.get<std::string>("order") == "by node",
                                    n_vector, n_scalar, *comm)
                          : read_node_map(file, n_vector, n_scalar, comm, lines_at_once);
  if (beside.are_known) renumber(beside, n_vector / components, *comm, unknowns.vectors);
  const long long n_lone = beside.are_known ? n_scalar / 2 : n_border;
  const NodeTable table = NodeKeeper(*comm, components, file, unknowns, n_lone).table();
  TUNICA_CHECK(unknowns.total == n_vector + n_scalar,
               file + ": " + std::to_string(unknowns.total) + " unknowns, expected " +
                   std::to_string(n_vector) + " of A and " + std::to_string(n_scalar) + " of B2.");
  return table;
}

}  // namespace tunica::systems
