#include "tunica/systems/graph_partition.hpp"

#include <metis.h>
#include <zoltan_cpp.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/sort_once.hpp"

namespace tunica::systems {

namespace {

/// The graph without the nodes among their own neighbours, as partitioners want it.
NodeGraph without_loops(const NodeGraph& graph) {
  NodeGraph result = graph;
  result.columns.clear();
  for (std::size_t i = 0; i < graph.n_local_rows(); ++i) {
    for (std::size_t k = graph.start[i]; k < graph.start[i + 1]; ++k)
      if (graph.columns[k] != graph.first_row() + static_cast<long long>(i))
        result.columns.push_back(graph.columns[k]);
    result.start[i + 1] = result.columns.size();
  }
  return result;
}

std::vector<int> run_metis(std::vector<idx_t> start, std::vector<idx_t> neighbours, int ranks) {
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  idx_t n = static_cast<idx_t>(start.size()) - 1, constraints = 1, k = ranks, cut = 0;
  std::vector<idx_t> parts(static_cast<std::size_t>(n));
  const int status =
      METIS_PartGraphKway(&n, &constraints, start.data(), neighbours.data(), nullptr, nullptr,
                          nullptr, &k, nullptr, nullptr, options, &cut, parts.data());
  if (status != METIS_OK)
    throw std::runtime_error("METIS failed with status " + std::to_string(status));
  return {parts.begin(), parts.end()};
}

std::vector<int> partition_on_root(const NodeGraph& graph) {
  const Comm& comm = *graph.comm;
  std::vector<idx_t> lengths;
  for (std::size_t i = 0; i < graph.n_local_rows(); ++i)
    lengths.push_back(static_cast<idx_t>(graph.start[i + 1] - graph.start[i]));
  lengths = gather_rows(comm, lengths);
  const std::vector<idx_t> neighbours =
      gather_rows(comm, std::vector<idx_t>(graph.columns.begin(), graph.columns.end()));
  std::vector<int> parts;
  on_root(comm, [&] {
    std::vector<idx_t> start{0};
    for (const idx_t length : lengths) start.push_back(start.back() + length);
    parts = run_metis(std::move(start), neighbours, comm.getSize());
  });
  return spread(comm, parts, 0, graph.n_rows);
}

// What Zoltan asks for. It is given the graph as an untyped pointer.

const NodeGraph& graph_of(void* data) { return *static_cast<const NodeGraph*>(data); }

int count_nodes(void* data, int* error) {
  *error = ZOLTAN_OK;
  return static_cast<int>(graph_of(data).n_local_rows());
}

// Zoltan says what these take.
// NOLINTBEGIN(readability-function-size)
void list_nodes(void* data, int, int, ZOLTAN_ID_PTR numbers, ZOLTAN_ID_PTR, int, float*,
                int* error) {
  const NodeGraph& graph = graph_of(data);
  std::iota(numbers, numbers + graph.n_local_rows(),
            static_cast<ZOLTAN_ID_TYPE>(graph.first_row()));
  *error = ZOLTAN_OK;
}

void count_neighbours(void* data, int, int, int n, ZOLTAN_ID_PTR numbers, ZOLTAN_ID_PTR,
                      int* counts, int* error) {
  const NodeGraph& graph = graph_of(data);
  for (int i = 0; i < n; ++i) {
    const long long row = numbers[i] - graph.first_row();
    counts[i] = static_cast<int>(graph.start[row + 1] - graph.start[row]);
  }
  *error = ZOLTAN_OK;
}

void list_neighbours(void* data, int, int, int n, ZOLTAN_ID_PTR numbers, ZOLTAN_ID_PTR, int*,
                     ZOLTAN_ID_PTR neighbours, int* ranks, int, float*, int* error) {
  const NodeGraph& graph = graph_of(data);
  for (int i = 0; i < n; ++i) {
    const long long row = numbers[i] - graph.first_row();
    for (std::size_t k = graph.start[row]; k < graph.start[row + 1]; ++k) {
      *neighbours++ = static_cast<ZOLTAN_ID_TYPE>(graph.columns[k]);
      *ranks++ = rank_of_row(graph.columns[k], graph.n_rows, *graph.comm);
    }
  }
  *error = ZOLTAN_OK;
}
// NOLINTEND(readability-function-size)

std::vector<int> partition_in_place(NodeGraph graph) {
  float version = 0.0F;
  Zoltan_Initialize(0, nullptr, &version);
  Zoltan zoltan(mpi_comm(*graph.comm));
  for (const auto& [name, value] :
       std::vector<std::pair<std::string, std::string>>{{"DEBUG_LEVEL", "0"},
                                                        {"LB_METHOD", "GRAPH"},
                                                        {"GRAPH_PACKAGE", "PHG"},
                                                        {"LB_APPROACH", "PARTITION"},
                                                        {"IMBALANCE_TOL", "1.03"},
                                                        {"NUM_LID_ENTRIES", "0"},
                                                        {"RETURN_LISTS", "PARTS"},
                                                        {"SEED", "1"},
                                                        {"CHECK_GRAPH", "0"}})
    zoltan.Set_Param(name, value);
  zoltan.Set_Num_Obj_Fn(count_nodes, &graph);
  zoltan.Set_Obj_List_Fn(list_nodes, &graph);
  zoltan.Set_Num_Edges_Multi_Fn(count_neighbours, &graph);
  zoltan.Set_Edge_List_Multi_Fn(list_neighbours, &graph);

  int is_changed = 0, id_entries = 0, local_entries = 0, n_in = 0, n_out = 0;
  ZOLTAN_ID_PTR in = nullptr, in_local = nullptr, out = nullptr, out_local = nullptr;
  int *in_ranks = nullptr, *in_parts = nullptr, *out_ranks = nullptr, *out_parts = nullptr;
  const int status =
      zoltan.LB_Partition(is_changed, id_entries, local_entries, n_in, in, in_local, in_ranks,
                          in_parts, n_out, out, out_local, out_ranks, out_parts);
  std::vector<int> parts(graph.n_local_rows(), 0);
  for (int i = 0; i < n_out; ++i) parts[out[i] - graph.first_row()] = out_parts[i];
  Zoltan::LB_Free_Part(&in, &in_local, &in_ranks, &in_parts);
  Zoltan::LB_Free_Part(&out, &out_local, &out_ranks, &out_parts);
  throw_if_any<MachineFault>(*graph.comm,
                             status == ZOLTAN_OK || status == ZOLTAN_WARN
                                 ? ""
                                 : "Zoltan failed with status " + std::to_string(status));
  return parts;
}

}  // namespace

std::vector<int> partition_graph(const NodeGraph& graph, long long most_edges) {
  const int ranks = graph.comm->getSize();
  TUNICA_CHECK(ranks <= graph.n_rows, "System: " + std::to_string(ranks) + " ranks for " +
                                          std::to_string(graph.n_rows) +
                                          " nodes. Use fewer ranks.");
  if (ranks == 1) return std::vector<int>(graph.n_local_rows(), 0);
  NodeGraph edges = without_loops(graph);
  const auto twice = global_sum(*graph.comm, static_cast<long long>(edges.columns.size()));
  return twice <= 2 * most_edges ? partition_on_root(edges) : partition_in_place(std::move(edges));
}

namespace {

int most_frequent(const std::vector<int>& counts) {
  return static_cast<int>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

/// Of unknowns that go with their nodes.
std::vector<int> ranks_of(const std::vector<long long>& node_of_unknown,
                          const std::vector<int>& rank_of_node, const NodeGraph& graph) {
  std::vector<long long> nodes = node_of_unknown;
  sort_once(nodes);
  const Fetched<int> rank_of(*graph.comm, std::move(nodes), rank_of_node, graph.n_rows);
  std::vector<int> ranks;
  for (const long long node : node_of_unknown) ranks.push_back(rank_of(node));
  return ranks;
}

/// Where most of their rows of B2 are.
std::vector<int> ranks_by_rows(const MatrixRows& B2, const std::vector<int>& rank_of_vectors) {
  const Fetched<int> rank_of(*B2.comm, columns_of(B2), rank_of_vectors, B2.n_columns);
  std::vector<int> ranks;
  for (std::size_t i = 0; i < B2.n_local_rows(); ++i) {
    std::vector<int> counts(B2.comm->getSize(), 0);
    for (std::size_t k = B2.start[i]; k < B2.start[i + 1]; ++k) ++counts[rank_of(B2.columns[k])];
    ranks.push_back(most_frequent(counts));
  }
  return ranks;
}

/// Of nodes that go with their one unknown; 0 of those without.
std::vector<int> ranks_of_nodes(const std::vector<long long>& node_of_unknown,
                                const std::vector<int>& rank_of_unknown, const NodeGraph& graph) {
  struct Node {
    long long number;
    int rank;
  };
  std::vector<Node> nodes;
  std::vector<int> to;
  for (std::size_t i = 0; i < node_of_unknown.size(); ++i) {
    nodes.push_back({node_of_unknown[i], rank_of_unknown[i]});
    to.push_back(rank_of_row(node_of_unknown[i], graph.n_rows, *graph.comm));
  }
  std::vector<int> ranks(graph.n_local_rows(), 0);
  for (const Node& node : exchange_to(*graph.comm, nodes, to).items)
    ranks[node.number - graph.first_row()] = node.rank;
  return ranks;
}

}  // namespace

NodePartition partition_nodes(const NodeGraph& vectors, const MatrixRows& B2,
                              const NodeTable& table) {
  NodePartition partition;
  partition.vector_nodes = partition_graph(vectors);
  partition.vectors = ranks_of(table.vector_node, partition.vector_nodes, vectors);
  if (table.is_shared) {
    partition.scalar_nodes = partition.vector_nodes;
    partition.scalars = ranks_of(table.scalar_node, partition.vector_nodes, vectors);
  } else {
    partition.scalars = ranks_by_rows(B2, partition.vectors);
    partition.scalar_nodes = ranks_of_nodes(table.scalar_node, partition.scalars, vectors);
  }
  return partition;
}

}  // namespace tunica::systems
