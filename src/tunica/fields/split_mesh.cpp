#include "tunica/fields/split_mesh.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"

namespace tunica::fields {

namespace {

constexpr double no_part = -1.0;

/// The number of the node for each vertex and part, on owned and ghost nodes: only the owner of a
/// vertex knows all its parts.
class CopyNumbers {
public:
  CopyNumbers(const FieldMesh& mesh, const std::vector<int>& parts)
      : n_parts_(1 + *std::max_element(parts.begin(), parts.end())),
        total_(static_cast<GlobalOrdinal>(mesh.node_map->getGlobalNumElements())),
        numbers_(mesh.ghosted_map, n_parts_) {
    MultiVector owned(mesh.node_map, n_parts_);
    owned.putScalar(no_part);
    number(mesh, parts, owned);
    numbers_.doImport(owned, *mesh.import, insert);
  }

  bool has_copies() const { return has_copies_; }
  int n_parts() const { return n_parts_; }
  /// By local node of the mesh and part; absent where the node has no such part.
  auto view() const { return numbers_.getLocalViewHost(read_only); }

private:
  /// Marks what is there, then numbers it.
  void number(const FieldMesh& mesh, const std::vector<int>& parts, MultiVector& owned) {
    const auto view = owned.getLocalViewHost(read_write);
    for (std::size_t e = 0; e < mesh.tets.size(); ++e)
      for (const int a : mesh.tets[e])
        if (a < mesh.n_owned) view(a, parts[mesh.region[e]]) = 0.0;
    const auto for_each_copy = [&](const auto& work) {
      for (int a = 0; a < mesh.n_owned; ++a) {
        bool is_first = true;
        for (int part = 0; part < n_parts_; ++part) {
          if (view(a, part) == no_part) continue;
          work(a, part, is_first);
          is_first = false;
        }
      }
    };
    long long mine = 0;
    for_each_copy([&](int, int, bool is_first) { mine += !is_first; });
    has_copies_ = global_max(*mesh.comm, static_cast<double>(mine)) > 0.0;
    GlobalOrdinal next = total_ + sum_before(*mesh.comm, mine);
    for_each_copy([&](int a, int part, bool is_first) {
      view(a, part) = static_cast<double>(is_first ? mesh.node_map->getGlobalElement(a) : next++);
    });
  }

  int n_parts_;
  GlobalOrdinal total_;
  bool has_copies_ = false;
  MultiVector numbers_;
};

struct Copy {
  GlobalOrdinal number;
  int node, part, copy;
};

/// The nodes of this rank: owned ones of the mesh, their copies, ghosts by their number.
std::vector<Copy> local_copies(const FieldMesh& mesh, const std::vector<int>& parts,
                               const CopyNumbers& numbers) {
  const auto view = numbers.view();
  std::vector<char> is_used(static_cast<std::size_t>(mesh.n_nodes()) * numbers.n_parts(), 0);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    for (const int a : mesh.tets[e]) is_used[a * numbers.n_parts() + parts[mesh.region[e]]] = 1;
  std::vector<Copy> copies;
  for (int a = 0; a < mesh.n_nodes(); ++a)
    for (int part = 0, copy = 0; part < numbers.n_parts(); ++part) {
      if (view(a, part) == no_part) continue;
      if (is_used[a * numbers.n_parts() + part])
        copies.push_back({static_cast<GlobalOrdinal>(view(a, part)), a, part, copy});
      ++copy;
    }
  std::sort(copies.begin(), copies.end(), [&mesh](const Copy& a, const Copy& b) {
    const bool is_ghost_a = a.node >= mesh.n_owned, is_ghost_b = b.node >= mesh.n_owned;
    return is_ghost_a != is_ghost_b ? is_ghost_b : a.number < b.number;
  });
  return copies;
}

/// What the elements are made of, with the nodes of the part of each.
void connect(const FieldMesh& mesh, const std::vector<int>& parts, int n_parts,
             const std::vector<Copy>& copies, SplitMesh& split) {
  std::vector<int> local(static_cast<std::size_t>(mesh.n_nodes()) * n_parts, -1);
  for (std::size_t i = 0; i < copies.size(); ++i)
    local[copies[i].node * n_parts + copies[i].part] = static_cast<int>(i);
  const auto copy_of = [&](int node, int tet) {
    return local[node * n_parts + parts[mesh.region[tet]]];
  };
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    for (int& a : split.tets[e]) a = copy_of(a, static_cast<int>(e));
  for (Face& face : split.faces)
    for (int& a : face.nodes) a = copy_of(a, face.tet);
  std::vector<std::pair<int, int>> on_surfaces;
  for (std::size_t i = 0; i < copies.size(); ++i)
    for (int k = mesh.node_surfaces.begin(copies[i].node);
         k < mesh.node_surfaces.end(copies[i].node); ++k)
      on_surfaces.emplace_back(static_cast<int>(i), mesh.node_surfaces.surface(k));
  split.node_surfaces = NodeSurfaces(static_cast<int>(copies.size()), std::move(on_surfaces));
}

}  // namespace

std::unique_ptr<SplitMesh> split_mesh(const FieldMesh& mesh, const std::vector<int>& parts) {
  const CopyNumbers numbers(mesh, parts);
  if (!numbers.has_copies()) return nullptr;
  const std::vector<Copy> copies = local_copies(mesh, parts, numbers);
  auto split = std::make_unique<SplitMesh>();
  static_cast<FieldMesh&>(*split) = mesh;
  connect(mesh, parts, numbers.n_parts(), copies, *split);
  int most = 0;
  for (const int vertex : mesh.vertex) most = std::max(most, vertex);
  const int stride = 1 + static_cast<int>(global_max(*mesh.comm, most));
  int n_copies = 1;
  for (const Copy& c : copies) n_copies = std::max(n_copies, c.copy + 1);
  split->n_copies = static_cast<int>(global_max(*mesh.comm, n_copies));
  TUNICA_CHECK(static_cast<double>(stride) * split->n_copies <= std::numeric_limits<int>::max(),
               "a mesh of " + std::to_string(stride) + " vertices with " +
                   std::to_string(split->n_copies) +
                   " pressures at some is larger than this program can number");
  split->x.clear();
  split->vertex.clear();
  split->n_owned = 0;
  std::vector<GlobalOrdinal> global;
  for (const Copy& c : copies) {
    split->node.push_back(c.node);
    split->copy.push_back(c.copy);
    split->x.push_back(mesh.x[c.node]);
    split->vertex.push_back(mesh.vertex[c.node] + stride * c.copy);
    split->n_owned += c.node < mesh.n_owned;
    global.push_back(c.number);
  }
  set_maps(global, *split);
  return split;
}

}  // namespace tunica::fields
