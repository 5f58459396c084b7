#include "tunica/linear/block_preconditioner.hpp"

#include <Stratimikos_DefaultLinearSolverBuilder.hpp>
#include <Stratimikos_MueLuHelpers.hpp>
#include <Teko_InverseLibrary.hpp>
#include <Teko_PreconditionerFactory.hpp>
#include <Teko_RequestCallback.hpp>
#include <Teko_RequestHandler.hpp>
#include <Teko_StratimikosFactory.hpp>
#include <Teko_Utilities.hpp>
#include <Teuchos_AbstractFactoryStd.hpp>
#include <Teuchos_VerboseObject.hpp>
#include <Thyra_DefaultProductMultiVector.hpp>
#include <Thyra_DefaultProductVectorSpace.hpp>
#include <Thyra_Ifpack2PreconditionerFactory.hpp>
#include <Thyra_PreconditionerFactoryHelpers.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>
#include <algorithm>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/base/fault_point.hpp"
#include "tunica/base/out_of_memory.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/linear/lu_strategy.hpp"
#include "tunica/linear/nodal_multigrid.hpp"
#include "tunica/linear/schur.hpp"
#include "tunica/linear/setup_failure.hpp"
#include "tunica/linear/thyra_operator.hpp"
#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"
#include "tunica/params/nearest.hpp"

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

/// Tells strategies how many vector unknowns a node has.
class ComponentsCallback : public Teko::RequestCallback<int> {
public:
  explicit ComponentsCallback(int components) : components_(components) {}

  bool handlesRequest(const Teko::RequestMesg& message) override {
    return message.getName() == components_request;
  }
  void preRequest(const Teko::RequestMesg&) override {}
  int request(const Teko::RequestMesg&) override { return components_; }

private:
  int components_;
};

/// Hands the nodes of the blocks to "Nodal Multigrid".
class NodesCallback : public Teko::RequestCallback<Teuchos::RCP<multigrid::MixedCoarsening>> {
public:
  explicit NodesCallback(const algebra::BlockMatrix& K)
      : nodes_(Teuchos::rcp(new multigrid::MixedCoarsening(*K.space()))) {}

  bool handlesRequest(const Teko::RequestMesg& message) override {
    return message.getName() == "Nodal Coarsening";
  }
  void preRequest(const Teko::RequestMesg&) override {}
  Teuchos::RCP<multigrid::MixedCoarsening> request(const Teko::RequestMesg&) override {
    return nodes_;
  }

private:
  Teuchos::RCP<multigrid::MixedCoarsening> nodes_;
};

/// Takes in what Teko prints while this lives: it prints the causes of its failures and throws
/// empty exceptions.
class TekoOutput {
public:
  TekoOutput() : before_(Teuchos::VerboseObjectBase::getDefaultOStream()) {
    Teuchos::VerboseObjectBase::setDefaultOStream(
        Teuchos::fancyOStream(Teuchos::rcpFromRef<std::ostream>(text_)));
  }
  ~TekoOutput() { Teuchos::VerboseObjectBase::setDefaultOStream(before_); }
  TekoOutput(const TekoOutput&) = delete;
  TekoOutput& operator=(const TekoOutput&) = delete;

  /// The innermost cause that was printed, otherwise what the exception says.
  std::string cause_of(const std::exception& error) const {
    const std::string start = "*** THROWN EXCEPTION ***\n", end = "****", text = text_.str();
    const auto from = text.find(start);
    if (from == std::string::npos) return text.empty() ? error.what() : text;
    const auto first = text.find_first_not_of(" \n", from + start.size());
    const auto last = text.find_last_not_of(" \n", text.find(end, first) - 1);
    return text.substr(first, last + 1 - first);
  }

private:
  std::ostringstream text_;
  Teuchos::RCP<Teuchos::FancyOStream> before_;
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
  const TekoOutput output;
  try {
    const auto library = Teko::InverseLibrary::buildFromParameterList(
        teko.sublist("Inverse Factory Library"), builder);
    library->setRequestHandler(handler);
    if (library->getInverseFactory(name).is_null()) cause = "no such inverse";
  } catch (const std::exception& error) {
    if (is_out_of_memory(error)) throw;
    cause = output.cause_of(error);
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
#if TRILINOS_MAJOR_VERSION < 14
  Stratimikos::enableMueLu<LocalOrdinal, GlobalOrdinal, Node>(*builder);
#else
  Stratimikos::enableMueLu<Scalar, LocalOrdinal, GlobalOrdinal, Node>(*builder);
#endif
  builder->setPreconditioningStrategyFactory(
      Teuchos::abstractFactoryStd<Thyra::PreconditionerFactoryBase<double>,
                                  Thyra::Ifpack2PreconditionerFactory<CrsMatrix>>(),
      "Ifpack2", true);
  return builder;
}

/// The blocks as Teko sees them; the matrices are shared. Missing ones stay missing.
Teko::LinearOp blocked_operator(const algebra::BlockMatrix& K) {
  Teko::BlockedLinearOp blocks = Teko::createBlockedOp();
  Teko::beginBlockFill(blocks, K.n_blocks(), K.n_blocks());
  for (int i = 0; i < K.n_blocks(); ++i)
    for (int j = 0; j < K.n_blocks(); ++j)
      if (!K(i, j).is_null()) Teko::setBlock(i, j, blocks, thyra_operator(K(i, j)));
  Teko::endBlockFill(blocks);
  return blocks;
}

}  // namespace

