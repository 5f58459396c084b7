#include <Teuchos_UnitTestHarness.hpp>
#include <sstream>

#include "tunica/foreign/told_rows.hpp"
#include "unit/systems/helpers.hpp"

namespace {

using namespace tunica;

/// Four nodes in a row, of a vector unknown and a scalar each; the scalars first.
std::string four_nodes() {
  std::ostringstream entries;
  int count = 0;
  const auto add = [&](int i, int j, double value) {
    entries << i + 1 << ' ' << j + 1 << ' ' << value << '\n';
    ++count;
  };
  for (int node = 0; node < 4; ++node) {
    add(node, node, -0.5);
    add(4 + node, 4 + node, 3.0);
    add(node, 4 + node, 1.0);
    add(4 + node, node, 1.0);
    for (const int other : {node - 1, node + 1})
      if (other >= 0 && other < 4) add(4 + node, 4 + other, -1.0);
  }
  return "%%MatrixMarket matrix coordinate real general\n8 8 " + std::to_string(count) + "\n" +
         entries.str();
}

TEUCHOS_UNIT_TEST(told_rows, smoothers_speak_of_rows_of_the_files) {
  const systems_tests::File K(four_nodes());
  Teuchos::ParameterList options;
  options.set("K", K.path).set<std::string>("scalars", "first").set("components", 1);
  systems::system_table().resolve(options, "System", "");
  const systems::System system = systems::read_system(options, systems_tests::world());
  const auto told = [&](const std::string& message) {
    return foreign::with_rows_of_files(system, message);
  };
  // Unknowns of node k are 2k and 2k + 1 side by side, rows 5 + k and 1 + k of the file.
  TEST_EQUALITY_CONST(told("Vanka: the patch in row 5 of 8 unknowns is singular."),
                      "Vanka: the patch in row 3 of K is singular.");
  TEST_EQUALITY_CONST(told("row 4 of 8 unknowns"), "row 7 of K");
  TEST_EQUALITY_CONST(told("the block of node 2 of 8 unknowns cannot"),
                      "the block of row 7 of K and row 3 of K cannot");
  TEST_EQUALITY_CONST(told("row 3 of 4 unknowns"), "row 3 of 4 unknowns");  // a coarse level
}

}  // namespace
