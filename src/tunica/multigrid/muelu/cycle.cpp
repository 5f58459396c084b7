#include "tunica/multigrid/muelu/cycle.hpp"

#include <MueLu_Exceptions.hpp>
#include <MueLu_Hierarchy.hpp>
#include <MueLu_ParameterListInterpreter.hpp>
#include <Teuchos_DefaultSerialComm.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tunica/algebra/columns.hpp"
#include "tunica/algebra/is_diagonal.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/out_of_memory.hpp"
#include "tunica/multigrid/coarsening/matrix_coarsening.hpp"
#include "tunica/multigrid/muelu/blocked_matrix.hpp"
#include "tunica/multigrid/muelu/factory_factory.hpp"
#include "tunica/multigrid/muelu/galerkin_factory.hpp"
#include "tunica/multigrid/muelu/matrix_kind.hpp"
#include "tunica/multigrid/muelu/nodal_p_factory.hpp"
#include "tunica/multigrid/muelu/smoothers/nodal_ilu_smoother.hpp"
#include "tunica/multigrid/muelu/xpetra.hpp"
#include "tunica/params/nearest.hpp"

namespace tunica::multigrid {

namespace {

using Interpreter = MueLu::ParameterListInterpreter<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
using Hierarchy = MueLu::Hierarchy<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
using Smoother = MueLu::SmootherBase<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
using Wrapper = Xpetra::TpetraMultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

/// Levels from which on W cycles pay. With V cycles each level adds its error to those below:
/// Stokes flow in the plane takes 8 iterations with four levels, 17 with six, and 8 again with W
/// cycles.
constexpr int deep = 4;

/// Operator complexity up to which they pay: MAC's first coarse level, with 4.1, has more entries
/// than the finest, and a second visit costs more than it saves.
constexpr double most_complex = 2.5;

/// flatness_of_solids from which on W cycles pay on fewer levels: coarse levels of flat elements
/// need more than one visit. Iterations and CPU time of walls with V and W: width over thickness
/// 25, flatness 25, 22 and 18, 5.2 and 5.4 s; six layers of 15, 52 and 44, 7.1 and 6.8 s. With
/// flatness 6 W takes 9 % of the iterations away and 8 % longer.
constexpr double flat = 10.0;

/// Iterations that tell how well a cycle contracts.
constexpr int telling = 8;

constexpr const char* rotations = NodalPFactory::rotations;
constexpr const char* rotations_from = NodalPFactory::rotations_from;

bool waits_with_rotations(const Teuchos::ParameterList& factory) {
  return factory.isType<double>(rotations_from) && factory.get<double>(rotations_from) > 0.0 &&
         factory.isType<bool>(rotations) && factory.get<bool>(rotations);
}

/// Whether a list's "Hierarchy" lets deep levels have W cycles.
bool may_have_w_cycles(const Teuchos::ParameterList& hierarchy) {
  if (!hierarchy.isParameter(Cycle::w_cycles)) return true;
  TUNICA_CHECK(
      hierarchy.isType<bool>(Cycle::w_cycles),
      "Hierarchy: \"" + std::string(Cycle::w_cycles) + "\" has another type, expected bool.");
  return hierarchy.get<bool>(Cycle::w_cycles);
}

/// The largest of the list's factories; 0 where none waits.
double contraction_for_rotations(const Teuchos::ParameterList& muelu) {
  double largest = 0.0;
  if (!muelu.isSublist("Factories")) return largest;
  const Teuchos::ParameterList& factories = muelu.sublist("Factories");
  for (const auto& entry : factories)
    if (factories.isSublist(entry.first) && waits_with_rotations(factories.sublist(entry.first)))
      largest = std::max(largest, factories.sublist(entry.first).get<double>(rotations_from));
  return largest;
}

const std::string cannot_work_on_blocks =
    "a smoother or another factory of the list cannot work on a matrix of blocks: ";

std::vector<std::string> names_of_ours() {
  std::vector<std::string> names;
  for (const FactoryEntry& entry : our_factories()) names.push_back(entry.name);
  std::sort(names.begin(), names.end());
  return names;
}

/// What must follow new values, in this order; empty where a part cannot.
std::vector<algebra::Refreshable*> parts_to_refresh(Hierarchy& hierarchy) {
  // Coarse matrices from the finest on, as each is made of the one before; then smoothers, each
  // once, since one may stand before and behind the coarse correction.
  std::vector<algebra::Refreshable*> parts;
  for (int l = 1; l < hierarchy.GetNumLevels(); ++l) {
    MueLu::Level& level = *hierarchy.GetLevel(l);
    parts.push_back(galerkin_product(level).get());
    if (parts.back() == nullptr || !NodalPFactory::made_prolongator_of(level)) return {};
  }
  for (int l = 0; l < hierarchy.GetNumLevels(); ++l)
    for (const char* name : {"PreSmoother", "PostSmoother"}) {
      MueLu::Level& level = *hierarchy.GetLevel(l);
      if (!level.IsAvailable(name)) continue;
      const auto smoother = level.Get<Teuchos::RCP<Smoother>>(name);
      if (smoother.is_null()) continue;
      auto* const part = dynamic_cast<algebra::Refreshable*>(smoother.get());
      if (part == nullptr) return {};
      if (std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(part);
    }
  return parts;
}

}  // namespace

struct Cycle::Parts {
  Teuchos::RCP<Hierarchy> hierarchy;
  std::vector<algebra::Refreshable*> refreshable;
  Levels levels;
};

Cycle::Cycle(const Teuchos::RCP<CrsMatrix>& A, const Teuchos::RCP<MixedCoarsening>& coarsening,
             const Teuchos::ParameterList& muelu, bool is_blocked)
    : A_(A), coarsening_(coarsening), muelu_(muelu), is_blocked_(is_blocked),
      rotations_from_(contraction_for_rotations(muelu)) {
  check_matrix_kind(muelu, is_blocked);
  set_up();
}

Cycle::Cycle(const Teuchos::RCP<CrsMatrix>& A, int components, const Teuchos::ParameterList& muelu)
    : Cycle(A, make_coarsening(*A, components), muelu) {}

Cycle::~Cycle() = default;

Teuchos::ParameterList Cycle::present_list() const {
  Teuchos::ParameterList list(muelu_);
  list.sublist("Hierarchy").remove(w_cycles, false);
  if (!(rotations_from_ > 0.0) || has_rotations_) return list;
  Teuchos::ParameterList& factories = list.sublist("Factories");
  for (const auto& entry : muelu_.sublist("Factories"))
    if (factories.isSublist(entry.first) && waits_with_rotations(factories.sublist(entry.first)))
      factories.sublist(entry.first).set(rotations, false);
  return list;
}

// The levels as the list has them.
void Cycle::set_up() {
  parts_ = std::make_unique<Parts>();
  Teuchos::ParameterList list = present_list();
  Teuchos::ParameterList& levels = list.sublist("Hierarchy");
  // Nothing is coarse about a diagonal: its factors are exact.
  if (!is_blocked_ && algebra::is_diagonal(*A_)) levels.set("max levels", 1);
  Interpreter interpreter(list, A_->getComm(), make_factory_factory(coarsening_));
  parts_->hierarchy = interpreter.CreateHierarchy();
  Hierarchy& hierarchy = *parts_->hierarchy;
  hierarchy.setlib(Xpetra::UseTpetra);
  try {
    if (is_blocked_)
      set_blocks(*hierarchy.GetLevel(0), *A_, coarsening_->numbering());
    else
      hierarchy.GetLevel(0)->Set<Teuchos::RCP<XMatrix>>("A", Teuchos::rcp(new LevelMatrix(A_)));
    interpreter.SetupHierarchy(hierarchy);
    hierarchy.IsPreconditioner(true);
    // MueLu factors the coarsest matrix when it is first needed: a singular one must fail here.
    MultiVector zero(A_->getRangeMap(), 1), nothing(A_->getDomainMap(), 1);
    iterate(zero, nothing);
  } catch (const std::bad_cast& error) {
    if (!is_blocked_) throw;
    throw std::runtime_error(cannot_work_on_blocks + error.what());
  } catch (const MueLu::Exceptions::BadCast& error) {
    if (!is_blocked_) throw;
    throw std::runtime_error(cannot_work_on_blocks + error.what());
  }
  // Matrices of blocks are copies, which follow by a new set-up only.
  if (!is_blocked_) parts_->refreshable = parts_to_refresh(hierarchy);
  parts_->levels = count_levels();
  choose_cycle_type();
}

// Unless the list says which. MueLu counts the levels from which it returns twice: up to level 1
// are two visits of the first coarse level, and four of those below.
void Cycle::choose_cycle_type() {
  const Teuchos::ParameterList& levels = muelu_.sublist("Hierarchy");
  if (levels.isParameter("cycle type")) return;
  const bool is_deep = may_have_w_cycles(levels) && parts_->hierarchy->GetNumLevels() >= deep &&
                       parts_->levels.operator_complexity <= most_complex;
  parts_->levels.is_w_cycle = is_deep || coarsening_->flatness() > flat;
  parts_->hierarchy->SetCycle(parts_->levels.is_w_cycle ? MueLu::WCYCLE : MueLu::VCYCLE);
  if (is_deep) parts_->hierarchy->SetCycleStartLevel(1);
}

void Cycle::iterate(const MultiVector& b, MultiVector& x) const {
  // Xpetra asks for a vector it may change; MueLu leaves right sides alone.
  const Wrapper wrapped_b(Teuchos::rcpFromRef(const_cast<MultiVector&>(b)));
  Wrapper wrapped_x(Teuchos::rcpFromRef(x));
  // One cycle, from x = 0
  parts_->hierarchy->Iterate(wrapped_b, wrapped_x, 1, true);
}

// Numeric work where all parts can follow; else, graphs included, all anew.
void Cycle::refresh() {
  iterations_ = 0;
  logarithm_ = 0.0;
  const bool turns = wants_rotations_ && !has_rotations_;
  has_rotations_ = wants_rotations_;
  if (turns || !keeps_graphs()) return set_up();
  for (algebra::Refreshable* part : parts_->refreshable) part->refresh();
  parts_->levels.smoothers = smoother_states();
}

bool Cycle::keeps_graphs() const { return !parts_->refreshable.empty(); }

void Cycle::apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode, Scalar alpha,
                  Scalar beta) const {
  if (mode != Teuchos::NO_TRANS) throw std::logic_error("Cycle: no transpose");
  algebra::check_columns("Cycle", X, Y);
  // Y ← α M⁻¹ X + β Y
  if (alpha == 1.0 && beta == 0.0) return iterate(X, Y);
  MultiVector result(Y.getMap(), Y.getNumVectors());
  iterate(X, result);
  Y.update(alpha, result, beta);
}

const Levels& Cycle::levels() const { return parts_->levels; }

// Of a matrix of blocks, a merged copy.
Teuchos::RCP<const CrsMatrix> Cycle::matrix(int level) const {
  const auto A = parts_->hierarchy->GetLevel(level)->Get<Teuchos::RCP<XMatrix>>("A");
  return unwrapped(is_blocked_ ? Teuchos::rcp_dynamic_cast<XBlockedMatrix>(A, true)->Merge() : A);
}

std::vector<NodalIluSmoother*> Cycle::ilu_smoothers() const {
  std::vector<NodalIluSmoother*> smoothers;
  for (int l = 0; l < parts_->hierarchy->GetNumLevels(); ++l) {
    MueLu::Level& level = *parts_->hierarchy->GetLevel(l);
    if (!level.IsAvailable("PreSmoother")) continue;
    const auto smoother = level.Get<Teuchos::RCP<Smoother>>("PreSmoother");
    if (auto* const ilu = dynamic_cast<NodalIluSmoother*>(smoother.get())) smoothers.push_back(ilu);
  }
  return smoothers;
}

std::vector<SmootherState> Cycle::smoother_states() const {
  std::vector<SmootherState> states;
  for (const NodalIluSmoother* smoother : ilu_smoothers()) states.push_back(smoother->state());
  return states;
}

// ρ = (Π_s |r|/|b|)^(1/Σ_s m_s) over the solves s, of m_s iterations, since the last set-up
bool Cycle::note(int iterations, double reduction) {
  if (!(rotations_from_ > 0.0) || !(reduction > 0.0)) return false;
  iterations_ += iterations;
  logarithm_ += std::log(reduction);
  if (iterations_ >= telling && logarithm_ > iterations_ * std::log(rotations_from_))
    wants_rotations_ = true;
  return wants_rotations_ && !has_rotations_;
}

// Whether rotations are wanted, then three numbers a level. Smoothers of a cycle that is set up
// anew each time learn nothing.
std::vector<double> Cycle::memory() const {
  std::vector<double> numbers = {wants_rotations_ ? 1.0 : 0.0};
  if (wants_rotations_ && !has_rotations_) return numbers;  // all else will be new
  bool is_fresh = !wants_rotations_;
  for (const NodalIluSmoother* smoother : ilu_smoothers()) {
    const NodalIluSmoother::Memory& memory = smoother->memory();
    is_fresh = is_fresh && NodalIluSmoother::is_fresh(memory);
    for (const int number : {memory.attempt, memory.refreshes, memory.patience})
      numbers.push_back(number);
  }
  if (is_fresh || (!wants_rotations_ && !keeps_graphs())) return {};
  return numbers;
}

void Cycle::recall(const std::vector<double>& memory) {
  if (memory.empty()) return;
  wants_rotations_ = memory.front() != 0.0;
  if (wants_rotations_ && !has_rotations_) {
    has_rotations_ = true;
    set_up();
  }
  const std::vector<NodalIluSmoother*> smoothers = ilu_smoothers();
  if (memory.size() != 1 + 3 * smoothers.size() || !keeps_graphs()) return;
  for (std::size_t k = 0; k < smoothers.size(); ++k) {
    const auto number = [&](std::size_t i) { return static_cast<int>(memory[1 + 3 * k + i]); };
    smoothers[k]->recall({number(0), number(1), number(2)});
  }
}

// Operator complexity: Σ_l nnz(A_l) / nnz(A_0).
Levels Cycle::count_levels() const {
  Levels levels;
  double finest = 0.0, all = 0.0;
  for (int l = 0; l < parts_->hierarchy->GetNumLevels(); ++l) {
    const auto A = matrix(l);
    levels.unknowns.push_back(static_cast<long long>(A->getGlobalNumRows()));
    all += static_cast<double>(A->getGlobalNumEntries());
    if (l == 0) finest = all;
  }
  levels.operator_complexity = all / finest;
  levels.smoothers = smoother_states();
  return levels;
}

void check_cycle_list(const Teuchos::ParameterList& muelu, bool is_blocked) {
  Teuchos::ParameterList list(muelu);
  TUNICA_CHECK(list.isSublist("Hierarchy") && list.isSublist("Factories"),
               "the list lacks \"Factories\" or \"Hierarchy\"; a mixed matrix needs a MueLu list "
               "in the form of factories.");
  may_have_w_cycles(list.sublist("Hierarchy"));
  // The interpreter builds all factories, and throws at a name or a key that none has.
  std::string cause;
  try {
    const Interpreter interpreter(list, Teuchos::rcp(new Teuchos::SerialComm<int>),
                                  make_factory_factory(Teuchos::null));
  } catch (const std::exception& error) {
    if (is_out_of_memory(error)) throw;
    cause = error.what();
  }
  // Of MueLu's long message the name counts.
  const auto found = cause.find("unknown factory name : ");
  if (found != std::string::npos)
    cause = cause.substr(found, cause.find('\n', found) - found) + ". Ours are " +
            params::quoted(names_of_ours()) + ", the others are those of MueLu's user's guide.";
  TUNICA_CHECK(cause.empty(), cause);
  check_matrix_kind(muelu, is_blocked);
}

}  // namespace tunica::multigrid
