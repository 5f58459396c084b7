#pragma once
#include <map>
#include <string>
#include <vector>

#include "tunica/algebra/block_vector.hpp"
#include "tunica/base/tensor.hpp"
#include "tunica/base/types.hpp"

namespace tunica::fields {

struct FieldMesh;
struct SplitMesh;

/// State that a part of a run keeps between time steps and needs to continue: words, numbers, and
/// values at nodes or elements. They are named by their number in the mesh, so that another number
/// of ranks can take the state over.
struct State {
  /// Rows of the calling rank, one per entry of places, each of so many numbers.
  struct Array {
    int columns = 0;
    std::vector<double> values;
  };

  /// Places of the rows: vertices, or elements from 1; each on exactly one rank.
  std::vector<GlobalOrdinal> places;
  std::map<std::string, std::string> texts;
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, Array> arrays;

  bool has_array(const std::string& name) const { return arrays.count(name) > 0; }
  /// Throw Error that names what is missing, or has another shape.
  const std::string& text(const std::string& name) const;
  const std::vector<double>& number_list(const std::string& name) const;
  const Array& array(const std::string& name, int columns) const;
};

/// A part of a run that can be put back into an earlier state.
class Restartable {
public:
  virtual ~Restartable() = default;

  /// The state after an accepted time step. Collective.
  virtual State save() const = 0;
  /// Takes back a state of save(), whose places are those save() gives here. Returns a sentence
  /// about what could not be used, or nothing. Throws Error where something is missing.
  /// Collective.
  virtual std::string restore(const State& state) = 0;
  /// Whether the checkpoint of another run may lack it: it then begins with this run.
  virtual bool may_be_missing() const { return false; }

  /// Parts of it that have rows of another kind, by name.
  virtual std::map<std::string, Restartable*> inner_parts() { return {}; }
};

/// Places that rows of numbers belong to: nodes of a mesh, its elements, their quadrature points,
/// or nothing in space. Each place is owned by one rank; others may hold a copy of its rows. Places
/// are known by their number in the mesh, so that a state outlives its partition.
class Places {
public:
  /// Owned and ghost nodes, or the owned ones alone.
  static Places nodes(const FieldMesh& mesh);
  static Places owned_nodes(const FieldMesh& mesh);
  /// All local elements, with so many points each; rows of an element follow each other.
  static Places elements(const FieldMesh& mesh, int points = 1);
  /// Places with these numbers, which no other rank holds.
  static Places of_this_rank(std::vector<GlobalOrdinal> numbers, const CommPtr& comm);
  /// One row that is the same on all ranks.
  static Places everywhere();

  /// Local rows.
  int count() const { return static_cast<int>(numbers_.size()) * points_; }
  bool is_everywhere() const { return comm_.is_null(); }

  /// A state without values on the owned places.
  State state() const;
  /// The rows of owned places out of all local ones, `width` numbers each.
  State::Array owned_rows(const std::vector<double>& rows, int width) const;
  /// And back: brings copies from their owners. Collective where there may be copies.
  std::vector<double> local_rows(const State& state, const std::string& name, int width) const;

private:
  Places() = default;
  std::vector<double> imported(const std::vector<double>& owned, int columns) const;

  std::vector<GlobalOrdinal> numbers_;  ///< of all local places
  std::vector<int> owned_;              ///< their positions in numbers_
  bool has_copies_ = false;             ///< on some rank
  int points_ = 1;
  CommPtr comm_;  ///< null where the row is everywhere
};

/// Vectors as rows of three, all of them or the first ones, and back.
std::vector<double> as_rows(const std::vector<Vec3>& vectors);
std::vector<double> as_rows(const std::vector<Vec3>& vectors, int count);
std::vector<Vec3> as_vectors(const std::vector<double>& rows);

/// A state without values on the owned nodes of the mesh.
State state_on(const FieldMesh& mesh);

/// Nodal values as rows, and back. Vectors have `columns` entries per node.
State::Array rows_of(const Vector& v, int columns);
State::Array rows_of(const std::vector<Vec3>& values, int count);
void assign_rows(const State::Array& rows, Vector& v);
/// Rows for a number at each node of a split mesh: a row holds the numbers of a vertex, and zeros
/// if it has fewer than others.
State::Array rows_of(const Vector& v, const SplitMesh& split);
void assign_rows(const State::Array& rows, const SplitMesh& split, Vector& v);
/// Of a block of unknowns; split carries the scalars where it is not null.
State::Array rows_of(const algebra::BlockVector& x, int block, const SplitMesh* split);
void assign_rows(const State::Array& rows, int block, const SplitMesh* split,
                 algebra::BlockVector& x);
/// Numbers in a row of the block.
int row_length(const algebra::Block& block, const SplitMesh* split);

}  // namespace tunica::fields