struct BlockPreconditioner::Stack {
  Teuchos::RCP<Stratimikos::DefaultLinearSolverBuilder> builder = make_builder();
  Teuchos::RCP<Thyra::PreconditionerFactoryBase<double>> factory;
  Teuchos::RCP<Thyra::PreconditionerBase<double>> preconditioner;
  Teko::LinearOp K;
  using Space = Teuchos::RCP<const Thyra::VectorSpaceBase<double>>;
  Teuchos::Array<Space> spaces;  ///< of each block
  Teuchos::RCP<const Thyra::DefaultProductVectorSpace<double>> product;

  Teuchos::RCP<Thyra::DefaultProductMultiVector<double>> view(
      const std::vector<Teuchos::RCP<MultiVector>>& parts) const {
    // The blocks are views of a long vector: nothing is copied.
    Teuchos::Array<Teuchos::RCP<Thyra::MultiVectorBase<double>>> blocks;
    for (std::size_t b = 0; b < parts.size(); ++b)
      blocks.push_back(
          Thyra::createMultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>(parts[b], spaces[b]));
    return Thyra::defaultProductMultiVector<double>(product, blocks());
  }
};

// Requests are answered before the list is read: strategies ask for their operators while they are
// built, and one that is not offered fails there.
BlockPreconditioner::BlockPreconditioner(const Teuchos::ParameterList& stratimikos,
                                         const algebra::BlockMatrix& K,
                                         const NamedOperators& operators)
    : blocks_(K.space()), stack_(Teuchos::rcp(new Stack)) {
  auto& builder = *stack_->builder;
  const auto handler = Teuchos::rcp(new Teko::RequestHandler);
  handler->addRequestCallback(Teuchos::rcp(new Callback(operators)));
  handler->addRequestCallback(Teuchos::rcp(new NodesCallback(K)));
  handler->addRequestCallback(Teuchos::rcp(new ComponentsCallback((*K.space())[0].components)));
  Teko::addTekoToStratimikosBuilder(builder, handler);
  check_teko_list(stratimikos, stack_->builder, handler);
  builder.setParameterList(Teuchos::rcp(new Teuchos::ParameterList(stratimikos)));
  stack_->factory = builder.createPreconditioningStrategy("");

  // The operators refer to the matrices of K, whose values they follow.
  stack_->K = blocked_operator(K);
  for (int b = 0; b < K.n_blocks(); ++b)
    stack_->spaces.push_back(
        Thyra::createVectorSpace<double, LocalOrdinal, GlobalOrdinal, Node>((*K.space())[b].map));
  stack_->product = Thyra::productVectorSpace<double>(stack_->spaces());
  stack_->preconditioner = stack_->factory->createPrec();
}

BlockPreconditioner::~BlockPreconditioner() = default;

void check_block_preconditioner(const Teuchos::ParameterList& stratimikos) {
  check_teko_list(stratimikos, make_builder(), Teuchos::null);
}

void BlockPreconditioner::refresh() {
  const auto preconditioner = stack_->preconditioner;
  // Should the set-up fail on one rank, then none keeps what would differ from rank to rank.
  stack_->preconditioner = stack_->factory->createPrec();
  set_up(*blocks_.map()->getComm(), "the block preconditioner", [&] {
    const TekoOutput output;
    try {
      fault_point("block set-up");
      Thyra::initializePrec<double>(*stack_->factory, stack_->K, preconditioner.ptr());
    } catch (const std::exception& error) {
      if (is_out_of_memory(error)) throw;
      throw std::runtime_error(output.cause_of(error));
    }
  });
  stack_->preconditioner = preconditioner;
}

// Y ← α P⁻¹ X + β Y, on views of the blocks
void BlockPreconditioner::apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode,
                                Scalar alpha, Scalar beta) const {
  if (mode != Teuchos::NO_TRANS) throw std::logic_error("BlockPreconditioner: no transpose");
  const auto x = stack_->view(blocks_.parts(X)), y = stack_->view(blocks_.parts(Y));
  const auto P = stack_->preconditioner->getUnspecifiedPrecOp();
  Thyra::apply<double>(*P, Thyra::NOTRANS, *x, y.ptr(), alpha, beta);
}

// P_R = [Ã B1ᵀ; 0 −S̃], with a nodal cycle for Ã⁻¹ and for each inverse in S̃⁻¹
Teuchos::ParameterList default_block_preconditioner(int velocity_sweeps, int schur_sweeps,
                                                    const std::string& schur) {
  Teuchos::ParameterList list("Stratimikos");
  list.set("Preconditioner Type", "Teko");
  Teuchos::ParameterList& teko = list.sublist("Preconditioner Types").sublist("Teko");
  teko.set("Inverse Type", "Block LU");
  Teuchos::ParameterList& library = teko.sublist("Inverse Factory Library");
  library.sublist("Block LU")
      .set("Type", "LU Upper")
      .set("Inverse Velocity Type", "Velocity Cycle")
      .set("Schur Complement", schur)
      .set("Inverse Schur Type", "Pressure Cycle");
  if (schur == "Two Scale") library.sublist("Block LU").set("Inverse Mass Type", "Pressure Cycle");
  library.sublist("Velocity Cycle").set("Type", "Nodal Multigrid").set("Sweeps", velocity_sweeps);
  library.sublist("Pressure Cycle").set("Type", "Nodal Multigrid").set("Sweeps", schur_sweeps);
  return list;
}

}  // namespace tunica::linear
