#pragma once
#include <MueLu_FactoryFactory.hpp>
#include <functional>
#include <string>
#include <vector>

#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"

namespace tunica::multigrid {

using FactoryFactory = MueLu::FactoryFactory<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

/// The matrix that a factory of a MueLu list works on: one with the unknowns of a node side by
/// side, one of blocks, or either.
enum class MatrixKind { either, merged, blocked };

/// From what a factory is made: its list, and the others that this may name.
struct FactoryRequest {
  const Teuchos::ParameterList& list;
  const FactoryFactory& builder;
  const std::map<std::string, Teuchos::RCP<const MueLu::FactoryBase>>& factories;
  const std::map<std::string, Teuchos::RCP<MueLu::FactoryManagerBase>>& managers;
  Teuchos::RCP<MixedCoarsening> coarsening;
};

/// A smoother or another factory that we add to MueLu's, as lists name it. make() throws
/// tunica::Error for keys that it lacks.
struct FactoryEntry {
  std::string name;
  MatrixKind works_on;
  std::function<Teuchos::RCP<const MueLu::FactoryBase>(const FactoryRequest&)> make;
};

/// Every one there is, in the order of the reference.
const std::vector<FactoryEntry>& our_factories();

/// Null where the name is none of ours.
const FactoryEntry* find_factory(const std::string& name);

/// "A, B and C, on blocks D"
std::string our_factories_text();

}  // namespace tunica::multigrid
