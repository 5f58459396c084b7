#include "tunica/foreign/problem.hpp"

#include <cmath>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/params/read_xml.hpp"
#include "tunica/systems/prepared_system.hpp"
#include "tunica/systems/right_side.hpp"
#include "tunica/systems/whole_matrix.hpp"

namespace tunica::foreign {

namespace {

/// The list of a case; the matrix and the right-hand side that it names are not read.
Teuchos::ParameterList options_from(const std::string& settings) {
  const auto first = settings.find_first_not_of(" \t\r\n");
  Teuchos::ParameterList list;
  if (first != std::string::npos)
    list = settings[first] == '<' ? params::from_xml(settings, "settings")
                                  : params::read_xml(settings);
  for (const char* key : {"K", "rhs"}) list.sublist("System").remove(key, false);
  params::Table matrix("What the matrix is."), solvers("Settings that are tried in turn.");
  systems::add_matrix_keys(matrix);
  add_settings_keys(solvers);
  params::Table table("How a matrix of another program is solved with.");
  table.sublist("System", matrix).sublist("Solvers", solvers).resolve(list, "", "");
  return list;
}

/// What is wrong with the rank's rows of a matrix of n rows; empty if nothing is.
std::string fault_of(const OwnRows& rows, long long n) {
  if (rows.count < 0) return "the number of rows is negative";
  if (rows.offsets == nullptr || (rows.count > 0 && rows.offsets[rows.count] > 0 &&
                                  (rows.columns == nullptr || rows.values == nullptr)))
    return "offsets, columns or values are missing";
  if (rows.offsets[0] != 0) return "the first offset is not 0";
  for (long long i = 0; i < rows.count; ++i) {
    if (rows.offsets[i + 1] < rows.offsets[i])
      return "the offset of row " + std::to_string(i) + " of the rank is above the next one";
    for (long long k = rows.offsets[i]; k < rows.offsets[i + 1]; ++k)
      if (rows.columns[k] < 0 || rows.columns[k] >= n)
        return "row " + std::to_string(i) + " of the rank has an entry in column " +
               std::to_string(rows.columns[k]) + ", expected 0 to " + std::to_string(n - 1);
  }
  return "";
}

/// Text of the first number that is none, or nothing.
std::string fault_of_numbers(const double* numbers, std::size_t count, const std::string& name) {
  if (count > 0 && numbers == nullptr) return name + " is missing";
  for (std::size_t k = 0; k < count; ++k)
    if (!std::isfinite(numbers[k]))
      return name + "[" + std::to_string(k) + "] is not a finite number";
  return "";
}

/// Equal portions of the rows, as the preparation wants them. Collective.
systems::MatrixRows in_portions(const systems::SparseRows& pattern, long long first_row,
                                const double* values) {
  systems::RowCollector collector(pattern.n_rows, pattern.n_columns, pattern.comm);
  systems::in_batches(pattern, [&](std::size_t first, std::size_t last) {
    std::vector<systems::Entry> entries;
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t k = pattern.start[i]; k < pattern.start[i + 1]; ++k)
        entries.push_back({first_row + static_cast<long long>(i), pattern.columns[k], values[k]});
    collector.add(entries);
  });
  return collector.take();
}

/// |b − K x| / |b| of what is given. Collective.
double relative_residual(const systems::System& system, const algebra::BlockVector& x) {
  algebra::BlockVector r = system.K.zero();
  system.given.apply(x, r);
  for (int i = 0; i < x.n_blocks(); ++i) r[i].update(1.0, system.given_b[i], -1.0);
  const double size = norm(system.given_b);
  return size > 0.0 ? norm(r) / size : norm(r);
}

}  // namespace

Problem::Problem(const OwnRows& rows, const std::string& settings, const CommPtr& comm)
    : comm_(comm) {
  on_all(*comm, [&] { options_ = options_from(settings); });
  const long long n = global_sum(*comm, std::max(rows.count, 0LL));
  throw_if_any<Error>(*comm, fault_of(rows, n));
  TUNICA_CHECK(n > 0, "the matrix has no rows");
  pattern_.comm = comm;
  pattern_.n_rows = pattern_.n_columns = n;
  pattern_.start.assign(rows.offsets, rows.offsets + rows.count + 1);
  pattern_.columns.assign(rows.columns, rows.columns + rows.offsets[rows.count]);
  rows_ = Teuchos::rcp(new Map(n, static_cast<std::size_t>(rows.count), 0, comm));
  set_up(rows.values);
}

