#include "tunica/linear/nodal_multigrid.hpp"

#include <Teko_BlockPreconditionerFactory.hpp>
#include <Teko_CloneFactory.hpp>
#include <Teko_PreconditionerFactory.hpp>
#include <Teko_RequestHandler.hpp>
#include <stdexcept>

#include "tunica/linear/thyra_operator.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"
#include "tunica/params/known_keys.hpp"

namespace tunica::linear {

namespace {

// Ã⁻¹ or a part of S̃⁻¹ as one cycle on a block of the mixed matrix.
class NodalMultigrid : public Teko::PreconditionerFactory {
public:
  void initializeFromParameterList(const Teuchos::ParameterList& list) override {
    params::check_keys(list, {"Type", "Sweeps", "Coarse Size", "MueLu"});
    Teuchos::ParameterList own(list);
    const int sweeps = own.get("Sweeps", 1), coarse_size = own.get("Coarse Size", 500);
    if (sweeps < 1 || coarse_size < 1)
      throw std::invalid_argument("\"Sweeps\" and \"Coarse Size\" must be at least 1.");
    // A list of MueLu's replaces both keys: beside it they would do nothing, in silence.
    if (list.isParameter("MueLu")) {
      if (!list.isSublist("MueLu")) throw std::invalid_argument("\"MueLu\" must be a list.");
      if (list.isParameter("Sweeps") || list.isParameter("Coarse Size"))
        throw std::invalid_argument(
            "\"Sweeps\" and \"Coarse Size\" have no effect beside \"MueLu\".");
      multigrid::check_cycle_list(own.sublist("MueLu"));
    }
    muelu_ = own.isSublist("MueLu") ? own.sublist("MueLu")
                                    : multigrid::nodal_cycle_list(sweeps, coarse_size);
  }

  Teko::LinearOp buildPreconditionerOperator(Teko::LinearOp& op,
                                             Teko::PreconditionerState& state) const override {
    const auto A = Teuchos::rcp_const_cast<CrsMatrix>(matrix_of(op));
    auto& kept = dynamic_cast<Kept&>(state);
    // The same matrix on the same graph: the levels follow its values by numeric work.
    if (kept.matrix == A) {
      kept.cycle->refresh();
      return kept.as_operator;
    }
    // All blocks share the nodes, on each level.
    using Coarsening = Teuchos::RCP<multigrid::MixedCoarsening>;
    const auto nodes =
        getRequestHandler()->request<Coarsening>(Teko::RequestMesg("Nodal Coarsening"));
    kept.matrix = Teuchos::null;  // nothing to keep should the set-up fail
    kept.cycle = Teuchos::rcp(new multigrid::Cycle(A, nodes, muelu_));
    const Teuchos::RCP<const Operator> cycle = kept.cycle;
    kept.as_operator = Thyra::createConstLinearOp<Scalar, LocalOrdinal, GlobalOrdinal, Node>(cycle);
    kept.matrix = A;
    return kept.as_operator;
  }

  Teuchos::RCP<Teko::PreconditionerState> buildPreconditionerState() const override {
    return Teuchos::rcp(new Kept);
  }

private:
  /// The cycle for a matrix whose values change while the object stays.
  struct Kept : public Teko::PreconditionerState {
    Teuchos::RCP<CrsMatrix> matrix;
    Teuchos::RCP<multigrid::Cycle> cycle;
    Teko::LinearOp as_operator;
  };

  Teuchos::ParameterList muelu_;
};

}  // namespace

void register_nodal_multigrid() {
  static const bool is_registered = [] {
    const Teuchos::RCP<Teko::Cloneable> clone = Teuchos::rcp(new Teko::AutoClone<NodalMultigrid>());
    Teko::PreconditionerFactory::addPreconditionerFactory("Nodal Multigrid", clone);
    return true;
  }();
  static_cast<void>(is_registered);
}

}  // namespace tunica::linear
