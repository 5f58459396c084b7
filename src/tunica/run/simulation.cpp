#include "tunica/run/simulation.hpp"

#include <iterator>
#include <map>
#include <optional>

#include "tunica/base/error.hpp"
#include "tunica/observe/field_kinds.hpp"
#include "tunica/observe/fluid_field.hpp"
#include "tunica/observe/surface_report.hpp"
#include "tunica/observe/wall_field.hpp"
#include "tunica/run/budget_report.hpp"
#include "tunica/run/checkpoints.hpp"
#include "tunica/run/field_problems.hpp"
#include "tunica/run/field_series.hpp"
#include "tunica/run/run_log.hpp"
#include "tunica/run/watch.hpp"

namespace tunica::run {

namespace {

/// As they stand in tables and files: the wall before the fluid, then those of the list "Fields".
std::vector<std::unique_ptr<observe::Field>> fields_of(const FieldProblems& problems) {
  const setup::Case& the_case = problems.the_case;
  std::vector<std::unique_ptr<observe::Field>> all;
  if (problems.wall)
    all.push_back(
        std::make_unique<observe::WallField>(*problems.wall, the_case.output.wall_arrays));
  if (problems.fluid)
    all.push_back(std::make_unique<observe::FluidField>(
        observe::ShearAverages{the_case.output.averages_from, the_case.time->is_steady_sought()},
        *problems.fluid, problems.motion.get()));
  if (!the_case.list.isSublist("Fields")) return all;
  const Teuchos::ParameterList& more = the_case.list.sublist("Fields");
  const observe::FieldContext others{the_case.list, problems.fluid.get(), problems.wall.get(),
                                     problems.motion.get()};
  for (auto it = more.begin(); it != more.end(); ++it) {
    const std::string& name = more.name(it);
    for (const char* taken : {"fluid", "wall", "mesh motion", "wall shear", "coupling"})
      TUNICA_CHECK(name != taken, "Fields / " + name + ": the name is taken. Choose another.");
    const observe::FieldKind& kind = observe::kind_of(more.sublist(name));
    all.push_back(kind.make(name, more.sublist(name), problems.domain->mesh(kind.region), others));
  }
  return all;
}

}  // namespace

struct Simulation::Impl {
  Impl(const setup::Case& the_case, const Domain& domain, RunOutput& to)
      : problems(the_case, domain), output(&to), comm(domain.comm), watch(the_case) {}

  bool is_coupled() const { return problems.scheme != nullptr; }
  bool is_begun() const { return log.has_value(); }

  problems::FieldProblem& alone() const {
    if (problems.fluid) return *problems.fluid;
    return *problems.wall;
  }
  void record_unknowns() const;
  observe::Parts parts();
  void open_files();
  StepSummary attempt(const stepping::Clock& clock, int number);
  StepSummary step_coupled(const stepping::Clock& clock);
  template <class Problem>
  StepSummary step_alone(Problem& problem, const std::string& name, const stepping::Clock& clock);
  void step_behind(const stepping::Clock& clock, StepSummary& step);
  StepSummary make_step();
  void observe();
  void write_fields();
  void begin_budget();
  void keep_budget(const StepSummary& step);

  FieldProblems problems;
  RunOutput* output;
  CommPtr comm;
  Watch watch;

