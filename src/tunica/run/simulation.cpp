#include "tunica/run/simulation.hpp"

#include <optional>

#include "tunica/base/error.hpp"
#include "tunica/base/told_apart.hpp"
#include "tunica/observe/surface_report.hpp"
#include "tunica/observe/wall_shear.hpp"
#include "tunica/run/checkpoints.hpp"
#include "tunica/run/field_problems.hpp"
#include "tunica/run/field_series.hpp"
#include "tunica/run/run_log.hpp"
#include "tunica/run/watch.hpp"

namespace tunica::run {

namespace {

const fields::FieldMesh* pointer(const std::optional<fields::FieldMesh>& mesh) {
  return mesh ? &*mesh : nullptr;
}

}  // namespace

struct Simulation::Impl {
  Impl(const Teuchos::ParameterList& list, const Domain& domain, RunOutput& to)
      : fields(list, domain), output(&to),
        comm(domain.fluid ? domain.fluid->comm : domain.wall->comm) {}

  bool is_coupled() const { return fields.scheme != nullptr; }
  bool is_begun() const { return log.has_value(); }

  void record_unknowns() const;
  Parts parts() const;
  void open_files();
  StepSummary solve(const stepping::Clock& clock, int attempt);
  StepSummary solve_coupled(const stepping::Clock& clock);
  template <class Problem>
  StepSummary solve_alone(Problem& problem, const std::string& name, const stepping::Clock& clock);
  StepSummary make_step();
  void observe();
  std::vector<output::Grid> grids() const;
  std::vector<observe::GridFields> arrays() const;
  void write_fields();

  FieldProblems fields;
  RunOutput* output;
  CommPtr comm;

