#include "tunica/judge/loads.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tunica/boundary/registry.hpp"
#include "tunica/stepping/step_control.hpp"
#include "tunica/stepping/time_function.hpp"

namespace tunica::judge {

namespace {

std::vector<double> even_times(double end) {
  constexpr int n = 2000;
  std::vector<double> times;
  for (int k = 0; k <= n; ++k) times.push_back(end * k / n);
  return times;
}

std::vector<double> sample_times(const Teuchos::ParameterList& list, double end) {
  std::vector<double> times = even_times(end);
  const double slack = 1e-6 * end;  // a table of steps has its next value behind a kink
  for (const double t : stepping::kinks(list, end))
    for (const double s : {t - slack, t, t + slack})
      if (s >= 0.0 && s <= end) times.push_back(s);
  std::sort(times.begin(), times.end());
  return times;
}

/// Of one condition: its size times the amplitude.
class Course {
public:
  Course(const Teuchos::ParameterList& condition, double size) : size_(size) {
    if (condition.isSublist("Amplitude"))
      amplitude_ = stepping::TimeFunction(condition.sublist("Amplitude"));
  }
  double operator()(double time) const { return size_ * amplitude_(time); }
  double peak(const std::vector<double>& times) const {
    double most = 0.0;
    for (const double t : times) most = std::max(most, std::abs((*this)(t)));
    return most;
  }
  /// Up to the last time of a table that is not repeated; 0 where there is none [ms].
  double table() const { return amplitude_.period() > 0.0 ? 0.0 : amplitude_.span(); }
  /// In all of its course, also where the run is shorter.
  double peak_of_course() const { return peak(even_times(amplitude_.span())); }
  /// Over a period, also where the run is shorter, or else over the run.
  double mean(double end) const {
    constexpr int n = 4000;
    const double span = amplitude_.period() > 0.0 ? amplitude_.period() : end;
    double sum = 0.0;
    for (int k = 0; k < n; ++k) sum += (*this)(span * (k + 0.5) / n);
    return sum / n;
  }

private:
  double size_;
  stepping::TimeFunction amplitude_;
};

double area_of(const std::vector<Vessel::Opening>& openings, const std::string& surface) {
  for (const Vessel::Opening& o : openings)
    if (o.surface == surface) return o.area;
  return 0.0;
}

void note_pressure(double peak, const std::string& where, Loads& loads) {
  if (peak <= loads.peak_pressure) return;
  loads.peak_pressure = peak;
  loads.pressure_surface = where;
}

/// course: the peak of all of the amplitude's course.
void note_flow(double peak, double course, double area, const std::string& surface, Loads& loads) {
  if (area == 0.0) return;
  if (course / area > loads.course_speed) {
    loads.course_speed = course / area;
    loads.speed_surface = surface;
  }
  if (peak == 0.0) return;
  loads.peak_speed = std::max(loads.peak_speed, peak / area);
  if (peak <= loads.peak_flow) return;
  loads.peak_flow = peak;
  loads.flow_area = area;
  loads.flow_surface = surface;
}

/// Σ Q̄ = Σ (p̄ − p_d)/R
std::optional<Loads::Balance> balance_of(const std::vector<double>& inflows,
                                         const std::vector<boundary::Drive::Outlet>& outlets) {
  Loads::Balance balance{std::accumulate(inflows.begin(), inflows.end(), 0.0), 0.0, 0.0};
  double from_distal = 0.0, conductance = 0.0;
  bool is_expected = true;
  for (const boundary::Drive::Outlet& o : outlets) {
    if (o.resistance == 0.0) return std::nullopt;
    conductance += 1.0 / o.resistance;
    from_distal += o.distal_pressure / o.resistance;
    balance.mean_flow += o.mean_flow;
    is_expected = is_expected && o.mean_flow != 0.0;
  }
  if (conductance == 0.0) return std::nullopt;
  balance.pressure = (balance.inflow + from_distal) / conductance;
  if (!is_expected) balance.mean_flow = 0.0;
  return balance;
}

/// What conditions of the fluid drive it by, in time.
struct Driven {
  std::vector<Course> pressing;
  std::vector<double> inflows;  ///< means
  std::vector<boundary::Drive::Outlet> outlets;
};

void visit_opening(const boundary::Condition& c, double area, const std::vector<double>& times,
                   Driven& driven, Loads& loads) {
  using Kind = boundary::Drive::Kind;
  const boundary::Drive drive = c.drive(boundary::Field::fluid);
  const Course course(c.list, drive.size);
  const bool flows = drive.kind == Kind::velocity || drive.kind == Kind::flow;
  if (flows && course.table() > 0.0)
    loads.flow_table =
        loads.flow_table > 0.0 ? std::min(loads.flow_table, course.table()) : course.table();
  switch (drive.kind) {
    case Kind::velocity:
      note_flow(area * course.peak(times), area * course.peak_of_course(), area, c.surface, loads);
      break;
    case Kind::flow:
      note_flow(course.peak(times), course.peak_of_course(), area, c.surface, loads);
      driven.inflows.push_back(course.mean(loads.end));
      break;
    case Kind::pressure:
      loads.first_pressures.emplace_back(c.surface, course(0.0));
      [[fallthrough]];
    case Kind::traction:
      note_pressure(course.peak(times), "Fluid / Surfaces / " + c.surface, loads);
      driven.pressing.push_back(course);
      break;
    case Kind::file:
      loads.has_data = true;
      break;
    case Kind::motion:
    case Kind::none:
      break;
  }
  if (!drive.outlet) return;
  driven.outlets.push_back(*drive.outlet);
  loads.has_outlets = true;
}

/// What presses on the openings, in time.
std::vector<Course> visit_fluid(const problems::FluidSettings& fluid,
                                const std::vector<Vessel::Opening>& openings,
                                const std::vector<double>& times, Loads& loads) {
  Driven driven;
  std::vector<std::string> named;
  for (const boundary::Condition& c : fluid.options.conditions) {
    named.push_back(c.surface);
    visit_opening(c, area_of(openings, c.surface), times, driven, loads);
  }
  for (const Vessel::Opening& o : openings)
    if (std::find(named.begin(), named.end(), o.surface) == named.end()) {
      driven.pressing.emplace_back(Teuchos::ParameterList(), 0.0);
      loads.bare.push_back(o.surface);
    }
  if (openings.size() == driven.inflows.size() + driven.outlets.size() && !driven.inflows.empty())
    loads.balance = balance_of(driven.inflows, driven.outlets);
  return driven.pressing;
}

void visit_wall(const problems::SolidSettings& wall, const std::vector<double>& times,
                Loads& loads) {
  using Kind = boundary::Drive::Kind;
  for (const boundary::Condition& c : wall.options.conditions) {
    const boundary::Drive drive = c.drive(boundary::Field::wall);
    const Course course(c.list, drive.size);
    const double peak = course.peak(times);
    if (drive.kind == Kind::pressure || drive.kind == Kind::traction)
      loads.on_wall.push_back({c.surface, drive.kind == Kind::pressure, course(0.0)});
    if (drive.kind == Kind::pressure) note_pressure(peak, "Wall / Surfaces / " + c.surface, loads);
    if (drive.kind == Kind::file) loads.has_data = true;
    if (peak > 0.0) loads.are_zero = false;
  }
  note_pressure(wall.prestress.pressure, "Wall / Prestress", loads);
  if (norm(wall.options.body_force) > 0.0) loads.are_zero = false;
}

void note_difference(const std::vector<Course>& pressing, const std::vector<double>& times,
                     Loads& loads) {
  if (pressing.empty()) return;
  double impulse = 0.0, last_time = 0.0, last = 0.0;
  for (const double t : times) {
    double low = 1e300, high = pressing.size() > 1 ? -1e300 : 0.0;
    for (const Course& p : pressing) {
      low = std::min(low, p(t));
      high = std::max(high, p(t));
    }
    if (pressing.size() == 1) low = std::min(low, 0.0);
    const double difference = high - low;
    loads.pressure_difference = std::max(loads.pressure_difference, difference);
    impulse += 0.5 * (difference + last) * (t - last_time);
    last_time = t;
    last = difference;
  }
  loads.impulse = impulse;
}

/// How far an amplitude strays from a straight line within steps of dt.
double strays(const stepping::TimeFunction& amplitude, double dt, double end) {
  const double steps = std::min(std::ceil(end / dt), 1e5);
  double most = 0.0;
  const auto look = [&](double n, double s) {
    const double line = (1.0 - s) * amplitude(n * dt) + s * amplitude((n + 1.0) * dt);
    most = std::max(most, std::abs(amplitude((n + s) * dt) - line));
  };
  for (double n = 0.0; n < steps; ++n)
    for (const double s : {0.25, 0.5, 0.75}) look(n, s);
  for (const double t : amplitude.kinks(end))
    if (t > 0.0 && t < end) look(std::floor(t / dt), t / dt - std::floor(t / dt));
  return most > 1e-9 ? most : 0.0;
}

/// 1 where a table of steps changes twice within dt.
double skips(const stepping::TimeFunction& amplitude, double dt, double end) {
  double before = 0.0;
  for (const double t : amplitude.kinks(end)) {
    if (t <= 0.0 || t >= end) continue;
    if (t - before < 0.99 * dt) return 1.0;
    before = t;
  }
  return 0.0;
}

/// Of an amplitude up to a time.
struct Extremes {
  double low, high, slope;
};
Extremes extremes(const stepping::TimeFunction& amplitude, double end) {
  constexpr int n = 2000;
  Extremes found{amplitude(0.0), amplitude(0.0), 0.0};
  for (int k = 1; k <= n; ++k) {
    const double value = amplitude(end * k / n);
    found.slope = std::max(found.slope, std::abs(value - amplitude(end * (k - 1) / n)) * n / end);
    found.low = std::min(found.low, value);
    found.high = std::max(found.high, value);
  }
  return found;
}

void visit_amplitude(const Teuchos::ParameterList& list, double dt, Loads& loads) {
  const stepping::TimeFunction amplitude(list);
  const double period = amplitude.period();
  if (period > 0.0 &&
      std::find(loads.periods.begin(), loads.periods.end(), period) == loads.periods.end())
    loads.periods.push_back(period);
  if (const double gap = stepping::gap_in_period(list); gap > loads.gap) {
    loads.gap = gap;
    loads.gap_period = period;
  }
  const auto [low, high, slope] = extremes(amplitude, loads.end);
  if (slope == 0.0) return;
  const auto [least, most] = amplitude.table_range();
  if (least < most)
    loads.overshoot =
        std::max(loads.overshoot, std::max(least - low, high - most) / (most - least));
  const Extremes course = extremes(amplitude, std::max(amplitude.span(), loads.end));
  const double rise = (course.high - course.low) / std::max(slope, course.slope);
  if (loads.rise == 0.0 || rise < loads.rise) loads.rise = rise;
  if (dt == 0.0) return;
  const bool has_steps =
      list.isParameter("interpolation") && list.get<std::string>("interpolation") == "steps";
  const double largest = std::max(std::abs(low), std::abs(high));
  loads.missed =
      std::max(loads.missed, has_steps ? skips(amplitude, dt, loads.end)
                                       : std::min(1.0, strays(amplitude, dt, loads.end) / largest));
}

/// The amplitudes in the list and below it.
void visit_amplitudes(const Teuchos::ParameterList& list, double dt, Loads& loads) {
  for (auto it = list.begin(); it != list.end(); ++it) {
    if (!list.isSublist(list.name(it))) continue;
    const Teuchos::ParameterList& inner = list.sublist(list.name(it));
    if (list.name(it) == "Amplitude")
      visit_amplitude(inner, dt, loads);
    else
      visit_amplitudes(inner, dt, loads);
  }
}

}  // namespace

Loads loads_of(const setup::Case& the_case, const std::vector<Vessel::Opening>& openings) {
  Loads loads;
  const stepping::StepControlOptions& time = the_case.time->steps;
  const bool is_fixed = !time.is_adaptive && !time.pseudo_time;
  loads.end = time.end;
  const std::vector<double> times = sample_times(the_case.list, loads.end);
  if (the_case.fluid)
    note_difference(visit_fluid(*the_case.fluid, openings, times, loads), times, loads);
  if (the_case.wall) visit_wall(*the_case.wall, times, loads);
  visit_amplitudes(the_case.list, is_fixed ? time.first_step : 0.0, loads);
  loads.are_zero =
      loads.are_zero && !loads.has_data && loads.peak_pressure == 0.0 && loads.peak_flow == 0.0;
  return loads;
}

}  // namespace tunica::judge
