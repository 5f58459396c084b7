#include "tunica/smoothers/node_ilu/node_blocks.hpp"

#include <algorithm>
#include <set>

#include "tunica/base/map_of.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::smoothers {

// An unknown has the place width·node + i: own nodes first, in the order of K's rows, then the
// nodes of other ranks in the columns of K. Each place has its row in K or in the ghosts' rows, or
// none where the node lacks the unknown.
NodeBlocks::NodeBlocks(const CrsMatrix& K, const algebra::DofLayout& numbering,
                       const Teuchos::RCP<const Vector>& hosts)
    : K_(&K), width_(numbering.dofs()) {
  own_.matrix = &K;
  if (!hosts.is_null()) find_followers(*hosts);
  number_nodes();
  if (K.getComm()->getSize() > 1) number_ghosts();
  rows_.resize(width_ * nodes_.size());
  for (std::size_t r = 0; r < place_of_row_.size(); ++r)
    rows_[place_of_row_[r]] = {&own_, static_cast<int>(r)};
  for (std::size_t r = 0; r < ghost_places_.size(); ++r)
    rows_[ghost_places_[r]] = {&other_, static_cast<int>(r)};
  count_unknowns();
  numbers_.resize(nodes_.size());
  for (const auto& [number, node] : nodes_) numbers_[node] = number;
  // A follower is in the group of its host, with which it is eliminated.
  group_.resize(nodes_.size());
  for (std::size_t node = 0; node < group_.size(); ++node) group_[node] = static_cast<int>(node);
  for (const auto& [host, others] : followers_)
    if (const auto found = nodes_.find(host); found != nodes_.end())
      for (const GlobalOrdinal other : others) group_[nodes_.at(other)] = found->second;
  find_blocks();
  // Needed for numbering alone
  nodes_ = Nodes();
  followers_.clear();
}

/// Of the nodes in the columns of K, whose owners know them.
void NodeBlocks::find_followers(const Vector& hosts) {
  std::set<GlobalOrdinal> reached;
  for (const GlobalOrdinal number : global_numbers(*K_->getColMap()))
    reached.insert(number / width_);
  const std::vector<GlobalOrdinal> wanted(reached.begin(), reached.end());
  std::vector<int> owners(wanted.size());
  hosts.getMap()->getRemoteIndexList(Teuchos::arrayViewFromVector(wanted),
                                     Teuchos::arrayViewFromVector(owners));
  // A node without an owner among the scalars has no host.
  std::vector<GlobalOrdinal> present;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (owners[i] >= 0) present.push_back(wanted[i]);
  Vector of_present(map_of(present, K_->getComm()));
  of_present.doImport(hosts, Import(hosts.getMap(), of_present.getMap()), insert);
  const auto host = of_present.getLocalViewHost(read_only);
  for (std::size_t i = 0; i < present.size(); ++i) {
    const auto number = static_cast<GlobalOrdinal>(host(i, 0));
    if (number >= 0 && number != present[i]) followers_[number].push_back(present[i]);
  }
}

// Followers are numbered right behind their host, so that a group stays together in the order of
// elimination.
int NodeBlocks::place(GlobalOrdinal number) {
  const int next = static_cast<int>(nodes_.size());
  const auto [entry, is_new] = nodes_.emplace(number / width_, next);
  const int node = entry->second;
  if (const auto found = followers_.find(number / width_); is_new && found != followers_.end())
    for (const GlobalOrdinal other : found->second)
      nodes_.emplace(other, static_cast<int>(nodes_.size()));
  return width_ * node + static_cast<int>(number % width_);
}

// Own rows before anything else: own nodes are those below n_own_nodes_.
void NodeBlocks::number_nodes() {
  const Map &rows = *K_->getRowMap(), &columns = *K_->getColMap();
  for (const GlobalOrdinal number : global_numbers(rows)) place_of_row_.push_back(place(number));
  n_own_nodes_ = static_cast<int>(nodes_.size());
  for (const GlobalOrdinal number : global_numbers(columns))
    own_.places.push_back(rows.isNodeGlobalElement(number) ? place(number) : -1);
}