  // from begin() on
  std::vector<std::unique_ptr<observe::Field>> fields;
  std::optional<observe::Budget> budget;  ///< of a case that wants one
  std::optional<BudgetReport> budget_report;
  std::optional<TimeMarch> march;
  std::optional<observe::SurfaceReport> surfaces;
  std::optional<Checkpoints> checkpoints;
  std::optional<RunLog> log;
  std::optional<FieldSeries> series;
  discretisation::Observables observed;
};

void Simulation::Impl::record_unknowns() const {
  if (!is_coupled())
    return tell_unknowns(output->record, problems.fluid ? "fluid" : "wall", *alone().space());
  for (const auto& [name, system] : problems.scheme->systems())
    tell_unknowns(output->record, name, *system->last_jacobian().space());
}

/// All that a step changes and the next one needs.
observe::Parts Simulation::Impl::parts() {
  observe::Parts all;
  for (const auto& field : fields)
    for (const auto& part : field->parts()) all.push_back(part);
  if (is_coupled()) all.emplace_back("coupling", problems.scheme.get());
  if (budget) all.emplace_back("budget", &*budget);
  return all;
}

// A run that goes on knows what is stored by its checkpoint.
void Simulation::Impl::begin_budget() {
  const setup::Case& the_case = problems.the_case;
  const observe::BudgetSettings wanted = observe::budget_settings(the_case.list.sublist("Output"));
  if (!wanted.is_wanted) return;
  const bool has_prestress = the_case.wall && the_case.wall->options.has_prestress;
  const bool is_static = the_case.wall && the_case.wall->options.is_static;
  budget.emplace(wanted, problems.fluid.get(), problems.wall.get(),
                 !output->restart && !the_case.time->from && !has_prestress,
                 !is_static && !the_case.time->is_steady_sought());
  budget_report.emplace(*output, comm->getRank() == 0);
}

void Simulation::Impl::keep_budget(const StepSummary& step) {
  if (!budget || !step.is_accepted) return;
  const stepping::Clock& clock = march->clock();
  budget_report->step(clock, budget->add(clock.step_size(), step.is_converged, observed), *budget,
                      *log);
}

void Simulation::Impl::open_files() {
  const std::vector<std::string> one{problems.fluid ? "fluid" : "wall"};
  log.emplace(*output, comm->getRank() == 0, is_coupled() ? problems.scheme->fields() : one,
              is_coupled() ? problems.scheme->stages() : std::vector<std::string>());
  std::vector<output::Grid> grids;
  for (const auto& field : fields)
    if (field->grid_name() == field->name()) grids.push_back(field->grid());
  series.emplace(*output, grids, comm);
}

StepSummary Simulation::Impl::attempt(const stepping::Clock& clock, int number) {
  log->begin({clock.step(), clock.time(), is_coupled() ? 1 : 0, number});
  StepSummary step = is_coupled()     ? step_coupled(clock)
                     : problems.fluid ? step_alone(*problems.fluid, "fluid", clock)
                                      : step_alone(*problems.wall, "wall", clock);
  step_behind(clock, step);
  return step;
}

StepSummary Simulation::Impl::step_coupled(const stepping::Clock& clock) {
  coupling::Scheme& scheme = *problems.scheme;
  const Outcome begun = scheme.begin_step(clock);
  if (begun.is_failure()) return summary_of(begun, scheme.fields());
  const coupling::Report report = scheme.solve_step(
      clock, [this](int, const coupling::Iteration& iteration) { log->coupling(iteration); });
  if (!report.remark.empty()) log->warn(report.remark);
  return summary_of(report, scheme.fields());
}

template <class Problem>
StepSummary Simulation::Impl::step_alone(Problem& problem, const std::string& name,
                                         const stepping::Clock& clock) {
  problem.begin_step(clock);
  const nonlinear::NewtonReport report = problem.solve();
  if (report.is_converged) problem.end_step();
  return summary_of(report, name, clock);
}

/// The fields that nothing else solves for: each looks at those before it.
void Simulation::Impl::step_behind(const stepping::Clock& clock, StepSummary& step) {
  for (const auto& field : fields) {
    if (!field->is_solved_behind()) continue;
    const std::string name = field->name();
    if (!step.is_accepted) {  // its columns are there all the same
      step.fields.push_back({name});
      continue;
    }
    const auto watch_newton = [&](const nonlinear::NewtonStep& of) { log->newton(name, of); };
    const StepSummary own = summary_of(field->solve(clock, watch_newton), name, clock);
    step.fields.push_back(own.fields.front());
    if (own.is_converged) continue;
    step.is_converged = step.is_accepted = false;
    step.reason = own.reason;
  }
}

StepSummary Simulation::Impl::make_step() {
  StepSummary step = march->make_step(
      [this](const stepping::Clock& clock, int number) { return attempt(clock, number); }, *log);
  const stepping::Clock& clock = march->clock();
  if (step.is_accepted)
    for (const auto& field : fields) field->accept(clock);
  observe();
  log->step(clock, step, observed);
  keep_budget(step);
  const std::function<std::vector<judge::LayerVolume>()> volumes = [this] {
    return judge::layer_volumes(*problems.wall);
  };
  watch.tell(*log, clock, step, observed, is_coupled() ? &problems.fluid->mesh() : nullptr,
             is_coupled() ? problems.motion->displacement() : std::vector<Vec3>(),
             problems.wall ? volumes : nullptr);
  return step;
}

void Simulation::Impl::observe() {
  observed.clear();
  const auto add = [this](const discretisation::Observables& more) {
    observed.insert(observed.end(), more.begin(), more.end());
  };
  for (const auto& field : fields) add(field->observe());
  add(problems.domain->probes.observe(fields));
  add(surfaces->observe());
}

void Simulation::Impl::write_fields() {
  if (!series->is_due(march->clock())) return;
  std::map<std::string, observe::GridFields> grids;
  for (const auto& field : fields) {
    observe::GridFields own = field->arrays();
    observe::GridFields& all = grids.try_emplace(own.grid).first->second;
    all.grid = own.grid;
    std::move(own.points.begin(), own.points.end(), std::back_inserter(all.points));
    std::move(own.cells.begin(), own.cells.end(), std::back_inserter(all.cells));
  }
  std::vector<observe::GridFields> list;
  for (auto& [name, grid] : grids) list.push_back(std::move(grid));
  series->write(march->clock(), std::move(list));
}

Simulation::Simulation(const setup::Case& the_case, const Domain& domain, RunOutput& output)
    : impl_(std::make_unique<Impl>(the_case, domain, output)) {}

Simulation::~Simulation() = default;

Outcome Simulation::begin() {
  Impl& run = *impl_;
  FieldProblems& problems = run.problems;
  TUNICA_CHECK(!run.is_begun(), "a simulation begins once");
  const Outcome started = problems.start(*run.output);
  if (started.is_failure() || !run.output->stopped.empty()) return started;
  run.record_unknowns();
  run.fields = fields_of(problems);
  run.begin_budget();
  run.march.emplace(problems.the_case, run.parts(), *run.output);
  for (const auto& field : run.fields) run.march->judge(*field);
  run.surfaces.emplace(problems.the_case.output.surfaces,
                       observe::force_groups_in(problems.the_case.list), run.fields);
  run.checkpoints.emplace(*run.output, *run.march, problems.the_case.time->wall_limit, run.comm);
  run.checkpoints->begin();
  run.open_files();
  const auto watch_newton = [&run](const std::string& field, const nonlinear::NewtonStep& step) {
    run.log->newton(field, step);
  };
  if (run.is_coupled())
    problems.scheme->watch_newton(watch_newton);
  else
    run.alone().watch_newton([watch_newton, name = problems.fluid ? "fluid" : "wall"](
                                 const auto& step) { watch_newton(name, step); });
  return Outcome::success();
}

bool Simulation::is_done() const {
  return !impl_->output->stopped.empty() || (impl_->is_begun() && impl_->march->is_done());
}

Outcome Simulation::step() {
  Impl& run = *impl_;
  TUNICA_CHECK(run.is_begun(), "a simulation steps after begin()");
  return run.checkpoints->guard([&run] {
    const StepSummary step = run.make_step();
    if (!step.is_accepted) return run.checkpoints->give_up(step.reason);
    run.march->end_step();
    run.write_fields();
    run.checkpoints->end_step();
    return Outcome::success();
  });
}

Outcome Simulation::finish() {
  Impl& run = *impl_;
  if (!run.is_begun()) return Outcome::success();
  run.series->finish();
  if (run.budget) run.budget_report->finish(*run.budget);
  for (const auto& field : run.fields)
    if (field->throughput() != nullptr)
      record_assembly(run.output->record, field->name(), *field->throughput(), *run.comm);
  return run.march->outcome();
}

Outcome Simulation::march() {
  Outcome outcome = begin();
  while (outcome.is_success() && !is_done()) outcome = step();
  return outcome.is_success() ? finish() : outcome;
}

int Simulation::steps_made() const { return impl_->is_begun() ? impl_->march->last_ended() : 0; }

double Simulation::time() const { return impl_->is_begun() ? impl_->march->time_of_last() : 0.0; }

const discretisation::Observables& Simulation::observed() const { return impl_->observed; }

std::vector<std::string> Simulation::field_names() const {
  std::vector<std::string> names;
  for (const auto& field : impl_->fields) names.push_back(field->name());
  return names;
}

observe::Field& Simulation::field(const std::string& name) const {
  std::string names;
  for (const auto& field : impl_->fields) {
    if (field->name() == name) return *field;
    names += (names.empty() ? "" : ", ") + field->name();
  }
  throw Error("the case has no field \"" + name + "\", but: " + names);
}

}  // namespace tunica::run
