#pragma once
#include <map>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/base/types.hpp"

namespace tunica::fields {

struct FieldMesh;
struct SplitMesh;

/// What a part of a run keeps between time steps and needs to go on from there: words, numbers,
/// and values at nodes or elements. They are named by their number in the mesh, so that another
/// number of ranks can take the state over.
struct State {
  /// Rows of the calling rank, one per entry of vertices, each of so many numbers.
  struct Array {
    int columns = 0;
    std::vector<double> values;
  };

  /// Of the rows: vertices, or elements from 1; each on exactly one rank.
  std::vector<GlobalOrdinal> vertices;
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
  /// Takes back a state of save(), whose vertices are those save() gives here. Returns a sentence
  /// about what could not be used, or nothing. Throws Error where something is missing.
  /// Collective.
  virtual std::string restore(const State& state) = 0;

  /// What belongs to it and has rows of another kind, by name.
  virtual std::map<std::string, Restartable*> inner_parts() { return {}; }
};

/// A state without values on the owned nodes of the mesh, or on its owned elements.
State state_on(const FieldMesh& mesh);
State element_state_on(const FieldMesh& mesh);

/// Nodal values as rows, and back. Vectors have `columns` entries per node.
State::Array rows_of(const Vector& v, int columns);
State::Array rows_of(const std::vector<Vec3>& values, int count);
void assign_rows(const State::Array& rows, Vector& v);
/// The same for a number at each node of a split mesh: a row holds those of a vertex, and zeros
/// where it has fewer than others.
State::Array rows_of(const Vector& v, const SplitMesh& split);
void assign_rows(const State::Array& rows, const SplitMesh& split, Vector& v);
/// On owned and ghost nodes. Collective.
std::vector<Vec3> ghosted_rows(const State::Array& rows, const FieldMesh& mesh);

/// Rows of the owned elements, and back to all local ones. The latter is collective.
State::Array element_rows_of(const std::vector<Vec3>& values, const FieldMesh& mesh);
std::vector<Vec3> all_element_rows(const State::Array& rows, const FieldMesh& mesh);

}  // namespace tunica::fields
