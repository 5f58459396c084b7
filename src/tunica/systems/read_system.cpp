#include "tunica/systems/read_system.hpp"

#include <algorithm>
#include <string>

#include "tunica/base/error.hpp"
#include "tunica/systems/matrix_files.hpp"
#include "tunica/systems/prepared_system.hpp"
#include "tunica/systems/right_side.hpp"
#include "tunica/systems/whole_matrix.hpp"

namespace tunica::systems {

namespace {

void check_size(const std::string& name, const SparseRows& block, long long n_rows,
                long long n_columns) {
  const auto size = [](long long rows, long long columns) {
    return std::to_string(rows) + " x " + std::to_string(columns);
  };
  TUNICA_CHECK(block.n_rows == n_rows && block.n_columns == n_columns,
               "System: " + name + " is " + size(block.n_rows, block.n_columns) + ", expected " +
                   size(n_rows, n_columns) + ".");
}

void number_rows(Blocks& blocks) {
  for (const int i : {0, 1})
    for (std::size_t k = 0; k < blocks.n_local(i); ++k)
      blocks.file_rows[i].push_back(blocks(i, i).first_row() + static_cast<long long>(k));
  blocks.first_row = {0, blocks.n_rows(0)};
}

Blocks read_blocks(const Teuchos::ParameterList& options, const CommPtr& comm,
                   std::size_t lines_at_once, ColumnRows& b) {
  const auto path = [&](const char* key) { return options.get<std::string>(key); };
  const auto read = [&](const char* key) { return read_matrix(path(key), comm, lines_at_once); };
  Blocks blocks;
  blocks.A = read("A");
  check_size("A", blocks.A, blocks.A.n_rows, blocks.A.n_rows);
  blocks.A = with_diagonal(blocks.A);
  blocks.B2 = read("B2");
  const long long n = blocks.A.n_rows, m = blocks.B2.n_rows;
  check_size("B2", blocks.B2, m, n);
  blocks.B1T = path("B1T").empty() ? transposed(blocks.B2) : read("B1T");
  check_size("B1T", blocks.B1T, n, m);
  const MatrixRows C = path("C").empty() ? empty_matrix(m, m, comm) : read("C");
  check_size("C", C, m, m);
  blocks.mC = with_diagonal(C);
  for (double& value : blocks.mC.values) value *= -options.get<double>("C factor");
  b = read_column(path("rhs"), comm, lines_at_once);
  TUNICA_CHECK(b.n_rows == n + m, "System: rhs has " + std::to_string(b.n_rows) +
                                      " rows, expected " + std::to_string(n + m) +
                                      ": those of A, then those of B2.");
  number_rows(blocks);
  return blocks;
}

void check_files(const Teuchos::ParameterList& list, const std::string& path) {
  const auto is_given = [&](const char* key) { return !list.get<std::string>(key).empty(); };
  const bool has_block = is_given("A") || is_given("B2") || is_given("B1T") || is_given("C");
  TUNICA_CHECK(is_given("K") || has_block,
               path + ": \"K\" is missing, expected a file, or A, B2 and rhs in its place.");
  TUNICA_CHECK(!is_given("K") || !has_block,
               path + ": \"K\" has all unknowns, expected no A, B1T, B2 and C beside it.");
  TUNICA_CHECK(!is_given("exclude") || list.get<bool>("border"),
               path + ": \"exclude\" has no meaning where \"border\" is false.");
  for (const char* key : {"A", "B2", "rhs"})
    TUNICA_CHECK(is_given("K") || is_given(key),
                 path + ": \"" + key +
                     "\" is missing, expected a file; one matrix with all unknowns is \"K\".");
}

void add_order_keys(params::Table& table) {
  table
      .choice("scalars", "automatic",
              {"automatic", "none", "first", "last", "first in node", "last in node"},
              "where the scalar unknowns stand in K; automatic: found from its signs")
      .integer("scalar unknowns", 0, params::between(0, 1e9),
               "number of scalars that stand first or last; 0: one for each node")
      .integer("components", 0, params::between(0, 16),
               "vector unknowns of a node; 0: found from the pattern of A")
      .choice("order", "automatic", {"automatic", "by node", "by component"},
              "numbers of the vector unknowns: components*node + i, or i*nodes + node; scalar "
              "unknowns are numbered by their nodes; automatic: found from the pattern of A")
      .file("node map", "",
            "text file, for systems in no such order: a line for each unknown, those of A first, "
            "with the number of its node and, for vector unknowns, the component (counted from 0; "
            "without it in the order of the lines)");
}

}  // namespace

params::Table system_table() {
  params::Table table(
      "A system in the Matrix Market format: the blocks of [A B1T; B2 -C], or one matrix K.");
  table
      .file("K", "",
            "one matrix with all unknowns, of vectors and scalars or of one kind, in place of "
            "blocks")
      .file("A", "", "the square block of the vector unknowns")
      .file("B1T", "", "the block right of A; the transpose of B2 if there is no file")
      .file("B2", "", "the block below A")
      .file("C", "", "the square block of the scalar unknowns; zero if there is no file")
      .number("C factor", 1.0, params::any(), "1",
              "K has -(C factor) C; -1 if the file contains the block as it is in K")
      .file("rhs", "",
            "right-hand side: one column, the rows of A, then those of B2, or those of K; without "
            "a file, with K alone, that of the solution sin(i) in row i");
  add_matrix_keys(table);
  table.check(check_files);
  return table;
}

void add_matrix_keys(params::Table& table) {
  add_order_keys(table);
  table
      .file("schur", "",
            "square matrix of the scalar unknowns in their order that is like C + B2 inv(A) B1T, "
            "up to its sign, such as a mass matrix over the viscosity: for block LU with \"Schur "
            "Complement\" = \"Given\", which then comes first")
      .file("coordinates", "",
            "dense array in the Matrix Market format with three columns and a row for each node "
            "in the order of their numbers, of solids: multigrid interpolates their rotations")
      .number("negligible", 1e-14, params::Range{0.0, 1e-3, false, false}, "1",
              "entries of at most this part of the largest one of their row and of their column "
              "are left out; 0: none")
      .flag("known values", true,
            "take unknowns out of the system whose rows give their values: rows with nothing but "
            "the diagonal, and penalties")
      .flag("border", true,
            "eliminate scalars with dense rows, such as the multiplier of a mean value, each by a "
            "solve of its own")
      .file(
          "exclude", "",
          "text file with the rows of other scalars that are to be eliminated so, from 1 on: those "
          "of K, or of B2")
      .choice("scaling", "fields", {"fields", "none"},
              "factors for the rows and columns of each field that make typical entries 1, and for "
              "rows that are much larger or smaller than others; none: as in the files")
      .flag("null space", true,
            "find scalars, or a component of the vectors, that are determined but for a constant, "
            "and take those of zero mean");
}

System read_system(const Teuchos::ParameterList& options, const CommPtr& comm,
                   std::size_t lines_at_once) {
  ColumnRows b;
  System system;
  if (options.get<std::string>("K").empty()) {
    system =
        prepared_system(read_blocks(options, comm, lines_at_once, b), options, "", lines_at_once);
  } else {
    std::string order;
    Blocks blocks = read_whole(options, comm, lines_at_once, order, b);
    system = prepared_system(std::move(blocks), options, order, lines_at_once);
  }
  Vector column(Teuchos::rcp(new Map(b.n_rows, b.values.size(), 0, comm)));
  {
    const auto values = column.getLocalViewHost(overwrite_all);
    for (std::size_t k = 0; k < b.values.size(); ++k) values(k, 0) = b.values[k];
  }
  for (const std::string& remark : take_right_side(system, column))
    system.remarks.push_back(remark);
  return system;
}

}  // namespace tunica::systems
