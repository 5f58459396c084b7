#include "tunica/output/row_order.hpp"

#include "tunica/base/map_of.hpp"

namespace tunica::output {

RowOrder::RowOrder(const std::vector<GlobalOrdinal>& given,
                   const std::vector<GlobalOrdinal>& wanted, const CommPtr& comm)
    : import_(map_of(given, comm), map_of(wanted, comm)) {}

std::vector<double> RowOrder::operator()(const std::vector<double>& values, int columns) const {
  MultiVector from(import_.getSourceMap(), columns), to(import_.getTargetMap(), columns);
  {
    const auto view = from.getLocalViewHost(overwrite_all);
    for (std::size_t i = 0; i < values.size(); ++i) view(i / columns, i % columns) = values[i];
  }
  to.doImport(from, import_, insert);
  const auto view = to.getLocalViewHost(read_only);
  std::vector<double> sorted(view.extent(0) * columns);
  for (std::size_t i = 0; i < sorted.size(); ++i) sorted[i] = view(i / columns, i % columns);
  return sorted;
}

}  // namespace tunica::output
