#include "tunica/linear/preconditioners/field_by_field.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>

#include "tunica/algebra/columns.hpp"
#include "tunica/algebra/concatenation.hpp"
#include "tunica/algebra/sub_system.hpp"
#include "tunica/base/error.hpp"
#include "tunica/linear/concatenated_system.hpp"
#include "tunica/linear/linear_solver.hpp"
#include "tunica/params/known_keys.hpp"

namespace tunica::linear {

namespace {

std::vector<std::string> strings(const Teuchos::ParameterList& list, const char* key) {
  const auto& array = list.get<Teuchos::Array<std::string>>(key);
  return {array.begin(), array.end()};
}

/// Some parts of a coupled system, with what solves for them.
class Field : public NamedOperators {
public:
  Field(const Teuchos::ParameterList& list, const algebra::BlockMatrix& K,
        const NamedOperators& operators)
      : system_(K, strings(list, "parts")), operators_(&operators),
        own_(list.get<std::string>("own block of")), tolerance_(list.get<double>("tolerance")),
        r_(system_.matrix().zero()), y_(system_.matrix().zero()),
        solver_(make_linear_solver(list, system_.matrix(), *this)) {}

  /// Sets up for the present values of K.
  void refresh() {
    system_.refresh();
    // A_f alone on the interface in place of the sum over the fields: the field as if no other were
    // tied to it.
    if (!own_.empty())
      system_.refresh_block(0, 0, *operators_->assemble_operator(own_block_of(own_)));
    solver_->matrix_changed();
    solver_->prepare();
  }

  LinearSolver& solver() { return *solver_; }

  /// y ← y + ω Rᵀ K_s⁻¹ R r.
  void correct(double damping, const algebra::BlockVector& r, algebra::BlockVector& y) {
    system_.restrict(r, r_);
    solver_->solve(r_, y_, tolerance_);  // not converging is what an inner solver may do
    system_.add(damping, y_, y);
  }

  // NamedOperators: those of the whole system, restricted
  std::vector<std::string> operator_names() const override { return operators_->operator_names(); }
  Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string& name) const override {
    const Teuchos::RCP<const CrsMatrix> whole = operators_->assemble_operator(name);
    if (whole.is_null()) return Teuchos::null;
    // R A Rᵀ
    return system_.pick(*whole);
  }

private:
  algebra::SubSystem system_;
  const NamedOperators* operators_;
  std::string own_;
  double tolerance_;
  algebra::BlockVector r_, y_;
  std::unique_ptr<LinearSolver> solver_;
};

/// Sweeps over the fields, from zero:
///
///   y ← y + ω R_fᵀ K_f⁻¹ R_f (x − K y)      for each field f in turn, and back again
class FieldSweeps final : public Operator {
public:
  FieldSweeps(const Teuchos::ParameterList& list, const algebra::BlockMatrix& K,
              const NamedOperators& operators)
      : blocks_(K.space()), K_(&K), sweeps_(list.get<int>("sweeps")),
        damping_(list.get<double>("damping")), is_symmetric_(list.get<bool>("is symmetric")) {
    const Teuchos::ParameterList& fields = list.sublist("Fields");
    check_parts(fields, K.space()->parts(), operators.operator_names());
    for (const auto& entry : fields)
      fields_.push_back(std::make_unique<Field>(fields.sublist(entry.first), K, operators));
  }

  void refresh() {
    for (const auto& field : fields_) field->refresh();
  }

  /// Of each field how many numbers its solver keeps, and these.
  std::vector<double> save() const {
    std::vector<double> all;
    bool is_empty = true;
    for (const auto& field : fields_) {
      const std::vector<double> numbers = field->solver().save();
      is_empty = is_empty && numbers.empty();
      all.push_back(static_cast<double>(numbers.size()));
      all.insert(all.end(), numbers.begin(), numbers.end());
    }
    return is_empty ? std::vector<double>() : all;
  }
  void restore(const std::vector<double>& all) {
    auto next = all.begin();
    for (const auto& field : fields_) {
      const auto left = all.end() - next;
      const auto count =
          left > 0 ? std::min<std::ptrdiff_t>(static_cast<int>(*next++), left - 1) : 0;
      field->solver().restore({next, next + count});
      next += count;
    }
  }

