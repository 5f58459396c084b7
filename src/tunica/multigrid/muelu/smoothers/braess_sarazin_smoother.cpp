#include "tunica/multigrid/muelu/smoothers/braess_sarazin_smoother.hpp"

#include "tunica/base/trilinos.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"

namespace tunica::multigrid {

namespace {

// Ã = s diag(A): "scaling" is s, or 0 for what the spectrum of A wants, "damping" the ω of the
// whole correction.
smoothers::BraessSarazinOptions options_of(const Teuchos::ParameterList& list) {
  smoothers::BraessSarazinOptions options;
  options.sweeps = list.get<int>("sweeps");
  options.scaling = list.get<double>("scaling");
  options.damping = list.get<double>("damping");
  options.schur = validated_choice("NodalBraessSarazinSmoother", list, "schur",
                                   {"gauss-seidel", "chebyshev", "multigrid", "direct"});
  options.schur_sweeps = list.get<int>("schur sweeps");
  const bool is_valid = options.sweeps > 0 && options.schur_sweeps > 0 && options.scaling >= 0.0 &&
                        options.damping > 0.0;
  if (!is_valid)
    throw std::invalid_argument(
        "NodalBraessSarazinSmoother: \"sweeps\", \"schur sweeps\" and \"damping\" must be "
        "positive, "
        "and \"scaling\" not negative.");
  return options;
}

constexpr int coarsest_schur = 200;  ///< unknowns

/// Coarse nodes for S from the graph of C.
Teuchos::RCP<MixedCoarsening> coarsening_of(const Teuchos::RCP<::tunica::CrsMatrix>& S,
                                            const Teuchos::RCP<const ::tunica::CrsMatrix>& nodes) {
  // S = C + B2 Ã⁻¹ B1ᵀ couples neighbours of neighbours as well. On the graph of C, which is that
  // of the mesh, more nodes stay from level to level.
  const auto order = Teuchos::rcp(new ::tunica::Vector(nodes->getRowMap()));
  for (const GlobalOrdinal row : global_numbers(*nodes->getRowMap()))
    order->replaceGlobalValue(row, static_cast<Scalar>(row));
  return Teuchos::rcp(new MixedCoarsening(
      algebra::BlockSpace({{"scalar", S->getRowMap(), 1, {nodes->getCrsGraph(), order}}})));
}

/// One multigrid cycle for S.
class SchurCycle final : public smoothers::SchurSolver {
public:
  SchurCycle(const Teuchos::RCP<::tunica::CrsMatrix>& S,
             const Teuchos::RCP<const ::tunica::CrsMatrix>& nodes, int sweeps)
      : cycle_(S, coarsening_of(S, nodes), nodal_cycle_list(sweeps, coarsest_schur, false)) {}

  void refresh() override { cycle_.refresh(); }
  void solve(const ::tunica::MultiVector& r, ::tunica::MultiVector& q) const override {
    cycle_.apply(r, q);
  }

private:
  Cycle cycle_;
};

}  // namespace

Teuchos::RCP<const Teuchos::ParameterList> NodalBraessSarazinSmoother::GetValidParameterList()
    const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set<Teuchos::RCP<const MueLu::FactoryBase>>("A", Teuchos::null, "the mixed matrix");
  list->set("sweeps", 1);
  list->set("scaling", 0.0);
  list->set("damping", 1.0);
  list->set<std::string>("schur", "gauss-seidel");
  list->set("schur sweeps", 2);
  return list;
}

void NodalBraessSarazinSmoother::check(const Teuchos::ParameterList& list) const {
  options_of(list);
}

void NodalBraessSarazinSmoother::set_up(const ::tunica::CrsMatrix& K,
                                        const algebra::DofLayout& numbering) {
  const smoothers::BraessSarazinOptions options = options_of(GetParameterList());
  // A cycle belongs to multigrid/, which smoothers/ does without: it is handed over as a function.
  smoothers::MakeSchurSolver cycle;
  if (options.schur == "multigrid")
    cycle = [&options](const auto& S, const auto& nodes) {
      return std::make_unique<SchurCycle>(S, nodes, options.schur_sweeps);
    };
  smoother_ = std::make_shared<smoothers::BraessSarazin>(K, numbering, options, cycle);
}

void NodalBraessSarazinSmoother::smooth(const ::tunica::MultiVector& b,
                                        ::tunica::MultiVector& x) const {
  smoother_->smooth(b, x);
}

Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>>
NodalBraessSarazinSmoother::Copy() const {
  return Teuchos::rcp(new NodalBraessSarazinSmoother(*this));
}

}  // namespace tunica::multigrid
