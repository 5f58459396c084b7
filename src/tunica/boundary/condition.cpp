#include "tunica/boundary/condition.hpp"

#include <Teuchos_Array.hpp>
#include <cmath>

namespace tunica::boundary {

double length_of(const Teuchos::ParameterList& list, const std::string& key) {
  double sum = 0.0;
  for (const double x : list.get<Teuchos::Array<double>>(key)) sum += x * x;
  return std::sqrt(sum);
}

}  // namespace tunica::boundary
