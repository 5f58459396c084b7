#include "tunica/foreign/rigid_fit.hpp"

#include <cmath>
#include <vector>

#include "tunica/base/reduce.hpp"
#include "tunica/base/tensor.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::foreign {

namespace {

constexpr double next_to_nothing = 0.05, in_the_middle = 0.02;

/// Of each column's unknown, the place of its node.
MultiVector places_of_columns(const CrsMatrix& A, const MultiVector& places) {
  const Map& unknowns = *A.getDomainMap();
  MultiVector own(A.getDomainMap(), 3), all(A.getColMap(), 3);
  {
    const auto to = own.getLocalViewHost(overwrite_all);
    const auto from = places.getLocalViewHost(read_only);
    for (std::size_t r = 0; r < to.extent(0); ++r) {
      const GlobalOrdinal node = unknowns.getGlobalElement(static_cast<LocalOrdinal>(r)) / 3;
      const LocalOrdinal own_node = places.getMap()->getLocalElement(node);
      // Nodes that A does not couple have no place.
      for (int k = 0; k < 3; ++k) to(r, k) = own_node < 0 ? 0.0 : from(own_node, k);
    }
  }
  all.doImport(own, Import(A.getDomainMap(), A.getColMap()), insert);
  return all;
}

}  // namespace

RigidFit rigid_fit(const algebra::BlockMatrix& K) {
  const auto& places = (*K.space())[0].nodes.places.coordinates;
  if (places.is_null()) return {};
  const CrsMatrix& A = *K(0, 0);
  const MultiVector columns = places_of_columns(A, *places);
  const auto x = columns.getLocalViewHost(read_only);
  const auto local = A.getLocalMatrixHost();
  std::vector<double> counts(2, 0.0);
  for (int r = 0; r < local.numRows(); ++r) {
    const auto row = local.rowConst(r);
    const LocalOrdinal own = A.getColMap()->getLocalElement(A.getRowMap()->getGlobalElement(r));
    if (own < 0) continue;  // its diagonal is zero
    Vec3 moved{}, size{};   // by axis
    Vec3 offsets{};
    double squares = 0.0;
    for (int e = 0; e < row.length; ++e) {
      const int j = row.colidx(e);
      const int c = static_cast<int>(A.getColMap()->getGlobalElement(j) % 3);
      const Vec3 d{x(j, 0) - x(own, 0), x(j, 1) - x(own, 1), x(j, 2) - x(own, 2)};
      for (int k = 0; k < 3; ++k) {
        const double part = row.value(e) * cross(identity()[k], d)[c];
        moved[k] += part;
        size[k] += std::abs(part);
      }
      offsets += d;
      squares += tunica::dot(d, d);
    }
    const double left = std::abs(moved[0]) + std::abs(moved[1]) + std::abs(moved[2]);
    counts[0] += left <= next_to_nothing * (size[0] + size[1] + size[2]);
    counts[1] +=
        tunica::dot(offsets, offsets) <= in_the_middle * in_the_middle * row.length * squares;
  }
  const std::vector<double> all = global_sum(*K.comm(), counts);
  const auto rows = static_cast<double>(A.getGlobalNumRows());
  return {all[0] / rows, all[1] / rows};
}

}  // namespace tunica::foreign
