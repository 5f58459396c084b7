#pragma once
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tunica/base/timer.hpp"
#include "tunica/discretisation/observable.hpp"
#include "tunica/fields/locate.hpp"
#include "tunica/fields/state.hpp"
#include "tunica/nonlinear/newton.hpp"
#include "tunica/output/field_writer.hpp"
#include "tunica/problems/step_error.hpp"
#include "tunica/stepping/clock.hpp"

namespace tunica::observe {

/// Parts that must be restored when a step is repeated or a run continues, by name.
using Parts = std::vector<std::pair<std::string, fields::Restartable*>>;

/// A quantity that a probe may request at a point of a field, and the unit of its column: "kPa",
/// "mm_per_ms".
struct Quantity {
  std::string name;
  std::string unit;
};

/// Value of a quantity at a place on this rank.
using Sampler = std::function<double(const std::string& quantity, const fields::Place& at)>;

/// The fields of one grid at one time.
struct GridFields {
  std::string grid;
  std::vector<output::Array> points, cells;
};

/// A field of a run as its time loop, tables, files and checkpoints see it. A run has any number of
/// them and asks them in turn; what is not overridden is empty. All calls are collective.
class Field {
public:
  virtual ~Field() = default;

  /// "fluid": what its columns and parts are named by.
  virtual std::string name() const = 0;
  virtual const fields::FieldMesh& mesh() const = 0;

  // 1. From step to step.

  /// All that a step changes and the next one needs.
  virtual Parts parts() { return {}; }
  /// How accurate steps are, where steps are adaptive or a steady flow is sought; null where that
  /// is not asked of this field.
  virtual std::unique_ptr<problems::StepError> step_error(const problems::StepTolerance&) {
    return nullptr;
  }
  /// True where no coupling solves for it: solve() does, once the fields before it have made their
  /// step.
  virtual bool is_solved_behind() const { return false; }
  /// The clock's step of such a field.
  virtual nonlinear::NewtonReport solve(const stepping::Clock&, const nonlinear::NewtonWatch&) {
    return {};
  }
  /// The clock's step is accepted.
  virtual void accept(const stepping::Clock&) {}

  // 2. Columns of steps.csv, at the end of a step.

  virtual discretisation::Observables observe() { return {}; }
  /// surfaces: indices into FieldMesh::surfaces that bound the field.
  virtual discretisation::Observables observe_surfaces(const std::vector<int>& surfaces) {
    static_cast<void>(surfaces);
    return {};
  }
  virtual std::vector<Quantity> quantities() const { return {}; }
  /// Sampler of the present state; empty without quantities.
  virtual Sampler sampler() { return {}; }

  // 3. Arrays of fields.h5.

  /// The grid that the arrays belong to: its own, or that of a field before it.
  virtual std::string grid_name() const { return name(); }
  /// Asked for where the grid is its own.
  virtual output::Grid grid();
  /// Arrays of the present state.
  virtual GridFields arrays() { return {grid_name(), {}, {}}; }

  // 4. The record of the run.

  /// How fast its Jacobians were assembled; null where it has none.
  virtual const Throughput* throughput() const { return nullptr; }
};

}  // namespace tunica::observe
