#include "tunica/linear/preconditioners/block.hpp"

#include "tunica/base/error.hpp"
#include "tunica/linear/block_preconditioner.hpp"
#include "tunica/linear/concatenated_system.hpp"

namespace tunica::linear {

namespace {

void check_block_list(const Teuchos::ParameterList& list, const std::string& path) {
  if (!list.isSublist("Stratimikos")) return;  // another preconditioner
  try {
    check_block_preconditioner(list.sublist("Stratimikos"));
  } catch (const Error& error) {
    throw Error(path + " / Stratimikos: " + error.what());
  }
}

params::Table block_table(const SolverDefaults& defaults) {
  params::Table table;
  table
      .foreign("Stratimikos", defaults.block, Teuchos::ParameterList(),
               "a Stratimikos list with a Teko preconditioner, as usual in Trilinos; additional "
               "strategies of Tunica are LU Upper, LU Lower and LU Full")
      .check(check_block_list);
  return table;
}

}  // namespace

PreconditionerEntry block_preconditioner() {
  return {"block", 8.0, block_table,
          [](const Teuchos::ParameterList& list, const algebra::BlockMatrix& K,
             const NamedOperators& operators) {
            return std::make_unique<ConcatenatedSystem<BlockPreconditioner>>(
                K,
                Teuchos::rcp(new BlockPreconditioner(list.sublist("Stratimikos"), K, operators)));
          }};
}

}  // namespace tunica::linear
