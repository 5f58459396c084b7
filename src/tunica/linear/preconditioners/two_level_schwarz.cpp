#include "tunica/linear/preconditioners/two_level_schwarz.hpp"

// Each of FROSch's headers needs what those before it declare.
// clang-format off
#include <Xpetra_MapFactory.hpp>
#include <Xpetra_ImportFactory.hpp>
#include <FROSch_Tools_def.hpp>
#include <FROSch_TwoLevelBlockPreconditioner_def.hpp>
// clang-format on

#include "tunica/algebra/dof_layout.hpp"
#include "tunica/base/fault_point.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/io/messages.hpp"
#include "tunica/linear/merged_system.hpp"
#include "tunica/linear/setup_failure.hpp"
#include "tunica/multigrid/muelu/xpetra.hpp"

namespace tunica::linear {

namespace {

using Method = FROSch::TwoLevelBlockPreconditioner<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
using XMap = Xpetra::Map<LocalOrdinal, GlobalOrdinal, Node>;
using XVector = Xpetra::MultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
using XTpetraVector = Xpetra::TpetraMultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

/// Numbers of a merged matrix' unknowns component by component: u_x of all nodes, then u_y, and so
/// on. FROSch wants the unknowns of each block behind those of the one before, and each node of a
/// block to have all of them: with one block for each component, nodes may lack any.
class ComponentNumbers {
public:
  /// dofs: unknowns per node. Collective.
  ComponentNumbers(const Map& merged, int dofs) : first_(dofs + 1, 0) {
    std::vector<GlobalOrdinal> end(dofs, 0);
    for (const GlobalOrdinal number : global_numbers(merged))
      end[number % dofs] = std::max(end[number % dofs], number / dofs + 1);
    for (int k = 0; k < dofs; ++k) {
      const double all = global_max(*merged.getComm(), static_cast<double>(end[k]));
      first_[k + 1] = first_[k] + static_cast<GlobalOrdinal>(all);
    }
  }

  int n_components() const { return static_cast<int>(first_.size()) - 1; }
  /// No node has this one.
  bool is_missing(int component) const { return first_[component] == first_[component + 1]; }

  Teuchos::RCP<const Map> renumbered(const Map& merged) const {
    std::vector<GlobalOrdinal> numbers;
    for (const GlobalOrdinal number : global_numbers(merged))
      numbers.push_back(first_[number % n_components()] + number / n_components());
    return map_of(numbers, merged.getComm());
  }

  /// The nodes of each component that is not missing, of these merged numbers.
  std::vector<std::vector<GlobalOrdinal>> nodes(const std::vector<GlobalOrdinal>& merged) const {
    std::vector<std::vector<GlobalOrdinal>> all(n_components()), present;
    for (const GlobalOrdinal number : merged)
      all[number % n_components()].push_back(number / n_components());
    for (int k = 0; k < n_components(); ++k)
      if (!is_missing(k)) present.push_back(all[k]);
    return present;
  }

private:
  std::vector<GlobalOrdinal> first_;  ///< of each component, and the end of the last
};

/// The unknowns of the rank's subdomain: those of the rank, and of what they are coupled to that of
/// lower ranks, so that each interface is one layer. As FROSch has it for a matrix of which nothing
/// else is known.
struct Subdomain {
  std::vector<GlobalOrdinal> all;     ///< ascend
  std::vector<GlobalOrdinal> shared;  ///< with others
};

/// Collective.
Subdomain subdomain_of(const CrsMatrix& A) {
  const Teuchos::RCP<const Map> rows = A.getRowMap(), columns = A.getColMap();
  const auto numbers = global_numbers(*columns), own = global_numbers(*rows);
  std::vector<int> owners(numbers.size());
  rows->getRemoteIndexList(numbers, Teuchos::arrayViewFromVector(owners));
  Subdomain result;
  Vector taken(columns), times(rows);
  {
    const auto is_taken = taken.getLocalViewHost(overwrite_all);
    for (std::size_t j = 0; j < owners.size(); ++j) {
      is_taken(j, 0) = owners[j] < rows->getComm()->getRank() ? 1.0 : 0.0;
      if (is_taken(j, 0) > 0.0) result.shared.push_back(numbers[j]);
    }
  }
  times.doExport(taken, Import(rows, columns), Tpetra::ADD_ASSIGN);
  result.all = result.shared;
  const auto is_shared = times.getLocalViewHost(read_only);
  for (int i = 0; i < own.size(); ++i) {
    result.all.push_back(own[i]);
    if (is_shared(i, 0) > 0.0) result.shared.push_back(own[i]);
  }
  std::sort(result.all.begin(), result.all.end());
  return result;
}

/// P⁻¹ = Φ (Φᵀ A Φ)⁻¹ Φᵀ + Σ_r R̃_rᵀ A_r⁻¹ R_r: A_r is of rank r and its overlap, R̃_r leaves the
/// overlap out. Φ has the constants of each component on each vertex, edge and face of the
/// interface (GDSW), or functions of the vertices that add up to them (RGDSW), continued into the
/// subdomains by their own A.
class TwoLevelSchwarz final : public MatrixPreconditioner, public Operator {
public:
  TwoLevelSchwarz(const Teuchos::ParameterList& options, const algebra::BlockMatrix& K,
                  const Teuchos::RCP<CrsMatrix>& A)
      : merged_(A), list_(Teuchos::rcp(new Teuchos::ParameterList(options.sublist("FROSch")))),
        comm_(A->getComm()), overlap_(options.get<int>("overlap")) {
    const algebra::DofLayout layout(*K.space());
    dimension_ = layout.components(0) == 2 ? 2 : 3;
    const ComponentNumbers numbers(*A->getRowMap(), layout.dofs());
    rows_ = numbers.renumbered(*A->getRowMap());
    // the same values, with other numbers
    renumbered_ = multigrid::wrapped(Teuchos::rcp(new CrsMatrix(
        A->getLocalMatrixDevice(), rows_, numbers.renumbered(*A->getColMap()), rows_, rows_)));
    choose(options.get<std::string>("coarse space"), layout.dofs());
    const Subdomain subdomain = subdomain_of(*A);
    for (const auto& nodes : numbers.nodes(subdomain.all))
      subdomain_.push_back(map_of(nodes, comm_));
    for (const auto& nodes : numbers.nodes(subdomain.shared)) {
      const auto n = static_cast<double>(nodes.size());
      has_lone_rank_ |= global_min(*comm_, n) == 0.0 && global_max(*comm_, n) > 0.0;
    }
  }