// Columns of other ranks make their nodes known, and the rows of these are fetched. Columns of such
// rows that lead beyond are left out: the factors overlap by one layer of nodes.
void NodeBlocks::number_ghosts() {
  std::vector<GlobalOrdinal> numbers;
  for (std::size_t c = 0; c < own_.places.size(); ++c) {
    if (own_.places[c] >= 0) continue;
    numbers.push_back(K_->getColMap()->getGlobalElement(static_cast<int>(c)));
    own_.places[c] = place(numbers.back());
    ghost_places_.push_back(own_.places[c]);
  }
  fetch_ghosts(numbers);
  other_.matrix = ghosts_.get();
  for (const GlobalOrdinal number : global_numbers(*ghosts_->getColMap()))
    other_.places.push_back(nodes_.count(number / width_) > 0 ? place(number) : -1);
}

// The graph of the ghosts' rows, found once; refresh() brings values.
void NodeBlocks::fetch_ghosts(const std::vector<GlobalOrdinal>& numbers) {
  const auto map = map_of(numbers, K_->getComm());
  import_ = Teuchos::rcp(new Import(K_->getRowMap(), map));
  CrsMatrix first(map, K_->getGlobalMaxNumRowEntries());
  first.doImport(*K_, *import_, insert);
  first.fillComplete(K_->getDomainMap(), K_->getRangeMap());
  ghosts_ =
      Teuchos::rcp(new CrsMatrix(first.getCrsGraph()));  // Tpetra replaces only in given graphs
}

// A node with the scalar alone, a further pressure of a vertex, has a block of one row and column.
void NodeBlocks::count_unknowns() {
  unknowns_.reserve(nodes_.size());
  for (std::size_t first = 0; first < rows_.size(); first += width_) {
    const Row* const row = rows_.data() + first;
    const bool has_others = std::any_of(row, row + width_ - 1,
                                        [](const Row& other) { return other.source != nullptr; });
    const bool has_last = row[width_ - 1].source != nullptr;
    unknowns_.push_back(static_cast<std::uint8_t>(has_last && !has_others ? 1 : width_));
  }
}

// The columns of a row are those of its whole group, each with its group: without fill the factors
// then have a full block for the unknowns of a vertex, as if it were one node.
void NodeBlocks::find_blocks() {
  own_.look();
  other_.look();
  block_of_node_.assign(numbers_.size(), -1);
  std::vector<std::vector<int>> members(numbers_.size());  // of groups of more than one
  for (int node = 0; node < static_cast<int>(numbers_.size()); ++node)
    if (group_[node] != node) members[group_[node]].push_back(node);
  for (int node = 0; node < static_cast<int>(numbers_.size()); ++node) {
    const std::size_t first = graph_.start.back();
    const int host = group_[node];
    add_columns_of(host);
    for (const int member : members[host]) add_columns_of(member);
    for (std::size_t k = first, end = graph_.columns.size(); k < end; ++k) {
      add_column(group_[graph_.columns[k]]);
      for (const int member : members[group_[graph_.columns[k]]]) add_column(member);
    }
    const auto row = graph_.columns.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(row, graph_.columns.end());
    std::for_each(row, graph_.columns.end(), [&](int column) { block_of_node_[column] = -1; });
    graph_.start.push_back(graph_.columns.size());
  }
  graph_.columns.shrink_to_fit();
  is_plain_.resize(numbers_.size());
  for (std::size_t node = 0; node < is_plain_.size(); ++node)
    is_plain_[node] = is_plain(static_cast<int>(node));
}