  // Y ← α P⁻¹ X + β Y, column by column
  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode = Teuchos::NO_TRANS,
             Scalar alpha = 1.0, Scalar beta = 0.0) const override {
    if (mode != Teuchos::NO_TRANS) throw std::logic_error("FieldSweeps: no transpose");
    algebra::for_each_column("FieldSweeps", X, Y, [&](const MultiVector& x, MultiVector& y) {
      algebra::BlockVector b(K_->space()), result(K_->space());
      blocks_.scatter(x, b);
      sweep(b, result);
      MultiVector all(y.getMap(), 1);
      blocks_.gather(result, all);
      y.update(alpha, all, beta);
    });
  }
  Teuchos::RCP<const Map> getDomainMap() const override { return blocks_.map(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return blocks_.map(); }

private:
  static void check_parts(const Teuchos::ParameterList& fields,
                          const std::vector<std::string>& known,
                          const std::vector<std::string>& operators) {
    const std::string where = "the preconditioner \"field by field\": ";
    const std::string complaint = params::complaint_about_parts(fields, known);
    TUNICA_CHECK(complaint.empty(), where + complaint);
    for (const auto& entry : fields) {
      const auto& own = fields.sublist(entry.first).get<std::string>("own block of");
      TUNICA_CHECK(
          own.empty() || std::count(operators.begin(), operators.end(), own_block_of(own)) > 0,
          where + "Fields / " + entry.first + ": the system has no own block of \"" + own + "\".");
    }
  }

  void sweep(const algebra::BlockVector& b, algebra::BlockVector& y) const {
    // From y = 0, where the first residual takes no product. On the way back the last field is left
    // out, as it has just been solved for.
    const int n = static_cast<int>(fields_.size());
    bool is_first = true;
    algebra::BlockVector r(K_->space());
    // y ← y + ω R_fᵀ K_f⁻¹ R_f (b − K y)
    const auto correct = [&](int f) {
      r.assign(b);
      if (!is_first) subtract_product(y, r);
      is_first = false;
      fields_[f]->correct(damping_, r, y);
    };
    for (int s = 0; s < sweeps_; ++s) {
      for (int f = 0; f < n; ++f) correct(f);
      for (int f = n - 2; f >= 0 && is_symmetric_; --f) correct(f);
    }
  }

  /// r ← r − K y.
  void subtract_product(const algebra::BlockVector& y, algebra::BlockVector& r) const {
    std::vector<Teuchos::RCP<MultiVector>> from, to;
    for (int b = 0; b < K_->n_blocks(); ++b) {
      from.push_back(Teuchos::rcp_const_cast<Vector>(y.block(b)));
      to.push_back(r.block(b));
    }
    K_->apply_blocks(from, to, -1.0, 1.0);
  }

  algebra::Concatenation blocks_;
  const algebra::BlockMatrix* K_;
  int sweeps_;
  double damping_;
  bool is_symmetric_;
  std::vector<std::unique_ptr<Field>> fields_;
};

class FieldSystem final : public ConcatenatedSystem<FieldSweeps> {
public:
  FieldSystem(const algebra::BlockMatrix& K, const Teuchos::RCP<FieldSweeps>& sweeps)
      : ConcatenatedSystem(K, sweeps), sweeps_(sweeps) {}

  std::vector<double> save() const override { return sweeps_->save(); }
  void restore(const std::vector<double>& numbers) override { sweeps_->restore(numbers); }

private:
  Teuchos::RCP<FieldSweeps> sweeps_;
};

void check_field_by_field_list(const Teuchos::ParameterList& list, const std::string& path) {
  if (!list.isSublist("Fields")) return;  // another preconditioner
  TUNICA_CHECK(list.sublist("Fields").numParams() > 0,
               path +
                   " / Fields: expected at least one entry, e.g. \"wall\" with the parts wall "
                   "and interface, and \"lumen\" with the part lumen.");
}

params::Table field_by_field_table(const SolverDefaults& defaults) {
  params::Table field = inner_solver_table(defaults);
  field
      .names("parts", std::nullopt,
             "parts of the system that contain the unknowns of the field: \"wall\", \"lumen\", and "
             "the \"interface\" between them; fields may share parts")
      .text("own block of", "",
            "\"wall\" or \"lumen\": use only the contribution of this part to the matrix of the "
            "vector unknowns, as if the others were not coupled to it; empty: use all");
  params::Table table;
  table.integer("sweeps", 1, params::between(1, 1000), "sweeps over the fields")
      .number("damping", 1.0, params::Range{0.0, 2.0, true, false}, "1",
              "factor of each correction")
      .flag("is symmetric", false, "go back through the fields in each sweep")
      .entries(
          "Fields", field,
          "fields to solve for in turn, in the order of the entries; together they have all parts")
      .check(check_field_by_field_list);
  return table;
}

}  // namespace

PreconditionerEntry field_preconditioner() {
  return {"field by field", 8.0, field_by_field_table,
          [](const Teuchos::ParameterList& list, const algebra::BlockMatrix& K,
             const NamedOperators& operators) {
            return std::make_unique<FieldSystem>(K,
                                                 Teuchos::rcp(new FieldSweeps(list, K, operators)));
          },
          true};
}

}  // namespace tunica::linear