  void refresh() override {
    if (has_lone_rank_)  // FROSch would wait there for what the others do not send
      throw SetupFailure(
          "the two levels cannot be set up: a rank shares no unknown of a component "
          "with others, which FROSch does not permit");
    set_up(*comm_, "the two levels", [this] {
      fault_point("schwarz set-up");
      const io::SilentOutput silent;  // FROSch prints tables without being asked
      if (method_.is_null())
        initialize();
      else
        method_->resetMatrix(renumbered_);
      method_->compute();
    });
  }
  Teuchos::RCP<const Operator> as_operator() const override { return Teuchos::rcpFromRef(*this); }

  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode, Scalar alpha,
             Scalar beta) const override {
    const auto renumbered = [this](const MultiVector& V) {
      return XTpetraVector(const_cast<MultiVector&>(V).offsetViewNonConst(rows_, 0));
    };
    const XTpetraVector x = renumbered(X);
    XTpetraVector y = renumbered(Y);
    method_->apply(x, y, mode, alpha, beta);
  }
  Teuchos::RCP<const Map> getDomainMap() const override { return merged_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return merged_->getRangeMap(); }

private:
  /// What the XML says more comes first.
  void choose(const std::string& space, int dofs) {
    // 13.2's own RGDSWCoarseOperator faults where a subdomain has no root
    const bool is_reduced = space == "RGDSW";
    const std::string kind = is_reduced ? "IPOUHarmonicCoarseOperator" : "GDSWCoarseOperator";
    list_->set("CoarseOperator Type", kind);
    list_->set("Null Space Type", "Input");
    Teuchos::ParameterList& blocks = list_->sublist(kind).sublist("Blocks");
    for (int k = 1; k <= dofs; ++k) {
      Teuchos::ParameterList& block = blocks.sublist(std::to_string(k));
      if (is_reduced)
        block.sublist("InterfacePartitionOfUnity").set("Type", space);
      else
        block.get("Rotations", false);  // there are none of a component
    }
  }

  void initialize() {
    const int n = static_cast<int>(subdomain_.size());
    Teuchos::ArrayRCP<Teuchos::RCP<const XMap>> maps(n);
    Teuchos::ArrayRCP<Teuchos::RCP<const XVector>> constants(n);
    for (int k = 0; k < n; ++k) {
      const auto ones = Teuchos::rcp(new MultiVector(subdomain_[k], 1));
      ones->putScalar(1.0);
      maps[k] = Xpetra::toXpetra(subdomain_[k]);
      constants[k] = Teuchos::rcp(new XTpetraVector(ones));
    }
    method_ = Teuchos::rcp(new Method(renumbered_, list_));
    method_->initialize(dimension_, Teuchos::ArrayRCP<unsigned>(n, 1),
                        Teuchos::ArrayRCP<FROSch::DofOrdering>(n, FROSch::NodeWise), overlap_,
                        Teuchos::ArrayRCP<Teuchos::RCP<const XVector>>(), maps, constants);
  }

  Teuchos::RCP<CrsMatrix> merged_;
  Teuchos::RCP<Teuchos::ParameterList> list_;
  CommPtr comm_;
  int overlap_;
  unsigned dimension_;
  bool has_lone_rank_ = false;
  Teuchos::RCP<const Map> rows_;                    ///< component by component
  std::vector<Teuchos::RCP<const Map>> subdomain_;  ///< nodes of each component
  Teuchos::RCP<const multigrid::XMatrix> renumbered_;
  Teuchos::RCP<Method> method_;
};

params::Table schwarz_table(const SolverDefaults&) {
  params::Table table;
  table
      .choice("coarse space", "GDSW", {"GDSW", "RGDSW"},
              "functions of each vertex, edge and face between subdomains, or fewer of the "
              "vertices alone")
      .integer("overlap", 1, params::between(0, 20), "overlap of subdomains, in graph layers")
      .foreign("FROSch", Teuchos::ParameterList(), Teuchos::ParameterList(),
               "other keys of FROSch's list, as usual in Trilinos");
  return table;
}

}  // namespace

PreconditionerEntry schwarz_preconditioner() {
  return {
      "two-level schwarz", 100.0, schwarz_table,
      [](const Teuchos::ParameterList& list, const algebra::BlockMatrix& K, const NamedOperators&) {
        return std::make_unique<MergedSystem>(K, [&](const Teuchos::RCP<CrsMatrix>& A) {
          return std::make_unique<TwoLevelSchwarz>(list, K, A);
        });
      }};
}

}  // namespace tunica::linear
