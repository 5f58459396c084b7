#pragma once
#include "tunica/problems/field_problem.hpp"
#include "tunica/stepping/timeline.hpp"

namespace tunica::problems {

/// The accepted states of a field, from which the next one is guessed.
class StateHistory final : public fields::Restartable {
public:
  /// Keeps what polynomials of the degree need. The field must outlive the object and stand at its
  /// start.
  StateHistory(const FieldProblem& field, int degree);

  /// The present state is accepted.
  void accept();
  /// Value of the polynomial through the last states at the end of the clock's step; its degree is
  /// lower if there are too few states.
  algebra::BlockVector extrapolated(const stepping::StepSizes& sizes) const;

  // Restartable: all but the last state, which is the field's and has to be restored before
  fields::State save() const override;
  std::string restore(const fields::State& state) override;

private:
  const FieldProblem* field_;
  int degree_;
  std::vector<stepping::Timeline> blocks_;  ///< of owned nodes
};

}  // namespace tunica::problems
