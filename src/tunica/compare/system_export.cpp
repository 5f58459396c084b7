#include "tunica/compare/system_export.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tunica/base/agreement.hpp"
#include "tunica/io/atomic_file.hpp"
#include "tunica/io/matrix_market.hpp"

namespace tunica::compare {

namespace {

using Json = nlohmann::ordered_json;

MultiVector coordinates(const fields::FieldMesh& mesh) {
  MultiVector x(mesh.node_map, 3);
  const auto values = x.getLocalViewHost(overwrite_all);
  for (int a = 0; a < mesh.n_owned; ++a)
    for (int i = 0; i < 3; ++i) values(a, i) = mesh.x[a][i];
  return x;
}

/// Translations along and small rotations about the axes.
MultiVector rigid_motions(const fields::FieldMesh& mesh) {
  MultiVector modes(mesh.vector_map, 6);
  const auto values = modes.getLocalViewHost(overwrite_all);
  const Mat3 axes = identity();
  for (int a = 0; a < mesh.n_owned; ++a)
    for (int k = 0; k < 3; ++k) {
      const Vec3 turned = cross(axes[k], mesh.x[a]);
      for (int i = 0; i < 3; ++i) {
        values(3 * a + i, k) = axes[k][i];
        values(3 * a + i, 3 + k) = turned[i];
      }
    }
  return modes;
}

/// The same rows in the order of their numbers, from rank to rank.
Teuchos::RCP<const MultiVector> in_order(const Teuchos::RCP<const MultiVector>& x) {
  const Map& rows = *x->getMap();
  if (rows.isContiguous()) return x;
  const Teuchos::RCP<const Map> ordered =
      Teuchos::rcp(new Map(rows.getGlobalNumElements(), 0, rows.getComm()));
  const auto result = Teuchos::rcp(new MultiVector(ordered, x->getNumVectors()));
  result->doImport(*x, Import(x->getMap(), ordered), insert);
  return result;
}

/// Writes the blocks one below the other.
void write_blocks(const std::string& path, const std::vector<Teuchos::RCP<const MultiVector>>& x,
                  const std::string& comment) {
  std::vector<Teuchos::RCP<const MultiVector>> blocks;
  std::vector<const MultiVector*> pointers;
  for (const auto& block : x) {
    blocks.push_back(in_order(block));
    pointers.push_back(blocks.back().get());
  }
  io::write_matrix_market(path, pointers, comment);
}

std::vector<Teuchos::RCP<const MultiVector>> vectors_of(const algebra::BlockVector& x) {
  std::vector<Teuchos::RCP<const MultiVector>> vectors;
  for (int b = 0; b < x.n_blocks(); ++b) vectors.push_back(x.block(b));
  return vectors;
}

/// The vectors w, or v, of all products, in columns.
struct Columns {
  std::vector<MultiVector> blocks;

