#include "linear/block_preconditioner.hpp"

#include <Stratimikos_DefaultLinearSolverBuilder.hpp>
#include <Stratimikos_MueLuHelpers.hpp>
#include <Teko_InverseLibrary.hpp>
#include <Teko_PreconditionerFactory.hpp>
#include <Teko_RequestCallback.hpp>
#include <Teko_RequestHandler.hpp>
#include <Teko_StratimikosFactory.hpp>
#include <Teko_Utilities.hpp>
#include <Teuchos_AbstractFactoryStd.hpp>
#include <Thyra_DefaultProductMultiVector.hpp>
#include <Thyra_DefaultProductVectorSpace.hpp>
#include <Thyra_Ifpack2PreconditionerFactory.hpp>
#include <Thyra_PreconditionerFactoryHelpers.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>
#include <algorithm>

#include "base/error.hpp"
#include "linear/lu_strategy.hpp"
#include "linear/nodal_multigrid.hpp"
#include "linear/thyra_operator.hpp"
#include "multigrid/nodal_coarsening.hpp"
#include "params/nearest.hpp"

namespace tunica::linear {

namespace {

/// Hands named operators to Teko.
class Callback : public Teko::RequestCallback<Teko::LinearOp> {
public:
  explicit Callback(const NamedOperators& operators) : operators_(&operators) {}

  bool handlesRequest(const Teko::RequestMesg& message) override {
    const auto names = operators_->operator_names();
    return std::find(names.begin(), names.end(), message.getName()) != names.end();
  }
  void preRequest(const Teko::RequestMesg&) override {}
  Teko::LinearOp request(const Teko::RequestMesg& message) override {
    return thyra_operator(operators_->assemble_operator(message.getName()));
  }

private:
  const NamedOperators* operators_;
};

/// Every strategy and inverse that a library can hold.
std::string known_types(const Teuchos::RCP<Stratimikos::DefaultLinearSolverBuilder>& builder) {
  std::vector<std::string> strategies;
  Teko::PreconditionerFactory::getPreconditionerFactoryNames(strategies);
  std::vector<std::string> inverses;
  const auto valid = builder->getValidParameters();
  for (const char* kind : {"Linear Solver Types", "Preconditioner Types"}) {
    const Teuchos::ParameterList& list = valid->sublist(kind);
    for (auto it = list.begin(); it != list.end(); ++it) inverses.push_back(list.name(it));
  }
  std::sort(strategies.begin(), strategies.end());
  std::sort(inverses.begin(), inverses.end());
  return "Strategies: " + params::quoted(strategies) + ".\nInverses: " + params::quoted(inverses) +
         ".";
}

/// Hands the nodes of the blocks to "Nodal Multigrid".
class NodesCallback : public Teko::RequestCallback<Teuchos::RCP<multigrid::NodalCoarsening>> {
public:
  explicit NodesCallback(const Teuchos::RCP<const CrsMatrix>& nodes)
      : nodes_(Teuchos::rcp(new multigrid::NodalCoarsening(nodes))) {}

  bool handlesRequest(const Teko::RequestMesg& message) override {
    return message.getName() == "Nodal Coarsening";
  }
  void preRequest(const Teko::RequestMesg&) override {}
  Teuchos::RCP<multigrid::NodalCoarsening> request(const Teko::RequestMesg&) override {
    return nodes_;
  }

private:
  Teuchos::RCP<multigrid::NodalCoarsening> nodes_;
};

/// Builds the inverse that the list asks for once, without a matrix, so that wrong names are
/// found before anything is solved.
void check_teko_list(Teuchos::ParameterList stratimikos,
                     const Teuchos::RCP<Stratimikos::DefaultLinearSolverBuilder>& builder,
                     const Teuchos::RCP<Teko::RequestHandler>& handler) {
  const auto kind = stratimikos.get<std::string>("Preconditioner Type", "");
  TUNICA_CHECK(kind == "Teko", "\"Preconditioner Type\" is \"" + kind +
                                   "\", expected \"Teko\": the matrix is one of blocks.");
  Teuchos::ParameterList& teko = stratimikos.sublist("Preconditioner Types").sublist("Teko");
  const auto name = teko.get<std::string>("Inverse Type", "Amesos2");
  std::string cause;
  try {
    const auto library = Teko::InverseLibrary::buildFromParameterList(
        teko.sublist("Inverse Factory Library"), builder);
    library->setRequestHandler(handler);
    if (library->getInverseFactory(name).is_null()) cause = "no such inverse";
  } catch (const std::exception& error) {
    cause = error.what();
    // Teko prints the telling half of its message itself and throws its source lines.
    if (cause.find("Throw number") != std::string::npos) cause = "Teko has said why.";
  }
  TUNICA_CHECK(cause.empty(), "the inverse \"" + name + "\" cannot be built: " + cause + "\n" +
                                  known_types(builder));
}

/// A builder that knows MueLu and Ifpack2; the strategies of ours are registered with it.
/// Teko copies the builder, so that it must come last.
Teuchos::RCP<Stratimikos::DefaultLinearSolverBuilder> make_builder() {
  register_lu_strategies();
  register_nodal_multigrid();
  const auto builder = Teuchos::rcp(new Stratimikos::DefaultLinearSolverBuilder);
  Stratimikos::enableMueLu<LocalOrdinal, GlobalOrdinal, Node>(*builder);
  builder->setPreconditioningStrategyFactory(
      Teuchos::abstractFactoryStd<Thyra::PreconditionerFactoryBase<double>,
                                  Thyra::Ifpack2PreconditionerFactory<CrsMatrix>>(),
      "Ifpack2", true);
  return builder;
}

}  // namespace

struct BlockPreconditioner::Stack {
  Teuchos::RCP<Stratimikos::DefaultLinearSolverBuilder> builder = make_builder();
  Teuchos::RCP<Thyra::PreconditionerFactoryBase<double>> factory;
  Teuchos::RCP<Thyra::PreconditionerBase<double>> preconditioner;
  Teko::LinearOp K;
  Teuchos::RCP<const Thyra::TpetraVectorSpace<Scalar, LocalOrdinal, GlobalOrdinal, Node>> u, p;
  Teuchos::RCP<const Thyra::DefaultProductVectorSpace<double>> product;

