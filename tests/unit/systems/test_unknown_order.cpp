#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <functional>
#include <map>
#include <sstream>

#include "helpers.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/systems/read_system.hpp"

namespace {

using namespace tunica;
using namespace tunica::systems_tests;

constexpr int wide = 7, grid_nodes = wide * wide;

/// An unknown: component c of the vector at a node, or its scalar.
struct Place {
  int node, component;  ///< components from 0 on, the scalar last
};

/// A grid of nodes with a Laplacian for each component, differences of scalars between neighbours,
/// and C of the same pattern.
class Grid {
public:
  Grid(int components, bool has_C, double sign_of_continuity, bool couples_components = false)
      : components_(components), has_C_(has_C), sign_(sign_of_continuity),
        couples_(couples_components) {}

  int dofs() const { return components_ + 1; }
  double value(const Place& row, const Place& column) const {
    const int dx = row.node % wide - column.node % wide, dy = row.node / wide - column.node / wide;
    const bool is_same = dx == 0 && dy == 0, is_near = std::abs(dx) + std::abs(dy) == 1;
    if (!is_same && !is_near) return 0.0;
    const bool of_row = row.component == components_, of_column = column.component == components_;
    if (of_row && of_column) return !has_C_ ? 0.0 : -sign_ * (is_same ? 4.0 : -1.0);
    if (of_row) return sign_ * gradient(column, row);
    if (of_column) return gradient(row, column);
    if (row.component == column.component) return is_same ? 5.0 : -1.0 - 0.1 * dx;
    return couples_ ? (is_same ? 0.5 : -0.1) : 0.0;
  }

private:
  /// Of the scalar, in the row of a vector.
  double gradient(const Place& vector, const Place& scalar) const {
    const int step = vector.component == 0 ? scalar.node % wide - vector.node % wide
                                           : scalar.node / wide - vector.node / wide;
    return step + (vector.node == scalar.node ? 0.1 : 0.05);
  }

