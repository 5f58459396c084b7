#pragma once
#include <string>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::linear {

/// Matrices by which physics helps a preconditioner, asked for by name. linear/ knows only the
/// names; the owner of the Jacobian knows what stands behind them.
class NamedOperators {
public:
  virtual ~NamedOperators() = default;
  virtual std::vector<std::string> operator_names() const = 0;
  /// The matrix for the present state; null for an unknown name. Collective.
  virtual Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string& name) const = 0;
};

/// Name of the contribution of a part of a coupled system to the block of its vectors, on the graph
/// of that block.
inline std::string own_block_of(const std::string& part) { return "Own Block of " + part; }

/// The operators of a system that has none.
const NamedOperators& no_operators();

}  // namespace tunica::linear
