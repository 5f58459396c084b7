#include "tunica/coupling/accelerator.hpp"

#include <numeric>
#include <stdexcept>
#include <string>

#include "tunica/base/reduce.hpp"
#include "tunica/coupling/aitken.hpp"
#include "tunica/coupling/constant_relaxation.hpp"
#include "tunica/coupling/iqn_ils.hpp"

namespace tunica::coupling {

namespace {

/// An accelerator, as XML names it.
struct Entry {
  std::string name;
  params::Table (*table)();
  std::unique_ptr<Accelerator> (*make)(const Teuchos::ParameterList&, const CommPtr&);
};

template <class Kind>
std::unique_ptr<Accelerator> make(const Teuchos::ParameterList& list, const CommPtr& comm) {
  return std::make_unique<Kind>(list, comm);
}

/// Every accelerator there is, in the order of the reference.
const std::vector<Entry>& accelerators() {
  static const std::vector<Entry> all = {
      {"constant", constant_relaxation_table, make<ConstantRelaxation>},
      {"aitken", aitken_table, make<Aitken>},
      {"iqn-ils", iqn_ils_table, make<IqnIls>},
  };
  return all;
}

}  // namespace

void add_accelerator_keys(params::Table& table) {
  std::vector<params::Table::Case> cases;
  for (const Entry& entry : accelerators()) cases.push_back({entry.name, entry.table()});
  table.variant("accelerator", "iqn-ils", cases,
                "how the next interface displacement is computed from the residual");
}

std::unique_ptr<Accelerator> make_accelerator(const Teuchos::ParameterList& list,
                                              const CommPtr& comm) {
  const auto& kind = list.get<std::string>("accelerator");
  for (const Entry& entry : accelerators())
    if (entry.name == kind) return entry.make(list, comm);
  throw std::logic_error("\"" + kind + "\" is no accelerator");
}

// Row k belongs to node k of the interface, with three numbers of each vector side by side: rows
// may change ranks from one run to the next.
fields::State::Array packed(const std::deque<InterfaceVector>& vectors) {
  const std::size_t columns = 3 * vectors.size();
  fields::State::Array rows{static_cast<int>(columns), {}};
  if (vectors.empty()) return rows;
  rows.values.resize(vectors.size() * vectors.front().size());
  for (std::size_t k = 0; k < vectors.size(); ++k)
    for (std::size_t i = 0; i < vectors[k].size(); ++i)
      rows.values[i / 3 * columns + 3 * k + i % 3] = vectors[k][i];
  return rows;
}

std::deque<InterfaceVector> unpacked(const fields::State::Array& rows) {
  const std::size_t columns = rows.columns;
  std::deque<InterfaceVector> vectors(columns / 3);
  if (vectors.empty()) return vectors;
  for (std::size_t k = 0; k < vectors.size(); ++k) {
    vectors[k].resize(rows.values.size() / vectors.size());
    for (std::size_t i = 0; i < vectors[k].size(); ++i)
      vectors[k][i] = rows.values[i / 3 * columns + 3 * k + i % 3];
  }
  return vectors;
}

InterfaceVector difference(const InterfaceVector& a, const InterfaceVector& b) {
  InterfaceVector c(a);
  for (std::size_t i = 0; i < c.size(); ++i) c[i] -= b[i];
  return c;
}

double inner_product(const Comm& comm, const InterfaceVector& a, const InterfaceVector& b) {
  return global_sum(comm, std::inner_product(a.begin(), a.end(), b.begin(), 0.0));
}

}  // namespace tunica::coupling
