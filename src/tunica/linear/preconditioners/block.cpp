#include "tunica/linear/preconditioners/block.hpp"

#include "tunica/base/error.hpp"
#include "tunica/linear/block_preconditioner.hpp"

namespace tunica::linear {

namespace {

class BlockSystem final : public PreconditionedSystem {
public:
  BlockSystem(const Teuchos::ParameterList& list, const algebra::BlockMatrix& K,
              const NamedOperators& operators)
      : blocks_(K.space()), matrix_(Teuchos::rcp(new algebra::ConcatenatedOperator(blocks_, K))),
        preconditioner_(
            Teuchos::rcp(new BlockPreconditioner(list.sublist("Stratimikos"), K, operators))) {}

  Teuchos::RCP<const Map> map() const override { return blocks_.map(); }
  Teuchos::RCP<const Operator> matrix() const override { return matrix_; }
  Teuchos::RCP<const Operator> preconditioner() const override { return preconditioner_; }
  void refresh_matrix() override {}  // the operator reads the blocks themselves
  void refresh_preconditioner() override { preconditioner_->refresh(); }
  void gather(const algebra::BlockVector& x, MultiVector& all) const override {
    blocks_.gather(x, all);
  }
  void scatter(const MultiVector& all, algebra::BlockVector& x) const override {
    blocks_.scatter(all, x);
  }

private:
  algebra::Concatenation blocks_;
  Teuchos::RCP<algebra::ConcatenatedOperator> matrix_;
  Teuchos::RCP<BlockPreconditioner> preconditioner_;
};

void check_list(const Teuchos::ParameterList& list, const std::string& path) {
  if (!list.isSublist("Stratimikos")) return;  // another preconditioner
  try {
    check_block_preconditioner(list.sublist("Stratimikos"));
  } catch (const Error& error) {
    throw Error(path + " / Stratimikos: " + error.what());
  }
}

params::Table table_of(const SolverDefaults& defaults) {
  params::Table table;
  table
      .foreign("Stratimikos", defaults.block, Teuchos::ParameterList(),
               "a Stratimikos list with a Teko preconditioner, as Trilinos users write it; our "
               "strategies in it are LU Upper, LU Lower and LU Full")
      .check(check_list);
  return table;
}

}  // namespace

PreconditionerEntry block_preconditioner() {
  return {"block", 8.0, table_of,
          [](const Teuchos::ParameterList& list, const algebra::BlockMatrix& K,
             const NamedOperators& operators) {
            return std::make_unique<BlockSystem>(list, K, operators);
          }};
}

}  // namespace tunica::linear
