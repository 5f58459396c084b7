#pragma once
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::output {

/// Brings rows that the ranks hold by one numbering to the ranks and the order that another one
/// wants. Both name the same numbers, each once.
class RowOrder {
public:
  /// Numbers of the rows given and of the rows wanted on this rank. Collective.
  RowOrder(const std::vector<GlobalOrdinal>& given, const std::vector<GlobalOrdinal>& wanted,
           const CommPtr& comm);

  /// Values row by row. Collective.
  std::vector<double> operator()(const std::vector<double>& values, int columns) const;

private:
  Import import_;
};

}  // namespace tunica::output
