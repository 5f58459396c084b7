#include <hdf5.h>

#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/io/hdf5_arrays.hpp"
#include "tunica/observe/field_kinds.hpp"
#include "unit/run/whole_run.hpp"

namespace {

using namespace tunica;
using test::Whole;

/// A field that the library does not know: at each node of the lumen a concentration that reacts,
///
///   c' = −k c,   (1 + k Δt) c = cⁿ⁻¹,   c(0) = 1 + x_z/mm
///
///   k  rate, 1/ms
class Reaction final : public observe::Field, public fields::Restartable {
public:
  Reaction(std::string name, const Teuchos::ParameterList& list, const fields::FieldMesh& mesh)
      : name_(std::move(name)), mesh_(&mesh), rate_(list.get<double>("rate")) {
    for (int a = 0; a < mesh.n_owned; ++a) c_.push_back(1.0 + mesh.x[a][2]);
  }

  std::string name() const override { return name_; }
  const fields::FieldMesh& mesh() const override { return *mesh_; }
  observe::Parts parts() override { return {{name_, this}}; }
  bool is_solved_behind() const override { return true; }
  nonlinear::NewtonReport solve(const stepping::Clock& clock,
                                const nonlinear::NewtonWatch& watch) override {
    for (double& c : c_) c /= 1.0 + rate_ * clock.step_size();
    nonlinear::NewtonStep step{};
    watch(step);
    nonlinear::NewtonReport report;
    report.is_converged = true;
    report.steps.push_back(step);
    return report;
  }
  discretisation::Observables observe() override {
    double sum = 0.0;
    for (const double c : c_) sum += c;
    return {{name_ + "_total", global_sum(*mesh_->comm, sum)}};
  }
  std::vector<observe::Quantity> quantities() const override { return {{"concentration", "1"}}; }
  observe::Sampler sampler() override {
    Vector owned(mesh_->node_map);
    {
      const auto view = owned.getLocalViewHost(overwrite_all);
      for (std::size_t a = 0; a < c_.size(); ++a) view(a, 0) = c_[a];
    }
    const std::vector<double> c = fields::ghosted_scalars(*mesh_, owned);
    return [c](const std::string&, const fields::Place& at) { return at.value(c); };
  }
  std::string grid_name() const override { return "fluid"; }
  observe::GridFields arrays() override { return {"fluid", {{name_, 1, c_}}, {}}; }

  fields::State save() const override {
    fields::State state = fields::state_on(*mesh_);
    state.arrays["c"] = {1, c_};
    return state;
  }
  std::string restore(const fields::State& state) override {
    c_ = state.array("c", 1).values;
    return "";
  }

private:
  std::string name_;
  const fields::FieldMesh* mesh_;
  double rate_;
  std::vector<double> c_;  ///< of the owned nodes
};

/// Once: the registry is that of the process.
void make_known() {
  static const bool is_known = [] {
    params::Table table("A concentration that reacts.");
    table.number("rate", std::nullopt, params::non_negative(), "1/ms", "of the reaction");
    observe::register_field_kind({"reaction",
                                  "fluid",
                                  table,
                                  {{"concentration", "1"}},
                                  [](const std::string& name, const Teuchos::ParameterList& list,
                                     const fields::FieldMesh& mesh, const observe::FieldContext&) {
                                    return std::make_unique<Reaction>(name, list, mesh);
                                  }});
    return true;
  }();
  static_cast<void>(is_known);
}

constexpr double rate = 0.5, z = 1.3;

std::vector<std::string> settings(int steps) {
  return {"Time/steps=" + std::to_string(steps),
          "Coupling/scheme=monolithic",
          "Fields/tracer/kind=reaction",
          "Fields/tracer/rate=" + std::to_string(rate),
          "Probes/here/quantity=concentration",
          "Probes/here/field=tracer",
          "Probes/here/position={0, 0, " + std::to_string(z) + "}"};
}

TEUCHOS_UNIT_TEST(third_field, is_in_tables_and_files_and_goes_on_to_the_last_digit) {
  make_known();
  const test::Quiet quiet;
  const CommPtr comm = output::test::world();
  const std::string whole = output::test::scratch("third-whole");
  const std::string parts = output::test::scratch("third-parts");
  Whole straight("pulse-tiny.xml", settings(4), whole, comm);
  TEST_ASSERT(straight.simulation.march().is_success());
  {
    Whole first("pulse-tiny.xml", settings(2), parts, comm);
    TEST_ASSERT(first.simulation.march().is_success());
  }
  Whole second("pulse-tiny.xml", settings(4), parts, comm, true);
  TEST_ASSERT(second.simulation.march().is_success());
  TEST_EQUALITY(test::steps_of(second), test::steps_of(straight));

  // Columns, by the closed form of implicit Euler.
  const double dt = straight.list.sublist("Time").get<double>("step size");
  const double left = std::pow(1.0 + rate * dt, -4);
  double probed = 0.0;
  for (const auto& o : straight.simulation.observed())
    if (o.name == "concentration_here_1") probed = o.value;
  TEST_FLOATING_EQUALITY(probed, (1.0 + z) * left, 1e-12);
  const std::string table = output::test::content(whole + "/steps.csv");
  if (comm->getRank() == 0)
    for (const char* column : {"tracer_newton", "tracer_linear", "tracer_total"})
      TEST_ASSERT(table.find(column) != std::string::npos);
  if (comm->getRank() == 0)
    TEST_ASSERT(output::test::content(whole + "/newton.csv").find(",tracer,") != std::string::npos);

  // Arrays at the vertices, in the order of the file.
  const hid_t file = H5Fopen((whole + "/fields.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  TEST_ASSERT(H5Lexists(file, "/step_000004/fluid/tracer", H5P_DEFAULT) > 0);
  H5Fclose(file);
}

TEUCHOS_UNIT_TEST(third_field, is_asked_for_by_names_that_are_checked) {
  make_known();
  const test::Quiet quiet;
  const CommPtr comm = output::test::world();
  const auto refusal = [&](const std::string& with) -> std::string {
    std::vector<std::string> set = settings(1);
    set.push_back(with);
    try {
      Whole("pulse-tiny.xml", set, output::test::scratch("third-wrong"), comm);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  TEST_EQUALITY(refusal("Fields/tracer/rate=0.1"), "");
  TEST_ASSERT(refusal("Probes/here/field=trace").find("\"trace\" is none of them") !=
              std::string::npos);
  TEST_ASSERT(refusal("Fields/tracer/kind=reactoin").find("reaction") != std::string::npos);
  Whole taken("pulse-tiny.xml",
              {"Time/steps=1", "Fields/coupling/kind=reaction", "Fields/coupling/rate=1"},
              output::test::scratch("third-taken"), comm);
  TEST_THROW(taken.simulation.begin(), Error);
}

}  // namespace