  // from begin() on
  std::optional<observe::WallShear> shear;
  std::optional<TimeMarch> march;
  std::optional<observe::SurfaceReport> surfaces;
  std::optional<Checkpoints> checkpoints;
  std::optional<RunLog> log;
  std::optional<Watch> watch;
  std::optional<observe::WallOutput> wall_output;
  std::optional<FieldSeries> series;
  discretisation::Observables observed;
};

void Simulation::Impl::record_unknowns() const {
  if (!is_coupled()) {
    const std::string name = fields.fluid ? "fluid" : "wall";
    const problems::FieldProblem& field =
        fields.fluid ? static_cast<const problems::FieldProblem&>(*fields.fluid) : *fields.wall;
    return tell_unknowns(output->record, name, *field.space());
  }
  for (const auto& [name, system] : fields.scheme->systems())
    tell_unknowns(output->record, name, *system->last_jacobian().space());
}

/// All that a step changes and the next one needs.
Parts Simulation::Impl::parts() const {
  Parts all;
  if (fields.fluid) all.emplace_back("fluid", fields.fluid.get());
  if (fields.wall) all.emplace_back("wall", fields.wall.get());
  if (is_coupled()) all.emplace_back("mesh motion", fields.motion.get());
  if (is_coupled()) all.emplace_back("coupling", fields.scheme.get());
  return all;
}

void Simulation::Impl::open_files() {
  const std::vector<std::string> alone{fields.fluid ? "fluid" : "wall"};
  log.emplace(*output, comm->getRank() == 0, is_coupled() ? fields.scheme->fields() : alone,
              is_coupled() ? fields.scheme->stages() : std::vector<std::string>());
  watch.emplace(fields.list);
  if (fields.wall) wall_output.emplace(*fields.wall, fields.list.sublist("Output"));
  series.emplace(*output, grids(), comm);
}

StepSummary Simulation::Impl::solve(const stepping::Clock& clock, int attempt) {
  log->begin({clock.step(), clock.time(), is_coupled() ? 1 : 0, attempt});
  if (is_coupled()) return solve_coupled(clock);
  return fields.fluid ? solve_alone(*fields.fluid, "fluid", clock)
                      : solve_alone(*fields.wall, "wall", clock);
}

StepSummary Simulation::Impl::solve_coupled(const stepping::Clock& clock) {
  coupling::Scheme& scheme = *fields.scheme;
  const Outcome begun = scheme.begin_step(clock);
  if (begun.is_failure()) return summary_of(begun, scheme.fields());
  const coupling::Report report = scheme.solve_step(
      clock, [this](int, const coupling::Iteration& iteration) { log->coupling(iteration); });
  if (!report.remark.empty()) log->warn(report.remark);
  return summary_of(report, scheme.fields());
}

template <class Problem>
StepSummary Simulation::Impl::solve_alone(Problem& problem, const std::string& name,
                                          const stepping::Clock& clock) {
  problem.begin_step(clock);
  const nonlinear::NewtonReport report = problem.solve();
  if (report.is_converged) problem.end_step();
  return summary_of(report, name, clock);
}

StepSummary Simulation::Impl::make_step() {
  StepSummary step = march->make_step(
      [this](const stepping::Clock& clock, int attempt) { return solve(clock, attempt); }, *log);
  const stepping::Clock& clock = march->clock();
  if (shear && step.is_accepted) shear->accept(clock);
  observe();
  log->step(clock, step, observed);
  const std::function<std::vector<judge::LayerVolume>()> volumes = [this] {
    return judge::layer_volumes(*fields.wall);
  };
  watch->tell(*log, clock, step, observed, is_coupled() ? &fields.fluid->mesh() : nullptr,
              is_coupled() ? fields.motion->displacement() : std::vector<Vec3>(),
              fields.wall ? volumes : nullptr);
  return step;
}

void Simulation::Impl::observe() {
  const observe::Probes& probes = fields.domain->probes;
  observed.clear();
  const auto add = [this](const discretisation::Observables& more) {
    observed.insert(observed.end(), more.begin(), more.end());
  };
  if (fields.wall) add(fields.wall->observe());
  if (fields.fluid) add(fields.fluid->observe());
  if (shear) add(shear->observe());
  add(probes.observe(fields.fluid.get(), fields.wall.get()));
  add(surfaces->observe(fields.fluid.get(), fields.wall.get()));
}

std::vector<output::Grid> Simulation::Impl::grids() const {
  std::vector<output::Grid> all;
  if (fields.fluid) all.push_back(observe::grid_of(fields.fluid->mesh(), "fluid"));
  if (fields.wall) all.push_back(wall_output->grid());
  return all;
}

std::vector<observe::GridFields> Simulation::Impl::arrays() const {
  std::vector<observe::GridFields> all;
  if (fields.fluid) {
    std::vector<output::Array> of_fluid = observe::fluid_arrays(
        *fields.fluid, is_coupled() ? fields.motion->displacement() : std::vector<Vec3>());
    for (output::Array& array : shear->arrays()) of_fluid.push_back(std::move(array));
    all.push_back({"fluid", std::move(of_fluid), {}});
  }
  if (fields.wall) all.push_back(wall_output->fields());
  return all;
}

void Simulation::Impl::write_fields() {
  if (series->is_due(march->clock())) series->write(march->clock(), arrays());
}

Simulation::Simulation(const Teuchos::ParameterList& list, const Domain& domain, RunOutput& output)
    : impl_(std::make_unique<Impl>(list, domain, output)) {}

Simulation::~Simulation() = default;

Outcome Simulation::begin() {
  Impl& run = *impl_;
  FieldProblems& fields = run.fields;
  TUNICA_CHECK(!run.is_begun(), "a simulation begins once");
  const Outcome started = fields.start(*run.output);
  if (started.is_failure() || !run.output->stopped.empty()) return started;
  run.record_unknowns();
  Parts parts = run.parts();
  if (fields.fluid) {
    run.shear.emplace(fields.list, *fields.fluid);
    parts.emplace_back("wall shear", &*run.shear);
  }
  run.march.emplace(fields.list, parts, *run.output);
  if (fields.fluid) run.march->judge(*fields.fluid);
  if (fields.wall) run.march->judge(*fields.wall);
  run.surfaces.emplace(fields.list.sublist("Output"), pointer(fields.domain->fluid),
                       pointer(fields.domain->wall));
  run.checkpoints.emplace(*run.output, *run.march, wall_limit(fields.list), run.comm);
  run.checkpoints->begin();
  run.open_files();
  const auto watch_newton = [&run](const std::string& field, const nonlinear::NewtonStep& step) {
    run.log->newton(field, step);
  };
  if (run.is_coupled())
    fields.scheme->watch_newton(watch_newton);
  else if (fields.fluid)
    fields.fluid->watch_newton([=](const auto& step) { watch_newton("fluid", step); });
  else
    fields.wall->watch_newton([=](const auto& step) { watch_newton("wall", step); });
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
  if (run.fields.fluid)
    record_assembly(run.output->record, "fluid", run.fields.fluid->jacobian_throughput(),
                    *run.comm);
  if (run.fields.wall)
    record_assembly(run.output->record, "wall", run.fields.wall->jacobian_throughput(), *run.comm);
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
  if (impl_->fields.fluid) names.emplace_back("fluid");
  if (impl_->fields.wall) names.emplace_back("wall");
  return names;
}

const problems::FieldProblem& Simulation::field(const std::string& name) const {
  if (name == "fluid" && impl_->fields.fluid) return *impl_->fields.fluid;
  if (name == "wall" && impl_->fields.wall) return *impl_->fields.wall;
  std::string names;
  for (const std::string& known : field_names()) names += (names.empty() ? "" : ", ") + known;
  throw Error("the case has no field \"" + name + "\", but: " + names);
}

}  // namespace tunica::run
