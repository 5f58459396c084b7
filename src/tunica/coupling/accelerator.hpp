#pragma once
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "tunica/base/types.hpp"
#include "tunica/fields/interface_transfer.hpp"
#include "tunica/fields/state.hpp"
#include "tunica/params/table.hpp"

namespace tunica::coupling {

using fields::InterfaceVector;

/// Makes the next interface displacement from the residual r = d̃ − d of a Dirichlet–Neumann
/// iteration, d̃ the wall's answer to d. What it would relax it relaxes behind the preconditioner
/// P, the identity unless set. All members are collective.
class Accelerator {
public:
  using Preconditioner = std::function<InterfaceVector(const InterfaceVector&)>;

  virtual ~Accelerator() = default;

  /// Between time steps; a step keeps its P.
  void set_preconditioner(Preconditioner P) { P_ = std::move(P); }

  virtual void begin_step() = 0;
  virtual InterfaceVector next(const InterfaceVector& d, const InterfaceVector& residual) = 0;
  virtual void end_step() = 0;

  /// Drops what earlier steps have left: they say little about the next.
  virtual void forget() {}

  /// Adds to a state what the next steps need of the earlier ones, and takes it back.
  virtual void save(fields::State&) const {}
  virtual void restore(const fields::State&) {}

  /// Relaxation factor of the last next(); 1 where a whole least-squares update was made.
  virtual double relaxation() const = 0;
  /// Columns of the least-squares update of the last next(); 0 for plain relaxation.
  virtual int columns() const = 0;

protected:
  /// P r.
  InterfaceVector preconditioned(const InterfaceVector& r) const { return P_ ? P_(r) : r; }

private:
  Preconditioner P_;
};

/// Adds the key "accelerator" and the keys of each accelerator.
void add_accelerator_keys(params::Table& table);

std::unique_ptr<Accelerator> make_accelerator(const Teuchos::ParameterList& list,
                                              const CommPtr& comm);

/// Vectors side by side as the columns of one array, three per vector, and back.
fields::State::Array packed(const std::deque<InterfaceVector>& vectors);
std::deque<InterfaceVector> unpacked(const fields::State::Array& rows);

/// a − b.
InterfaceVector difference(const InterfaceVector& a, const InterfaceVector& b);

/// Sum over all ranks of the products of the entries.
double inner_product(const Comm& comm, const InterfaceVector& a, const InterfaceVector& b);

}  // namespace tunica::coupling
