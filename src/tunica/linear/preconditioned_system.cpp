#include "tunica/linear/preconditioned_system.hpp"

#include "tunica/algebra/merged_matrix.hpp"
#include "tunica/base/error.hpp"
#include "tunica/linear/block_preconditioner.hpp"
#include "tunica/linear/direct_factor.hpp"
#include "tunica/linear/ilu.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"

namespace tunica::linear {

namespace {

/// One matrix with the unknowns of a node side by side; incomplete or complete factors of it, or
/// multigrid cycles for it.
class MergedSystem final : public PreconditionedSystem {
public:
  MergedSystem(const Teuchos::ParameterList& list, const algebra::BlockMatrix& K) : K_(K) {
    const auto& kind = list.get<std::string>("preconditioner");
    if (kind == "direct") direct_ = Teuchos::rcp(new DirectFactor(K_.matrix()));
    if (kind == "ilu")
      ilu_ = std::make_unique<IluPreconditioner>(K_.matrix(), list.get<int>("fill level"),
                                                 list.get<int>("overlap"));
    if (kind == "multigrid") {
      muelu_ = list.sublist("MueLu");
      is_blocked_ = list.get<std::string>("matrix") == "blocked";
      nodes_ = Teuchos::rcp(new multigrid::MixedCoarsening(*K.space()));
    }
  }

  Teuchos::RCP<const Map> map() const override { return K_.matrix()->getRowMap(); }
  Teuchos::RCP<const Operator> matrix() const override { return K_.matrix(); }
  Teuchos::RCP<const Operator> preconditioner() const override {
    if (!direct_.is_null()) return direct_;
    if (ilu_) return ilu_->as_operator();
    return cycle_;
  }
  void refresh_matrix() override { K_.refresh(); }
  void refresh_preconditioner() override {
    if (!direct_.is_null()) direct_->refresh();
    if (ilu_) ilu_->refresh();
    if (nodes_.is_null()) return;
    try {
      if (cycle_.is_null())
        cycle_ = Teuchos::rcp(new multigrid::Cycle(K_.matrix(), nodes_, muelu_, is_blocked_));
      else
        cycle_->refresh();
    } catch (const std::exception& error) {
      cycle_ = Teuchos::null;
      throw SetupFailure(std::string("the multigrid cycle cannot be set up: ") + error.what());
    }
  }
  multigrid::Levels levels() const override {
    return cycle_.is_null() ? multigrid::Levels() : cycle_->levels();
  }
  void gather(const algebra::BlockVector& x, MultiVector& all) const override { K_.merge(x, all); }
  void scatter(const MultiVector& all, algebra::BlockVector& x) const override { K_.split(all, x); }

private:
  algebra::MergedMatrix K_;
  Teuchos::RCP<DirectFactor> direct_;
  std::unique_ptr<IluPreconditioner> ilu_;
  Teuchos::ParameterList muelu_;
  bool is_blocked_ = false;  ///< what the cycle works on
  Teuchos::RCP<multigrid::MixedCoarsening> nodes_;
  Teuchos::RCP<multigrid::Cycle> cycle_;
};

/// The blocks as they are, block preconditioners on them.
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

}  // namespace

void add_preconditioner_keys(params::Table& table, const std::string& fallback,
                             const Teuchos::ParameterList& block_list,
                             const Teuchos::ParameterList& cycle_list) {
  params::Table ilu, block, cycle, direct, none;
  ilu.integer("fill level", 0, params::between(0, 20), "levels of fill k of ILU(k)")
      .integer("overlap", 0, params::between(0, 20), "overlap between ranks, in graph layers");
  block
      .foreign("Stratimikos", block_list, Teuchos::ParameterList(),
               "a Stratimikos list with a Teko preconditioner, as Trilinos users write it; our "
               "strategies in it are LU Upper, LU Lower and LU Full")
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        if (!list.isSublist("Stratimikos")) return;  // another preconditioner
        try {
          check_block_preconditioner(list.sublist("Stratimikos"));
        } catch (const Error& error) {
          throw Error(path + " / Stratimikos: " + error.what());
        }
      });
  cycle
      .choice("matrix", "merged", {"merged", "blocked"},
              "what the MueLu list works on: one matrix with the unknowns of a node side by side, "
              "or MueLu's 2×2 matrix of blocks, as its own block smoothers want it")
      .foreign("MueLu", cycle_list, Teuchos::ParameterList(),
               "a MueLu list of factories for the whole system, the unknowns of a node side by "
               "side; our "
               "factories in it are NodalPFactory, GalerkinFactory, NodalIluSmoother, "
               "VankaSmoother, NodalBraessSarazinSmoother, Ifpack2Smoother and SparseLUSolver, on "
               "blocks NodalBlockedPFactory")
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        if (!list.isSublist("MueLu")) return;  // another preconditioner
        try {
          multigrid::check_cycle_list(list.sublist("MueLu"),
                                      list.get<std::string>("matrix") == "blocked");
        } catch (const Error& error) {
          throw Error(path + " / MueLu: " + error.what());
        }
      });
  table.variant(
      "preconditioner", fallback,
      {{"ilu", ilu}, {"block", block}, {"multigrid", cycle}, {"direct", direct}, {"none", none}},
      "right preconditioner: incomplete LU with additive Schwarz between ranks, a "
      "block preconditioner, a multigrid cycle for the whole system, sparse LU factors "
      "(worth it where they are kept), or none");
}

std::unique_ptr<PreconditionedSystem> make_system(const Teuchos::ParameterList& list,
                                                  const algebra::BlockMatrix& K,
                                                  const NamedOperators& operators) {
  if (list.get<std::string>("preconditioner") == "block")
    return std::make_unique<BlockSystem>(list, K, operators);
  return std::make_unique<MergedSystem>(list, K);
}

}  // namespace tunica::linear
