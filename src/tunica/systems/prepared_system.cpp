#include "tunica/systems/prepared_system.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/rows.hpp"
#include "tunica/params/plain_text.hpp"
#include "tunica/systems/check_blocks.hpp"
#include "tunica/systems/dealt_rows.hpp"
#include "tunica/systems/graph_partition.hpp"
#include "tunica/systems/node_graph.hpp"
#include "tunica/systems/null_space.hpp"
#include "tunica/systems/preparation.hpp"
#include "tunica/systems/right_side.hpp"
#include "tunica/systems/unknown_order.hpp"

namespace tunica::systems {

namespace {

/// Where the unknowns of the files go.
struct Places {
  Deal vectors, scalars;
  algebra::Nodes at_vectors, at_scalars;
  int components;
  bool has_scalars;

  algebra::BlockSpacePtr space() const {
    std::vector<algebra::Block> blocks{{"vector", vectors.dealt, components, at_vectors}};
    if (has_scalars) blocks.push_back({"scalar", scalars.dealt, 1, at_scalars});
    return std::make_shared<const algebra::BlockSpace>(blocks);
  }
  const Deal& deal(int field) const { return field == 0 ? vectors : scalars; }
};

/// None where no file has them.
algebra::NodePlaces places_in_space(const Teuchos::ParameterList& options, const NodeTable& table,
                                    const algebra::Nodes& nodes, std::size_t lines_at_once) {
  const auto& file = options.get<std::string>("coordinates");
  if (file.empty()) return {};
  TUNICA_CHECK(table.components == 3,
               "System: \"coordinates\" are for vectors of three components, these have " +
                   std::to_string(table.components) + ".");
  const std::vector<ColumnRows> columns =
      read_columns(file, nodes.graph->getComm(), 3, lines_at_once);
  // Scalars may stand for themselves behind the nodes of the vectors.
  long long mine = -1, last = -1;
  for (const long long node : table.vector_node) mine = std::max(mine, node);
  Teuchos::reduceAll(*nodes.graph->getComm(), Teuchos::REDUCE_MAX, 1, &mine, &last);
  const long long found = columns.front().n_rows;
  TUNICA_CHECK(found == last + 1 || found == table.n_nodes,
               file + ": " + std::to_string(found) + " rows, expected one for each of " +
                   std::to_string(last + 1) + " nodes.");
  return dealt(columns, nodes);
}

Places places_of(const Blocks& blocks, const NodeTable& table,
                 const Teuchos::ParameterList& options, std::size_t lines_at_once) {
  const CommPtr comm = blocks.A.comm;
  const NodeGraph graph = vector_graph(blocks, table);
  const NodePartition parts = partition_nodes(graph, blocks.B2, table);
  const bool has_scalars = blocks.n_rows(1) > 0;
  std::vector<GlobalOrdinal> numbers;
  for (std::size_t k = 0; k < table.vector_node.size(); ++k)
    numbers.push_back(table.components * table.vector_node[k] + table.component[k]);
  algebra::Nodes at_vectors = dealt(graph, parts.vector_nodes);
  at_vectors.places = places_in_space(options, table, at_vectors, lines_at_once);
  return {Deal(numbers, parts.vectors, comm),
          Deal(table.scalar_node, parts.scalars, comm),
          at_vectors,
          table.is_shared || !has_scalars ? at_vectors
                                          : dealt(scalar_graph(blocks, table), parts.scalar_nodes),
          table.components,
          has_scalars};
}

algebra::BlockMatrix dealt_blocks(Blocks& blocks, const Places& places,
                                  const algebra::BlockSpacePtr& space) {
  algebra::BlockMatrix K(space);
  for (int i = 0; i < space->n_blocks(); ++i)
    for (int j = 0; j < space->n_blocks(); ++j)
      K.set(i, j, dealt(std::move(blocks(i, j)), places.deal(i), places.deal(j)));
  return K;
}

/// The rows of the files that the unknowns of a field have, on their ranks.
Teuchos::RCP<const Map> dealt_file_rows(const Blocks& blocks, int field, const Deal& deal) {
  std::vector<double> rows;
  for (const long long row : blocks.file_rows[field])
    rows.push_back(static_cast<double>(row + blocks.first_row[field]));
  const Teuchos::RCP<Vector> mine = dealt(rows, deal);
  const auto values = mine->getLocalViewHost(read_only);
  std::vector<GlobalOrdinal> numbers;
  for (std::size_t k = 0; k < values.extent(0); ++k)
    numbers.push_back(static_cast<GlobalOrdinal>(values(k, 0)));
  return map_of(numbers, blocks.A.comm);
}

/// On all ranks.
std::vector<GlobalOrdinal> border_of(const Vector& known_in) {
  const Comm& comm = *known_in.getMap()->getComm();
  const auto values = known_in.getLocalViewHost(read_only);
  std::vector<long long> mine;
  for (std::size_t k = 0; k < values.extent(0); ++k)
    if (values(k, 0) == bordering)
      mine.push_back(known_in.getMap()->getGlobalElement(static_cast<LocalOrdinal>(k)));
  std::vector<long long> all = on_all_ranks(comm, gather_rows(comm, mine));
  std::sort(all.begin(), all.end());
  return {all.begin(), all.end()};
}

System deal_out(Blocks given, Blocks blocks, const Preparation& preparation, const Places& places) {
  System system;
  const algebra::BlockSpacePtr space = places.space();
  const int n_fields = space->n_blocks();
  const auto vector = [&](const OfUnknowns& values) {
    std::vector<Teuchos::RCP<Vector>> parts;
    for (int i = 0; i < n_fields; ++i) parts.push_back(dealt(values[i], places.deal(i)));
    return algebra::BlockVector(space, parts);
  };
  system.known_in = vector(preparation.known_in);
  system.row_scale = vector(preparation.row_scale);
  system.scale = vector(preparation.scale);
  system.rounds = preparation.rounds;
  if (n_fields > 1) system.border = border_of(system.known_in[1]);
  for (int i = 0; i < n_fields; ++i)
    system.file_rows[i] = dealt_file_rows(given, i, places.deal(i));
  system.signs = given.signs;
  system.files = given.files;
  system.first_row = given.first_row;
  system.given = dealt_blocks(given, places, space);
  system.K = dealt_blocks(blocks, places, space);
  return system;
}

/// S ← ± R S C between free scalars; unit rows of others.
void take_to_system(const System& system, double sign, CrsMatrix& S) {
  const Map &rows = *S.getRowMap(), &columns = *S.getColMap();
  const OfColumns of(system, 1, S);
  const auto row_scale = system.row_scale[1].getLocalViewHost(read_only);
  const auto known_row = system.known_in[1].getLocalViewHost(read_only);
  const auto scale = of.scale.getLocalViewHost(read_only),
             known = of.known_in.getLocalViewHost(read_only);
  const auto local = S.getLocalMatrixHost();
  for (int i = 0; i < local.numRows(); ++i) {
    const auto row = local.row(i);
    for (int k = 0; k < row.length; ++k) {
      const int j = row.colidx(k);
      const bool is_free = known_row(i, 0) == 0.0 && known(j, 0) == 0.0;
      const bool is_diagonal = rows.getGlobalElement(i) == columns.getGlobalElement(j);
      row.value(k) = is_free       ? sign * row_scale(i, 0) * row.value(k) * scale(j, 0)
                     : is_diagonal ? 1.0
                                   : 0.0;
    }
  }
}

/// With a positive diagonal, whatever sign its author gives a Schur complement.
Teuchos::RCP<const CrsMatrix> dealt_schur(const Teuchos::ParameterList& options,
                                          const System& system, const Deal& scalars,
                                          const CommPtr& comm, std::size_t lines_at_once) {
  const auto& file = options.get<std::string>("schur");
  if (file.empty()) return Teuchos::null;
  const long long n = system.K.n_blocks() > 1 ? system.K(1, 1)->getGlobalNumRows() : 0;
  MatrixRows given = with_diagonal(read_matrix(file, comm, lines_at_once));
  const auto text = [](long long rows) { return std::to_string(rows); };
  TUNICA_CHECK(given.n_rows == n && given.n_columns == n,
               file + ": the matrix is " + text(given.n_rows) + " x " + text(given.n_columns) +
                   ", expected one for the " + text(n) + " scalar unknowns.");
  double trace = 0.0;
  for (const double value : diagonal(given)) trace += value;
  const double sign = global_sum(*comm, trace) < 0.0 ? -1.0 : 1.0;
  const Teuchos::RCP<CrsMatrix> S = dealt(std::move(given), scalars, scalars);
  take_to_system(system, sign, *S);
  return S;
}

/// Numbers of rows from 1 in a text file; from 0, ascending, on all ranks.
std::vector<long long> excluded_rows(const Teuchos::ParameterList& options, const Comm& comm) {
  const auto& path = options.get<std::string>("exclude");
  std::vector<long long> rows;
  if (path.empty()) return rows;
  on_root(comm, [&] {
    std::ifstream file(path);
    params::begin_text(file, path);
    for (std::string word; file >> word;) {
      char* end = nullptr;
      const long long row = std::strtoll(word.c_str(), &end, 10);
      TUNICA_CHECK(*end == '\0' && row > 0,
                   path + ": expected numbers of rows, from 1 on, found \"" + word + "\".");
      rows.push_back(row - 1);
    }
  });
  rows = on_all_ranks(comm, rows);
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// In the order in which each needs what is before it.
void prepare(Blocks& blocks, const Teuchos::ParameterList& options, Preparation& preparation) {
  const double negligible = options.get<double>("negligible");
  if (negligible > 0.0) drop_negligible(blocks, negligible, preparation);
  const bool is_scaled = options.get<std::string>("scaling") == "fields";
  if (is_scaled) scale_fields(blocks, preparation);
  if (options.get<bool>("known values")) take_out_known(blocks, preparation);
  if (options.get<bool>("border"))
    take_out_border(blocks, excluded_rows(options, blocks.comm()), preparation);
  if (is_scaled) scale_outlying_rows(blocks, preparation);
}

}  // namespace

System prepared_system(Blocks given, const Teuchos::ParameterList& options,
                       const std::string& order, std::size_t lines_at_once) {
  Blocks blocks = given;
  Preparation preparation(blocks);
  for (const std::string& remark :
       {doubt_sign_of_c(blocks), fill_empty_rows(blocks, preparation.known_in)})
    if (!remark.empty()) preparation.remarks.push_back(remark);
  prepare(blocks, options, preparation);
  const VectorOrder vectors = find_components(blocks.A, blocks.n_rows(1), blocks.in_nodes, options);
  Teuchos::ParameterList found;
  found.set("components", vectors.components)
      .set<std::string>("order", vectors.is_by_node ? "by node" : "by component");
  Teuchos::ParameterList with_order(options);
  with_order.setParameters(found);
  const auto& marks = preparation.known_in[1];
  const auto n_border = global_sum(
      blocks.comm(), static_cast<long long>(std::count(marks.begin(), marks.end(), bordering)));
  const ScalarsBeside beside = options.get<std::string>("node map").empty()
                                   ? scalars_beside(blocks, vectors.components, vectors.is_by_node)
                                   : ScalarsBeside{};
  const NodeTable table = make_node_table(with_order, blocks.n_rows(0), blocks.n_rows(1), n_border,
                                          beside, blocks.A.comm, lines_at_once);
  const Places places = places_of(blocks, table, options, lines_at_once);
  const CommPtr comm = blocks.A.comm;
  System system = deal_out(std::move(given), std::move(blocks), preparation, places);
  system.schur = dealt_schur(options, system, places.scalars, comm, lines_at_once);
  system.remarks = std::move(preparation.remarks);
  system.notes = std::move(preparation.notes);
  system.order = vectors.text + (order.empty() ? "" : ", " + order) +
                 (beside.are_known ? ", scalars beside vectors by their neighbours" : "");
  system.found = found;
  system.is_searched_for_constants = options.get<bool>("null space");
  if (system.is_searched_for_constants) system.constants = find_constants(system);
  for (const ConstantMode& mode : system.constants) system.notes.push_back(mode.note);
  hold_constants(system);
  return system;
}

}  // namespace tunica::systems