Problem::~Problem() = default;

void Problem::set_up(const double* values) {
  const Stopwatch watch;
  throw_if_any<Error>(*comm_, fault_of_numbers(values, pattern_.columns.size(), "values"));
  const long long first = sum_before(*comm_, static_cast<long long>(pattern_.n_local_rows()));
  solver_.reset();
  new_values_.reset();
  system_.reset();
  const Teuchos::ParameterList& of_matrix = options_.sublist("System");
  std::string order;
  systems::Blocks blocks =
      systems::split_whole(in_portions(pattern_, first, values), of_matrix, order);
  system_ = std::make_unique<systems::System>(
      systems::prepared_system(std::move(blocks), of_matrix, order));
  new_values_ = std::make_unique<systems::NewValues>(pattern_, first, *system_);
  solver_ = std::make_unique<SystemSolver>(*system_, options_.sublist("Solvers"));
  solver_->set_up();
  values_.clear();
  if (!system_->border.empty()) values_.assign(values, values + pattern_.columns.size());
  seconds_.set_up = global_max(*comm_, watch.seconds());
}

std::string Problem::refresh(const double* values) {
  const Stopwatch watch;
  throw_if_any<Error>(*comm_, fault_of_numbers(values, pattern_.columns.size(), "values"));
  const std::string reason =
      solver_ ? new_values_->take(values, *system_) : "the last set-up has failed";
  if (reason.empty())
    solver_->refresh();
  else
    set_up(values);
  seconds_.refresh = global_max(*comm_, watch.seconds());
  return reason;
}

Answer Problem::answer_to(const Vector& right, algebra::BlockVector& y) {
  doubts_ = systems::take_right_side(*system_, right);
  y = system_->K.zero();
  Answer answer = solver_->solve(y);
  if (answer.report.is_converged || system_->border.empty()) return answer;
  // Without its border the matrix may be singular in a way that nothing here knows.
  options_.sublist("System").set("border", false).set("exclude", "");
  const std::vector<double> values = values_;
  set_up(values.data());
  return answer_to(right, y);
}

Answer Problem::solve(const double* b, double* x) {
  TUNICA_CHECK(solver_ != nullptr, "the last set-up has failed: refresh with other values first");
  const Stopwatch watch;
  const std::size_t n = pattern_.n_local_rows();
  throw_if_any<Error>(*comm_, fault_of_numbers(b, n, "b"));
  throw_if_any<Error>(*comm_, n > 0 && x == nullptr ? "x is missing" : "");
  Vector right(rows_);
  {
    const auto to = right.getLocalViewHost(overwrite_all);
    for (std::size_t k = 0; k < n; ++k) to(k, 0) = b[k];
  }
  algebra::BlockVector y;
  Answer answer = answer_to(right, y);
  const algebra::BlockVector solution = systems::in_units_of_files(*system_, y);
  residual_ = relative_residual(*system_, solution);
  const Vector mine = systems::in_file_order(*system_, solution, rows_);
  const auto from = mine.getLocalViewHost(read_only);
  for (std::size_t k = 0; k < n; ++k) x[k] = from(k, 0);
  seconds_.solve = global_max(*comm_, watch.seconds());
  return answer;
}

std::string Problem::notes() const {
  std::string text = system_->order + "\n";
  const auto add = [&](const std::vector<std::string>& notes) {
    for (const std::string& note : notes) text += note + "\n";
  };
  add(system_->notes);
  add(system_->remarks);
  add(doubts_);
  return text;
}

std::string Problem::case_in_use() const {
  Teuchos::ParameterList used("Case");
  Teuchos::ParameterList& of_matrix = used.sublist("System");
  of_matrix = options_.sublist("System");
  of_matrix.setParameters(system_->found);
  Teuchos::ParameterList& solvers = used.sublist("Solvers");
  solvers.set("tolerance", solver_->tolerance());
  solvers.sublist("Settings").sublist(solver_->setting().name) = solver_->setting().list;
  return params::to_xml(used);
}

}  // namespace tunica::foreign
