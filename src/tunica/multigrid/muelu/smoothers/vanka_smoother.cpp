#include "tunica/multigrid/muelu/smoothers/vanka_smoother.hpp"

namespace tunica::multigrid {

namespace {

std::string choice(const Teuchos::ParameterList& list, const std::string& key,
                   const std::vector<std::string>& known) {
  return validated_choice("VankaSmoother", list, key, known);
}

smoothers::VankaOptions options_of(const Teuchos::ParameterList& list) {
  smoothers::VankaOptions options;
  options.sweeps = list.get<int>("sweeps");
  options.damping = list.get<double>("damping");
  options.order = choice(list, "order", {"forward", "backward", "symmetric"});
  options.is_additive = choice(list, "combine", {"multiplicative", "additive"}) == "additive";
  options.is_single = choice(list, "precision", {"double", "single"}) == "single";
  options.patch = choice(list, "patch", {"full", "diagonal", "node pair"});
  if (options.sweeps < 1 || !(options.damping > 0.0))
    throw std::invalid_argument("VankaSmoother: \"sweeps\" and \"damping\" must be positive.");
  return options;
}

}  // namespace

Teuchos::RCP<const Teuchos::ParameterList> VankaSmoother::GetValidParameterList() const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set<Teuchos::RCP<const MueLu::FactoryBase>>("A", Teuchos::null, "the mixed matrix");
  list->set("sweeps", 1);
  list->set("damping", 1.0);
  list->set<std::string>("order", "symmetric");
  list->set<std::string>("combine", "multiplicative");
  list->set<std::string>("precision", "double");
  list->set<std::string>("patch", "full");
  return list;
}

void VankaSmoother::check(const Teuchos::ParameterList& list) const { options_of(list); }

// Patches are made of places, where a vertex has all its pressures beside its velocity.
void VankaSmoother::set_up(const ::tunica::CrsMatrix& K, const algebra::DofLayout& numbering) {
  vanka_ = smoothers::make_vanka(K, smoothers::mixed_rows(K, numbering, hosts()),
                                 options_of(GetParameterList()));
  vanka_->refresh();
}

void VankaSmoother::smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const {
  vanka_->smooth(b, x);
}

Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>>
VankaSmoother::Copy() const {
  return Teuchos::rcp(new VankaSmoother(*this));
}

std::size_t VankaSmoother::getNodeSmootherComplexity() const {
  return static_cast<std::size_t>(vanka_->bytes() / sizeof(Scalar));
}

}  // namespace tunica::multigrid
