#include "tunica/multigrid/muelu/smoothers/field_smoother.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <stdexcept>

#include "tunica/algebra/columns.hpp"
#include "tunica/algebra/picked_matrix.hpp"
#include "tunica/params/known_keys.hpp"

namespace tunica::multigrid {

namespace {

const Teuchos::Array<std::string>& parts_of(const Teuchos::ParameterList& field) {
  return field.get<Teuchos::Array<std::string>>("parts");
}

/// With the keys of Ifpack2Sweeps that are not given.
Teuchos::ParameterList completed(const Teuchos::ParameterList& field) {
  Teuchos::ParameterList all(field), known;
  Ifpack2Sweeps::declare(known);
  all.setParametersNotAlreadySet(known);
  return all;
}

/// 1 where the part of the row is one of the field's.
::tunica::Vector flags_of(const ::tunica::Vector& parts, const std::vector<std::string>& names,
                          const Teuchos::Array<std::string>& wanted) {
  ::tunica::Vector flags(parts.getMap());
  const auto part = parts.getLocalViewHost(read_only);
  const auto flag = flags.getLocalViewHost(overwrite_all);
  for (std::size_t r = 0; r < part.extent(0); ++r)
    flag(r, 0) =
        std::count(wanted.begin(), wanted.end(), names[static_cast<std::size_t>(part(r, 0))]) > 0
            ? 1.0
            : 0.0;
  return flags;
}

}  // namespace

// K_f = R_f K R_fᵀ of some parts, a method M_f of Ifpack2 for it, and room for r and dx of them
struct FieldSmoother::Field {
  Field(const Teuchos::ParameterList& list, const ::tunica::CrsMatrix& K,
        const ::tunica::Vector& flags)
      : rows(algebra::flagged_rows(flags)), matrix(K, flags, flags),
        sweeps(completed(list), matrix.matrix()), r(matrix.matrix()->getRowMap(), 1),
        dx(matrix.matrix()->getRowMap(), 1) {}

  std::vector<int> rows;
  algebra::PickedMatrix matrix;
  Ifpack2Sweeps sweeps;
  ::tunica::MultiVector r, dx;
};

Teuchos::RCP<const Teuchos::ParameterList> FieldSmoother::GetValidParameterList() const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set<Teuchos::RCP<const MueLu::FactoryBase>>("A", Teuchos::null, "the mixed matrix");
  list->set("sweeps", 1);
  list->set("damping", 1.0);
  // Names of fields are free; check() looks at what stands below them.
  list->sublist("Fields").disableRecursiveValidation();
  return list;
}

void FieldSmoother::check(const Teuchos::ParameterList& list) const {
  if (list.get<int>("sweeps") < 1 || !(list.get<double>("damping") > 0.0))
    throw std::invalid_argument("FieldSmoother: \"sweeps\" and \"damping\" must be positive.");
  const Teuchos::ParameterList& fields = list.sublist("Fields");
  if (fields.numParams() == 0)
    throw std::invalid_argument("FieldSmoother: expected at least one list in \"Fields\".");
  for (const auto& entry : fields) {
    const std::string where = "FieldSmoother / Fields / " + entry.first;
    if (!entry.second.isList()) throw std::invalid_argument(where + " is no list.");
    const Teuchos::ParameterList& field = fields.sublist(entry.first);
    params::check_keys(field, {"parts", "type", "overlap", "ParameterList"}, where);
    if (!field.isType<Teuchos::Array<std::string>>("parts"))
      throw std::invalid_argument(where + " lacks \"parts\", an Array(string).");
    Ifpack2Sweeps::check(completed(field));
  }
}

// A coarse node is in the part of the fine node that it was, so that fields exist on all levels.
void FieldSmoother::set_up(const ::tunica::CrsMatrix& K, const algebra::DofLayout&) {
  K_ = &K;
  const Teuchos::ParameterList& fields = GetParameterList().sublist("Fields");
  const ::tunica::Vector of_rows = parts(K);
  const std::string complaint = params::complaint_about_parts(fields, coarsening().part_names());
  if (!complaint.empty()) throw std::runtime_error("FieldSmoother: " + complaint);
  fields_ = std::make_shared<std::vector<Field>>();
  fields_->reserve(fields.numParams());
  for (const auto& entry : fields) {
    const Teuchos::ParameterList& field = fields.sublist(entry.first);
    fields_->emplace_back(field, K, flags_of(of_rows, coarsening().part_names(), parts_of(field)));
  }
}

void FieldSmoother::refresh() {
  // K_f and M_f keep their graphs.
  for (Field& field : *fields_) {
    field.matrix.refresh(*K_);
    field.sweeps.refresh();
  }
}

// x ← x + ω R_fᵀ M_f⁻¹ R_f (b − K x), field after field with the newest x
void FieldSmoother::smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const {
  const double damping = GetParameterList().get<double>("damping");
  const int n = GetParameterList().get<int>("sweeps");
  algebra::for_each_column("FieldSmoother", b, x, [&](const auto& b_c, auto& x_c) {
    ::tunica::MultiVector r(b_c.getMap(), 1);
    for (int sweep = 0; sweep < n; ++sweep)
      for (Field& field : *fields_) {
        K_->apply(x_c, r);
        r.update(1.0, b_c, -1.0);  // r = b − K x
        algebra::pick_rows(field.rows, r, field.r);
        field.dx.putScalar(0.0);
        field.sweeps.smooth(field.r, field.dx);
        algebra::add_rows(field.rows, damping, field.dx, x_c);
      }
  });
}

Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>>
FieldSmoother::Copy() const {
  return Teuchos::rcp(new FieldSmoother(*this));
}

}  // namespace tunica::multigrid