  std::vector<Teuchos::RCP<const MultiVector>> all() const {
    std::vector<Teuchos::RCP<const MultiVector>> pointers;
    for (const MultiVector& block : blocks) pointers.push_back(Teuchos::rcpFromRef(block));
    return pointers;
  }
};

/// W S, and V, of W S Vᵀ.
std::pair<Columns, Columns> columns_of(const algebra::LowRank& L,
                                       const algebra::BlockSpace& space) {
  Columns WS, V;
  for (int b = 0; b < space.n_blocks(); ++b) {
    WS.blocks.emplace_back(space[b].map, L.rank());
    V.blocks.emplace_back(space[b].map, L.rank());
    for (int k = 0; k < L.rank(); ++k) {
      WS.blocks[b].getVectorNonConst(k)->update(L[k].scale, L[k].w[b], 0.0);
      V.blocks[b].getVectorNonConst(k)->assign(L[k].v[b]);
    }
  }
  return {WS, V};
}

/// By scalar unknown; null where it is that of its node.
Teuchos::RCP<const Vector> hosts_of(const LinearSystem& system) {
  return (*system.K->space())[1].nodes.hosts;
}

/// What a reader of the files must know of the system.
void describe(const LinearSystem& system, Json& out) {
  out["operator"] =
      "K = [A B1T; B2 -C]; constrained rows and columns keep their diagonal only; nodes that "
      "slide in a plane across the axes have P K P + s (I - P), P = I - n nT";
  if (system.K->low_rank())
    out["low rank"] =
        "K has the low-rank part W VT beside these blocks, for terms that couple whole surfaces: a "
        "column of W and of V for each product, rows as in rhs";
  out["ordering"] =
      "vector unknown 3*node + i, scalar unknown node, both counted from 0; "
      "rhs and solution hold all vector unknowns, then all scalar ones";
  if (system.K->action() && !system.K->action()->is_zero())
    out["shape derivatives"] =
        "K has a matrix-free part beside these blocks, the ALE shape derivatives; it is not in the "
        "files, but rhs and solution belong to all of K";
  if (!hosts_of(system).is_null())
    out["further pressures"] =
        "scalar unknowns beyond the nodes are further pressures of nodes between layers, or "
        "between fluid and wall; "
        "scalar_nodes.mtx has the node of each scalar unknown, from 0";
  out["meaning"] = "K x = rhs = residual of Newton's method; its full step is -x";
}

std::string state_of(const LinearSystem& system, const output::RunRecord& record) {
  const Json run = Json::parse(record.text());
  const auto nodes = static_cast<long long>(system.mesh->node_map->getGlobalNumElements());
  const bool is_wall = system.field == "wall";
  Json out;
  for (const char* section : {"program", "case", "ranks", "versions"})
    out[section] = run.at(section);
  out["field"] = system.field;
  out["step"] = system.step;
  out["coupling iteration"] = system.coupling_iteration;
  out["newton step"] = system.newton_step;
  out["sizes"] = {{"nodes", nodes},
                  {"vector unknowns", 3 * nodes},
                  {"scalar unknowns", (*system.K->space())[1].map->getGlobalNumElements()}};
  describe(system, out);
  out["units"] = {{"base", "mm, ms, mg"},
                  {"coordinates", "mm, undeformed mesh"},
                  {"vector unknowns", is_wall ? "mm" : "mm/ms"},
                  {"scalar unknowns", "kPa"},
                  {"vector rows of rhs", "mN"},
                  {"scalar rows of rhs", is_wall ? "mm^3" : "mm^3/ms"}};
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

void add_export_keys(params::Table& table) {
  table.text("export folder", "",
             "write the systems there as Matrix Market files; --export overrides it");
}

SystemExport::SystemExport(const std::string& folder, const output::RunRecord& record,
                           const CommPtr& comm)
    : folder_(folder), record_(&record), comm_(comm) {
  if (!folder_.empty()) const output::RunFolder made(folder_, comm_);
}

std::string SystemExport::path(const LinearSystem& system, const std::string& file) const {
  return folder_ + "/" + system.name() + "/" + file;
}

void SystemExport::write(const LinearSystem& system) const {
  if (folder_.empty()) return;
  const output::RunFolder made(folder_ + "/" + system.name(), comm_);
  using io::write_matrix_market;
  write_matrix_market(path(system, "A.mtx"), *(*system.K)(0, 0), 1.0, "");
  write_matrix_market(path(system, "B1T.mtx"), *(*system.K)(0, 1), 1.0, "");
  write_matrix_market(path(system, "B2.mtx"), *(*system.K)(1, 0), 1.0, "");
  write_matrix_market(path(system, "C.mtx"), *(*system.K)(1, 1), -1.0, "");
  write_low_rank(system);
  write_blocks(path(system, "rhs.mtx"), vectors_of(*system.b), "");
  const std::string scalar_nodes = path(system, "scalar_nodes.mtx");
  if (!hosts_of(system).is_null())
    write_blocks(scalar_nodes, {hosts_of(system)}, "");
  else if (comm_->getRank() == 0)
    std::remove(scalar_nodes.c_str());
  const MultiVector x = coordinates(*system.mesh), modes = rigid_motions(*system.mesh);
  write_matrix_market(path(system, "coordinates.mtx"), {&x}, "mm");
  write_matrix_market(path(system, "nullspace.mtx"), {&modes}, "");
  on_root_or_fault(*comm_, [&] {
    return io::replace_file(path(system, "state.json"), state_of(system, *record_));
  });
}

void SystemExport::write_low_rank(const LinearSystem& system) const {
  const std::string W = path(system, "W.mtx"), V = path(system, "V.mtx");
  if (!system.K->low_rank()) {
    if (comm_->getRank() == 0) {
      std::remove(W.c_str());
      std::remove(V.c_str());
    }
    return;
  }
  const auto columns = columns_of(*system.K->low_rank(), *system.K->space());
  write_blocks(W, columns.first.all(), "");
  write_blocks(V, columns.second.all(), "");
}

void SystemExport::write(const LinearSystem& system,
                         const std::optional<BestSolution>& solution) const {
  if (folder_.empty()) return;
  const std::string file = path(system, "solution.mtx");
  if (!solution) {
    if (comm_->getRank() == 0) std::remove(file.c_str());
    return;
  }
  write_blocks(file, vectors_of(solution->x), note_on(*solution));
}

}  // namespace tunica::compare