// A node all of whose rows stand one behind the other, with all unknowns of its columns' nodes in
// the order of these: nearly all do.
bool NodeBlocks::is_plain(int node) const {
  const Row* const row = rows_.data() + static_cast<std::size_t>(width_) * node;
  const auto& [source, local] = row[0];
  if (source == nullptr) return false;
  const std::size_t first = graph_.start[node];
  const auto length = width_ * (graph_.start[node + 1] - first);
  for (int i = 0; i < width_; ++i) {
    if (row[i].source != source || row[i].local != local + i) return false;
    const auto start = source->start[local + i];
    if (source->start[local + i + 1] - start != length) return false;
    for (std::size_t k = 0; k < length; ++k)
      if (source->places[source->columns[start + k]] !=
          width_ * graph_.columns[first + k / width_] + static_cast<int>(k % width_))
        return false;
  }
  return true;
}

void NodeBlocks::add_columns_of(int node) {
  add_column(node);
  for (int i = 0; i < width_; ++i) {
    const auto& [source, local] = rows_[width_ * node + i];
    if (source == nullptr) continue;
    for (auto k = source->start[local]; k < source->start[local + 1]; ++k)
      if (const int at = source->places[source->columns[k]]; at >= 0) add_column(at / width_);
  }
}

// block_of_node_ marks what the present row has; between rows all of it is −1.
void NodeBlocks::add_column(int node) {
  if (block_of_node_[node] >= 0) return;
  block_of_node_[node] = 0;
  graph_.columns.push_back(node);
}

void NodeBlocks::Source::look() {
  if (matrix == nullptr) return;
  const auto local = matrix->getLocalMatrixHost();
  start = local.graph.row_map.data();
  columns = local.graph.entries.data();
  values = local.values.data();
}

// Values of the ghosts' rows; pointers too, as a matrix may have moved its storage.
void NodeBlocks::refresh() {
  if (!ghosts_.is_null()) {
    ghosts_->resumeFill();
    ghosts_->doImport(*K_, *import_, Tpetra::REPLACE);
    ghosts_->fillComplete(K_->getDomainMap(), K_->getRangeMap());
  }
  own_.look();
  other_.look();
}

double NodeBlocks::bytes() const {
  const double ghosts =
      ghosts_.is_null() ? 0.0 : 12.0 * static_cast<double>(n_local_entries(*ghosts_));
  const auto n_numbers = graph_.columns.size() + own_.places.size() + other_.places.size() +
                         place_of_row_.size() + ghost_places_.size() + block_of_node_.size();
  return ghosts +
         static_cast<double>(sizeof(int) * n_numbers +
                             sizeof(std::size_t) * (graph_.start.size() + numbers_.size()) +
                             sizeof(Row) * rows_.size() + unknowns_.size() + is_plain_.size());
}

// The blocks of a node's row in the order of its columns. Missing unknowns have the rows of the
// unit matrix, so that their pivots are one.
void NodeBlocks::read(int node, double* blocks) {
  const std::size_t size = static_cast<std::size_t>(width_) * width_;
  const std::size_t first = graph_.start[node], last = graph_.start[node + 1];
  if (is_plain_[node]) {
    const auto& [source, local] = rows_[static_cast<std::size_t>(width_) * node];
    const double* const values = source->values + source->start[local];
    const auto length = width_ * (last - first);
    for (std::size_t k = 0; k < length; ++k)
      for (int i = 0; i < width_; ++i) blocks[width_ * k + i] = values[length * i + k];
    return;
  }
  std::fill_n(blocks, size * (last - first), 0.0);
  for (std::size_t k = first; k < last; ++k)
    block_of_node_[graph_.columns[k]] = static_cast<int>(k - first);
  for (int i = 0; i < width_; ++i) {
    const auto& [source, local] = rows_[width_ * node + i];
    if (source == nullptr) {
      blocks[size * block_of_node_[node] + width_ * i + i] = 1.0;
      continue;
    }
    for (auto k = source->start[local]; k < source->start[local + 1]; ++k) {
      const int at = source->places[source->columns[k]];
      if (at < 0) continue;
      blocks[size * block_of_node_[at / width_] + width_ * (at % width_) + i] = source->values[k];
    }
  }
}

}  // namespace tunica::smoothers
