#include "tunica/multigrid/muelu/nodal_ilu_smoother.hpp"

#include "tunica/multigrid/muelu/validated_choice.hpp"

namespace tunica::multigrid {

Teuchos::RCP<const Teuchos::ParameterList> NodalIluSmoother::GetValidParameterList() const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set<Teuchos::RCP<const MueLu::FactoryBase>>("A", Teuchos::null, "the mixed matrix");
  list->set("sweeps", 1);
  list->set("damping", 1.0);
  list->set("fill", 0);
  list->set<std::string>("precision", "single");
  return list;
}

void NodalIluSmoother::check(const Teuchos::ParameterList& list) const {
  validated_choice("NodalIluSmoother", list, "precision", {"single", "double"});
  if (list.get<int>("sweeps") < 1 || !(list.get<double>("damping") > 0.0))
    throw std::invalid_argument("NodalIluSmoother: \"sweeps\" and \"damping\" must be positive.");
  if (list.get<int>("fill") < 0)
    throw std::invalid_argument("NodalIluSmoother: \"fill\" is negative.");
}

void NodalIluSmoother::set_up(const ::tunica::CrsMatrix& K, const algebra::DofLayout& numbering) {
  const auto& list = GetParameterList();
  factors_ = smoothers::make_node_ilu(
      K, numbering,
      {list.get<int>("fill"), list.get<std::string>("precision") == "single", hosts()});
  factors_->refresh();
}

void NodalIluSmoother::sweep(int n, const ::tunica::MultiVector& b,
                             ::tunica::MultiVector& x) const {
  const double damping = GetParameterList().get<double>("damping");
  for (int i = 0; i < n; ++i) factors_->smooth(damping, b, x);
}

void NodalIluSmoother::smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const {
  sweep(GetParameterList().get<int>("sweeps"), b, x);
}

void NodalIluSmoother::smooth_from_zero(const ::tunica::MultiVector& b,
                                        ::tunica::MultiVector& x) const {
  factors_->smooth_from_zero(GetParameterList().get<double>("damping"), b, x);
  sweep(GetParameterList().get<int>("sweeps") - 1, b, x);
}

Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>>
NodalIluSmoother::Copy() const {
  return Teuchos::rcp(new NodalIluSmoother(*this));
}

std::size_t NodalIluSmoother::getNodeSmootherComplexity() const {
  return static_cast<std::size_t>(factors_->bytes() / sizeof(Scalar));
}

}  // namespace tunica::multigrid
