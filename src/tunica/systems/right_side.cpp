#include "tunica/systems/right_side.hpp"

#include <cmath>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/systems/blocks.hpp"
#include "tunica/systems/entry_sums.hpp"
#include "tunica/systems/null_space.hpp"
#include "tunica/systems/preparation.hpp"

namespace tunica::systems {

namespace {

/// The rows of b that the unknowns have, with the signs of the system.
algebra::BlockVector dealt_to(const System& system, const Vector& b) {
  algebra::BlockVector dealt = system.K.zero();
  for (int i = 0; i < dealt.n_blocks(); ++i) {
    Vector part(system.file_rows[i]);
    part.doImport(b, Import(b.getMap(), part.getMap()), insert);
    const auto from = part.getLocalViewHost(read_only);
    const auto to = dealt[i].getLocalViewHost(overwrite_all);
    for (std::size_t k = 0; k < from.extent(0); ++k) to(k, 0) = system.signs[i] * from(k, 0);
  }
  return dealt;
}

/// rest ← b − K x_k of what is known so far.
void leave(const System& system, algebra::BlockVector& rest) {
  system.given.apply(system.known, rest);
  for (int i = 0; i < rest.n_blocks(); ++i) rest[i].update(1.0, system.given_b[i], -1.0);
}

/// Values of a round for what those of the rounds before have left of b.
void find_values(System& system, int round, const algebra::BlockVector& rest) {
  for (int i = 0; i < rest.n_blocks(); ++i) {
    Vector d(rest[i].getMap());
    system.given(i, i)->getLocalDiagCopy(d);
    const auto diagonal = d.getLocalViewHost(read_only);
    const auto known_in = system.known_in[i].getLocalViewHost(read_only);
    const auto left = rest[i].getLocalViewHost(read_only);
    const auto x = system.known[i].getLocalViewHost(read_write);
    for (std::size_t k = 0; k < x.extent(0); ++k)
      if (known_in(k, 0) == round) x(k, 0) = left(k, 0) / diagonal(k, 0);
  }
}

/// x ← D x of free unknowns, 0 of the others; D diagonal.
void scale_free(const System& system, const algebra::BlockVector& D, algebra::BlockVector& x) {
  for (int i = 0; i < x.n_blocks(); ++i) {
    const auto known_in = system.known_in[i].getLocalViewHost(read_only);
    const auto factor = D[i].getLocalViewHost(read_only);
    const auto values = x[i].getLocalViewHost(read_write);
    for (std::size_t k = 0; k < values.extent(0); ++k)
      values(k, 0) =
          known_in(k, 0) == 0.0 || known_in(k, 0) == bordering ? factor(k, 0) * values(k, 0) : 0.0;
  }
}

/// 0 = b where nothing else stands in a row: what the sums leave by rounding is zero.
void check_empty_rows(const System& system, const algebra::BlockVector& rest) {
  std::string wrong;
  for (int i = 0; i < rest.n_blocks(); ++i) {
    Vector sums(rest[i].getMap());
    for (int j = 0; j < rest.n_blocks(); ++j)
      add_magnitudes(*system.given(i, j), system.known[j], sums);
    const auto size = sums.getLocalViewHost(read_only);
    const auto left = rest[i].getLocalViewHost(read_only);
    const auto known_in = system.known_in[i].getLocalViewHost(read_only);
    std::vector<long long> rows;
    for (std::size_t k = 0; k < left.extent(0); ++k)
      if (known_in(k, 0) == undetermined && !(std::abs(left(k, 0)) <= 1e-10 * size(k, 0)))
        rows.push_back(system.file_rows[i]->getGlobalElement(static_cast<LocalOrdinal>(k)) -
                       system.first_row[i]);
    const std::string text = text_of_rows(*system.K.comm(), rows, system.files[i]);
    if (wrong.empty()) wrong = text;
  }
  const bool is_one = wrong.find("rows") != 0;
  on_root(*system.K.comm(), [&] {
    TUNICA_CHECK(wrong.empty(), "System: " + wrong + (is_one ? " has" : " have") +
                                    " no entries, but the right-hand side is not zero there: no "
                                    "solution fulfils " +
                                    (is_one ? "this equation." : "these equations."));
  });
}

}  // namespace

std::vector<std::string> take_right_side(System& system, const Vector& b) {
  system.given_b = dealt_to(system, b);
  system.known = system.K.zero();
  system.b = system.K.zero();
  system.b.assign(system.given_b);
  for (int round = 1; round <= system.rounds; ++round) {
    find_values(system, round, system.b);
    leave(system, system.b);
  }
  check_empty_rows(system, system.b);
  take_to_rows(system, system.b);
  return leave_out_constants(system, system.b);
}

std::vector<double> values_at(const std::vector<GlobalOrdinal>& unknowns, const Vector& x) {
  const Map& map = *x.getMap();
  const auto values = x.getLocalViewHost(read_only);
  std::vector<double> mine;
  for (const GlobalOrdinal unknown : unknowns)
    mine.push_back(map.isNodeGlobalElement(unknown) ? values(map.getLocalElement(unknown), 0)
                                                    : 0.0);
  return global_sum(*map.getComm(), mine);
}

void take_to_rows(const System& system, algebra::BlockVector& x) {
  scale_free(system, system.row_scale, x);
}

algebra::BlockVector of_free(const System& system, const algebra::BlockVector& y) {
  algebra::BlockVector x = system.K.zero();
  x.assign(y);
  scale_free(system, system.scale, x);
  return x;
}

// x = x_k + C y
algebra::BlockVector in_units_of_files(const System& system, const algebra::BlockVector& y) {
  algebra::BlockVector x = of_free(system, y);
  for (int i = 0; i < y.n_blocks(); ++i) x[i].update(1.0, system.known[i], 1.0);
  for (const ConstantMode& mode : system.constants) {
    if (mode.is_given_by_border()) continue;
    const auto values = x[mode.field].getLocalViewHost(read_write);
    const auto known_in = system.known_in[mode.field].getLocalViewHost(read_only);
    const auto numbers = global_numbers(*x[mode.field].getMap());
    const int components = (*system.K.space())[mode.field].components;
    const auto is_in = [&](std::size_t k) {
      return known_in(k, 0) == 0.0 && numbers[k] % components == mode.component;
    };
    double sum = 0.0, count = 0.0;
    for (std::size_t k = 0; k < values.extent(0); ++k)
      if (is_in(k)) sum += values(k, 0), ++count;
    const double mean = global_sum(*system.K.comm(), sum) / global_sum(*system.K.comm(), count);
    for (std::size_t k = 0; k < values.extent(0); ++k)
      if (is_in(k)) values(k, 0) -= mean;
  }
  return x;
}

Vector in_file_order(const System& system, const algebra::BlockVector& x,
                     const Teuchos::RCP<const Map>& rows) {
  Vector in_order(rows);
  for (int i = 0; i < x.n_blocks(); ++i) {
    Vector part(system.file_rows[i]);
    {
      const auto from = x[i].getLocalViewHost(read_only);
      const auto to = part.getLocalViewHost(overwrite_all);
      for (std::size_t k = 0; k < from.extent(0); ++k) to(k, 0) = from(k, 0);
    }
    in_order.doExport(part, Import(rows, part.getMap()), insert);
  }
  return in_order;
}

Vector in_file_order(const System& system, const algebra::BlockVector& x) {
  const CommPtr comm = system.K.comm();
  const GlobalOrdinal n = system.K.n_unknowns();
  const auto on_root = static_cast<std::size_t>(comm->getRank() == 0 ? n : 0);
  return in_file_order(system, x, Teuchos::rcp(new Map(n, on_root, 0, comm)));
}

}  // namespace tunica::systems