  Teuchos::RCP<Thyra::DefaultProductMultiVector<double>> view(
      const Teuchos::RCP<MultiVector>& xu, const Teuchos::RCP<MultiVector>& xp) const {
    const auto wrap = [](const Teuchos::RCP<MultiVector>& x, const auto& space) {
      const Teuchos::RCP<const Thyra::VectorSpaceBase<double>> base = space;
      return Teuchos::RCP<Thyra::MultiVectorBase<double>>(
          Thyra::createMultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>(x, base));
    };
    return Thyra::defaultProductMultiVector<double>(product,
                                                    Teuchos::tuple(wrap(xu, u), wrap(xp, p)));
  }
};

BlockPreconditioner::BlockPreconditioner(const Teuchos::ParameterList& stratimikos,
                                         const fields::BlockOperator& K,
                                         const NamedOperators& operators)
    : blocks_(K.mesh()), stack_(Teuchos::rcp(new Stack)) {
  using Space = Thyra::TpetraVectorSpace<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  auto& builder = *stack_->builder;
  const auto handler = Teuchos::rcp(new Teko::RequestHandler);
  handler->addRequestCallback(Teuchos::rcp(new Callback(operators)));
  handler->addRequestCallback(Teuchos::rcp(new NodesCallback(K.mC)));
  Teko::addTekoToStratimikosBuilder(builder, handler);
  check_teko_list(stratimikos, stack_->builder, handler);
  builder.setParameterList(Teuchos::rcp(new Teuchos::ParameterList(stratimikos)));
  stack_->factory = builder.createPreconditioningStrategy("");

  Teko::BlockedLinearOp blocks = Teko::createBlockedOp();
  Teko::beginBlockFill(blocks, 2, 2);
  Teko::setBlock(0, 0, blocks, thyra_operator(K.A));
  Teko::setBlock(0, 1, blocks, thyra_operator(K.B1T));
  Teko::setBlock(1, 0, blocks, thyra_operator(K.B2));
  Teko::setBlock(1, 1, blocks, thyra_operator(K.mC));
  Teko::endBlockFill(blocks);
  stack_->K = blocks;
  stack_->u = Teuchos::rcp_dynamic_cast<const Space>(
      Thyra::createVectorSpace<double, LocalOrdinal, GlobalOrdinal, Node>(K.mesh().vector_map));
  stack_->p = Teuchos::rcp_dynamic_cast<const Space>(
      Thyra::createVectorSpace<double, LocalOrdinal, GlobalOrdinal, Node>(K.mesh().node_map));
  stack_->product = Thyra::productVectorSpace<double>(
      Teuchos::tuple<Teuchos::RCP<const Thyra::VectorSpaceBase<double>>>(stack_->u, stack_->p));
  stack_->preconditioner = stack_->factory->createPrec();
}

BlockPreconditioner::~BlockPreconditioner() = default;

void check_block_preconditioner(const Teuchos::ParameterList& stratimikos) {
  check_teko_list(stratimikos, make_builder(), Teuchos::null);
}

void BlockPreconditioner::refresh() {
  Thyra::initializePrec<double>(*stack_->factory, stack_->K, stack_->preconditioner.ptr());
}

void BlockPreconditioner::apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode,
                                Scalar alpha, Scalar beta) const {
  if (mode != Teuchos::NO_TRANS) throw std::logic_error("BlockPreconditioner: no transpose");
  const auto x = stack_->view(blocks_.vector_part(X), blocks_.scalar_part(X));
  const auto y = stack_->view(blocks_.vector_part(Y), blocks_.scalar_part(Y));
  const auto P = stack_->preconditioner->getUnspecifiedPrecOp();
  Thyra::apply<double>(*P, Thyra::NOTRANS, *x, y.ptr(), alpha, beta);
}

Teuchos::ParameterList default_block_preconditioner() {
  Teuchos::ParameterList list("Stratimikos");
  list.set("Preconditioner Type", "Teko");
  Teuchos::ParameterList& teko = list.sublist("Preconditioner Types").sublist("Teko");
  teko.set("Inverse Type", "Block LU");
  Teuchos::ParameterList& library = teko.sublist("Inverse Factory Library");
  library.sublist("Block LU")
      .set("Type", "LU Upper")
      .set("Inverse Velocity Type", "Incomplete Factors")
      .set("Schur Complement", "Algebraic")
      .set("Inverse Schur Type", "Incomplete Factors");
  // MueLu's cycles are one word away, but at the time steps of a pulse A is mostly mass, and on
  // the wide stencil of the algebraic Schur complement their aggregates come out too large: on
  // the wall of the coarse tube BiCGStab takes 35 iterations with them, 10 with these factors.
  library.sublist("Incomplete Factors")
      .set("Type", "Ifpack2")
      .set("Prec Type", "RILUK")
      .set("Overlap", 0);
  return list;
}

}  // namespace tunica::linear