  int components_;
  bool has_C_;
  double sign_;
  bool couples_;
};

std::vector<Place> places(int dofs, const std::string& order) {
  std::vector<Place> all;
  const int c = dofs - 1;
  if (order == "scalars last" || order == "scalars first") {
    for (int k = 0; k < c; ++k)
      for (int node = 0; node < grid_nodes; ++node) all.push_back({node, k});
    std::vector<Place> scalars;
    for (int node = 0; node < grid_nodes; ++node) scalars.push_back({node, c});
    all.insert(order == "scalars last" ? all.end() : all.begin(), scalars.begin(), scalars.end());
    return all;
  }
  const int at = order.back() - '0';  // "in node 2"
  for (int node = 0; node < grid_nodes; ++node)
    for (int k = 0, next = 0; k < dofs; ++k) all.push_back({node, k == at ? c : next++});
  return all;
}

using Values = std::function<double(const Place&, const Place&)>;

std::string text_of(const Values& value_of, const std::vector<Place>& unknowns) {
  std::ostringstream entries;
  int count = 0;
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    for (std::size_t j = 0; j < unknowns.size(); ++j)
      if (const double value = value_of(unknowns[i], unknowns[j]); value != 0.0) {
        entries << i + 1 << ' ' << j + 1 << ' ' << value << '\n';
        ++count;
      }
  return "%%MatrixMarket matrix coordinate real general\n" + std::to_string(unknowns.size()) + " " +
         std::to_string(unknowns.size()) + " " + std::to_string(count) + "\n" + entries.str();
}

std::string text_of(const Grid& grid, const std::vector<Place>& unknowns) {
  return text_of([&](const Place& i, const Place& j) { return grid.value(i, j); }, unknowns);
}

/// Of the scalars those at every other node in either direction, behind the vectors.
std::vector<Place> coarse_scalars(int dofs, bool is_by_node) {
  std::vector<Place> vectors, scalars;
  for (const Place& place : places(dofs, is_by_node ? "in node 0" : "scalars first"))
    if (place.component < dofs - 1)
      vectors.push_back(place);
    else if (place.node % wide % 2 == 0 && place.node / wide % 2 == 0)
      scalars.push_back(place);
  vectors.insert(vectors.end(), scalars.begin(), scalars.end());
  return vectors;
}
constexpr int n_coarse = 16;

/// A row that gives the value of its unknown.
Values with_known(const Grid& grid, const Place& known, double diagonal) {
  return [=](const Place& i, const Place& j) {
    if (i.node != known.node || i.component != known.component) return grid.value(i, j);
    return j.node == known.node && j.component == known.component ? diagonal : 0.0;
  };
}

systems::System read(const std::string& matrix,
                     const std::function<void(Teuchos::ParameterList&)>& change = {}) {
  const File file(matrix);
  Teuchos::ParameterList options;
  options.set("K", file.path).set("null space", false);
  if (change) change(options);
  systems::system_table().resolve(options, "System", "");
  return systems::read_system(options, world(), at_once * 100);
}

int global_rows(const systems::System& system, int block) {
  return static_cast<int>((*system.K.space())[block].map->getGlobalNumElements());
}

TEUCHOS_UNIT_TEST(unknown_order, is_found_from_one_matrix) {
  for (const int components : {2, 3})
    for (const bool has_C : {false, true})
      for (const double sign : {1.0, -1.0})
        for (const std::string order :
             {"scalars last", "scalars first", "in node 0", "in node 1", "in node 2"}) {
          const Grid grid(components, has_C, sign);
          const auto unknowns = places(grid.dofs(), order);
          const systems::System system = read(text_of(grid, unknowns));
          TEST_EQUALITY(system.K.n_blocks(), 2);
          TEST_EQUALITY(global_rows(system, 0), components * grid_nodes);
          TEST_EQUALITY(system.found.get<int>("components"), components);
          TEST_EQUALITY(system.found.get<std::string>("order"),
                        order[0] == 's' ? "by component" : "by node");
          if (order[0] == 's') TEST_ASSERT(says(system.order, order));
          // Nodes of both fields are the same: vector i of node k is at its number.
          const auto nodes = system.K.space();
          TEST_EQUALITY((*nodes)[0].nodes.graph.get(), (*nodes)[1].nodes.graph.get());
        }
}

TEUCHOS_UNIT_TEST(unknown_order, one_field_has_no_scalars) {
  const Grid grid(2, false, 1.0, true);
  auto unknowns = places(3, "in node 2");
  unknowns.erase(std::remove_if(unknowns.begin(), unknowns.end(),
                                [](const Place& place) { return place.component == 2; }),
                 unknowns.end());
  const systems::System vectors = read(text_of(grid, unknowns));
  TEST_EQUALITY(vectors.K.n_blocks(), 1);
  TEST_EQUALITY(vectors.order, "2 components, by node, no scalars");
  unknowns.erase(std::remove_if(unknowns.begin(), unknowns.end(),
                                [](const Place& place) { return place.component == 1; }),
                 unknowns.end());
  TEST_EQUALITY(read(text_of(grid, unknowns)).order, "1 component, no scalars");
}

TEUCHOS_UNIT_TEST(unknown_order, may_be_overruled) {
  const Grid grid(2, true, 1.0);
  const std::string text = text_of(grid, places(3, "scalars last"));
  const systems::System none = read(text, [](Teuchos::ParameterList& options) {
    options.set<std::string>("scalars", "none").set("components", 1);
  });
  TEST_EQUALITY(none.K.n_blocks(), 1);
  const systems::System few = read(text, [](Teuchos::ParameterList& options) {
    options.set<std::string>("scalars", "last").set("scalar unknowns", 4).set("components", 1);
  });
  TEST_EQUALITY(global_rows(few, 1), 4);
  const systems::System given =
      read(text_of(grid, places(3, "in node 0")), [](Teuchos::ParameterList& options) {
        options.set<std::string>("scalars", "first in node").set("components", 2);
      });
  TEST_EQUALITY(global_rows(given, 1), grid_nodes);
  TEST_ASSERT(says(refusal([&] {
                     read(text, [](Teuchos::ParameterList& options) {
                       options.set<std::string>("scalars", "last").set("components", 4);
                     });
                   }),
                   "do not fit \"components\" = 4"));
}

TEUCHOS_UNIT_TEST(unknown_order, a_solution_has_the_rows_of_the_matrix) {
  const Grid grid(2, true, -1.0);
  const systems::System system = read(text_of(grid, places(3, "in node 1")));
  algebra::BlockVector x = system.K.zero();
  x[1].putScalar(7.0);
  const Vector all = in_file_order(system, x);
  const auto view = all.getLocalViewHost(read_only);
  for (std::size_t row = 0; row < view.extent(0); ++row)
    TEST_EQUALITY(view(row, 0), row % 3 == 1 ? 7.0 : 0.0);
}

// As in finite elements on bricks: the components of a node are coupled at its neighbours alone.
TEUCHOS_UNIT_TEST(unknown_order, components_may_be_coupled_at_neighbours) {
  const auto value = [](const Place& i, const Place& j) {
    const int dx = i.node % wide - j.node % wide, dy = i.node / wide - j.node / wide;
    if (std::abs(dx) > 1 || std::abs(dy) > 1) return 0.0;
    if (i.component == j.component) return dx == 0 && dy == 0 ? 9.0 : -1.0;
    return 0.25 * dx * dy;
  };
  for (const int components : {2, 3})
    for (const bool is_by_node : {true, false}) {
      std::vector<Place> unknowns = coarse_scalars(components + 1, is_by_node);
      unknowns.resize(components * grid_nodes);
      TEST_EQUALITY(read(text_of(value, unknowns)).order,
                    std::to_string(components) + " components, " +
                        (is_by_node ? "by node" : "by component") + ", no scalars");
    }
}

TEUCHOS_UNIT_TEST(unknown_order, a_first_scalar_that_is_known_is_none_of_the_vectors) {
  for (const int components : {2, 3})
    for (const bool is_by_node : {true, false}) {
      const Grid grid(components, false, 1.0);
      const std::vector<Place> unknowns = coarse_scalars(components + 1, is_by_node);
      const std::string text = text_of(with_known(grid, {0, components}, 1.0), unknowns);
      const systems::System system = read(text);
      TEST_EQUALITY(global_rows(system, 0), components * grid_nodes);
      TEST_EQUALITY(system.order, std::to_string(components) + " components, " +
                                      (is_by_node ? "by node" : "by component") + ", scalars last");
      const systems::System given = read(text, [&](Teuchos::ParameterList& options) {
        options.set("scalar unknowns", n_coarse).set("components", components);
      });
      TEST_EQUALITY(global_rows(given, 1), n_coarse);
    }
}

TEUCHOS_UNIT_TEST(unknown_order, the_number_of_scalars_may_be_given_alone) {
  const Grid grid(2, false, 1.0);
  const systems::System system =
      read(text_of(grid, coarse_scalars(3, false)), [](Teuchos::ParameterList& options) {
        options.set("scalar unknowns", 18).set("components", 2);
      });
  TEST_EQUALITY(global_rows(system, 1), 18);
  TEST_EQUALITY(global_rows(system, 0), 2 * grid_nodes - 2);
}

TEUCHOS_UNIT_TEST(unknown_order, vectors_that_convection_turns_stay_vectors) {
  const Grid grid(2, false, 1.0);
  const auto turned = [&](const Place& i, const Place& j) {
    const bool is_turned = (i.node == 11 && i.component == 0) || (i.node == 23 && i.component == 1);
    const bool is_diagonal = i.node == j.node && i.component == j.component;
    return is_turned && is_diagonal ? -0.1 : grid.value(i, j);
  };
  for (const bool is_by_node : {true, false}) {
    const systems::System system = read(text_of(turned, coarse_scalars(3, is_by_node)));
    TEST_EQUALITY(global_rows(system, 1), n_coarse);
    TEST_EQUALITY(system.order, std::string("2 components, ") +
                                    (is_by_node ? "by node" : "by component") + ", scalars last");
  }
  const systems::System in_nodes = read(text_of(turned, places(3, "in node 1")));
  TEST_EQUALITY(global_rows(in_nodes, 1), grid_nodes);
  TEST_ASSERT(says(in_nodes.order, "scalars at place 2"));
}

TEUCHOS_UNIT_TEST(unknown_order, known_scalars_do_not_make_C_doubtful) {
  const Grid grid(2, true, 1.0);
  const std::vector<Place> unknowns = places(3, "scalars last");
  TEST_ASSERT(read(text_of(with_known(grid, {3, 2}, 1e4), unknowns)).remarks.empty());
  const auto wrong = [&](const Place& i, const Place& j) {
    return (i.component == 2 && j.component == 2 ? -1.0 : 1.0) * grid.value(i, j);
  };
  const systems::System doubted =
      read(text_of(wrong, unknowns), [](Teuchos::ParameterList& options) {
        options.set<std::string>("scalars", "last").set("components", 2);
      });
  if (world()->getRank() == 0) {
    TEST_EQUALITY(doubted.remarks.size(), 1u);
  }
}

}  // namespace
