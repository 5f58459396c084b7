#include "tunica/coupling/accelerator.hpp"

#include <numeric>

#include "tunica/base/reduce.hpp"
#include "tunica/coupling/aitken.hpp"
#include "tunica/coupling/constant_relaxation.hpp"
#include "tunica/coupling/iqn_ils.hpp"

namespace tunica::coupling {

void add_accelerator_keys(params::Table& table) {
  table.variant("accelerator", "iqn-ils",
                {{"constant", constant_relaxation_table()},
                 {"aitken", aitken_table()},
                 {"iqn-ils", iqn_ils_table()}},
                "how the next interface displacement is made from the residual");
}

std::unique_ptr<Accelerator> make_accelerator(const Teuchos::ParameterList& list,
                                              const CommPtr& comm) {
  const auto& kind = list.get<std::string>("accelerator");
  if (kind == "constant") return std::make_unique<ConstantRelaxation>(list);
  if (kind == "aitken") return std::make_unique<Aitken>(list, comm);
  return std::make_unique<IqnIls>(list, comm);
}

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
