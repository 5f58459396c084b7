#include "tunica/judge/sanity.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/base/formatted.hpp"
#include "tunica/boundary/registry.hpp"
#include "tunica/discretisation/fluid_options.hpp"
#include "tunica/discretisation/solid_options.hpp"
#include "tunica/io/messages.hpp"
#include "tunica/judge/openings.hpp"
#include "tunica/judge/stiffness.hpp"
#include "tunica/judge/units.hpp"
#include "tunica/materials/viscosity_law.hpp"
#include "tunica/stepping/step_control.hpp"

namespace tunica::judge {

namespace {

class Judge {
public:
  Judge(const setup::Case& the_case, const Vessel& vessel)
      : case_(the_case), vessel_(vessel), loads_(loads_of(the_case, vessel.openings)),
        time_(the_case.time->steps) {
    if (vessel.fluid) fluid_ = the_case.fluid->options;
    if (vessel.wall) wall_ = the_case.wall->options;
    is_static_ = vessel.wall && wall_.is_static;
  }

  Sanity verdict() {
    doubts_ = doubts_of_units(case_, loads_);  // first, as others follow from them
    if (vessel_.fluid) mesh("fluid", *vessel_.fluid);
    if (vessel_.wall) mesh("wall", *vessel_.wall);
    shape();
    if (vessel_.wall) stiffness();
    loads();
    openings();
    if (vessel_.fluid) flow();
    if (vessel_.fluid) times();
    if (has_fixed_steps()) steps();
    found_.rows = std::move(rows_);
    found_.doubts = std::move(doubts_);
    brief();
    return found_;
  }

private:
  void row(const std::string& what, const std::string& found, const std::string& usual) {
    rows_.push_back({what, found, usual});
  }
  bool has_fixed_steps() const {
    return !time_.is_adaptive && !time_.pseudo_time && !is_static_ && time_.first_step > 0.0;
  }
  void mesh(const char* field, const ElementShapes& shapes);
  void shape();
  void stiffness();
  void held();
  void loads();
  void openings();
  void flow();
  double driven_speed(std::string& how) const;
  void times();
  void steps();
  void waves();
  void brief();

  const setup::Case& case_;
  const Vessel& vessel_;
  Loads loads_;
  stepping::StepControlOptions time_;
  discretisation::FluidOptions fluid_{};
  discretisation::SolidOptions wall_{};
  bool is_static_ = false;
  Sanity found_;
  std::vector<Sanity::Row> rows_;
  std::vector<std::string> doubts_;
};

void Judge::mesh(const char* field, const ElementShapes& s) {
  row(formatted("%s, quality of elements", field),
      formatted("worst %.3f, median %.2f", s.worst_quality, s.median_quality), "above 0.1, 0.6");
  row(formatted("%s, least angle between faces", field), formatted("%.1f degrees", s.least_angle),
      "above 8");
  row(formatted("%s, largest to smallest volume", field), formatted("%.3g", s.volume_ratio),
      "below 1000");
  const Vec3& x = s.worst_place;
  if (s.worst_quality < 0.05 || s.least_angle < 3.0)
    doubts_.push_back(
        formatted("the %s has an element of quality %.3f at (%.3g, %.3g, %.3g), and angles down to "
                  "%.1f degrees; usual are 0.1 and 8 degrees. Remesh or smooth there: solvers slow "
                  "down, and this element is the first to be inverted.",
                  field, s.worst_quality, x[0], x[1], x[2], s.least_angle));
  if (s.volume_ratio > 1e5)
    doubts_.push_back(
        formatted("the largest element of the %s has %.2g times the volume of the smallest; usual "
                  "is below 1000. Look for a cluster of tiny elements.",
                  field, s.volume_ratio));
  if (s.pieces.size() > 1)
    doubts_.push_back(formatted(
        "the %s consists of %d pieces that do not touch, of %d and %d tetrahedra at most; a vessel "
        "is one. Join coincident vertices (tunica-import --merge), or remove the other pieces.",
        field, static_cast<int>(s.pieces.size()), s.pieces[0], s.pieces[1]));
}

void Judge::shape() {
  const Vessel& v = vessel_;
  if (v.radius > 0.0)
    row("lumen as a tube", formatted("radius %.3g, length %.3g mm", v.radius, v.length), "");
  if (v.elements_across_lumen > 0) {
    row("elements across the lumen", formatted("%d", v.elements_across_lumen), "10 and more");
    if (v.elements_across_lumen < 8)
      doubts_.push_back(formatted(
          "the lumen has %d elements across where it has fewest; usual are 10 or more, for wall "
          "shear stress 20. Refine the mesh (tunica-mesh refine) before you rely on the results.",
          v.elements_across_lumen));
  }
  if (v.elements_across_wall == 0) return;
  row("wall", formatted("%.3g mm, %d elements across", v.thickness, v.elements_across_wall),
      "3 and more");
  if (v.elements_across_wall < 3)
    doubts_.push_back(
        formatted("the wall has %d element%s across; usual are 3 or more; with fewer, bending and "
                  "the stress through the wall are not resolved. Grow it with more (tunica-mesh "
                  "wall --layers), or refine the mesh.",
                  v.elements_across_wall, v.elements_across_wall == 1 ? "" : "s"));
}

void Judge::stiffness() {
  for (std::size_t k = 0; k < wall_.layers.size(); ++k) {
    const discretisation::Layer& layer = wall_.layers[k];
    found_.modulus += vessel_.region_shares[k] *
                      circumferential_modulus(*discretisation::law_of(layer), layer.bulk_modulus);
  }
  row("wall, small-strain Young's modulus", formatted("%.3g kPa", found_.modulus),
      "20 to 5000 kPa");
  // A layer may be as soft; below 0.5 kPa it is doubted itself.
  if (found_.modulus < 5.0 && found_.modulus >= 0.5)
    doubts_.push_back(formatted(
        "the wall's Young's modulus at small strain is %.3g kPa, averaged over its layers; walls "
        "have 20 to 5000 kPa; 1 MPa = 1000 kPa. Check the units of its constants.",
        found_.modulus));
  if (vessel_.thickness > 0.0 && vessel_.radius > 0.0) {
    const double E = found_.modulus, h = vessel_.thickness, R = vessel_.radius;
    found_.wave_speed = std::sqrt(E * h / (2.0 * fluid_.density * R));
    row("wave speed, Moens-Korteweg", formatted("%.3g mm/ms", found_.wave_speed), "2 to 15 mm/ms");
    const double borne = case_.wall->prestress.pressure;
    const double strain = (loads_.peak_pressure - borne) * R / (E * h);
    if (strain > 0.0) row("p R/(E h), strain around", formatted("%.2g", strain), "below 0.3");
    if (strain > 1.0)
      doubts_.push_back(formatted(
          "%.3g kPa would widen a linear wall of %.3g kPa to %.2g times its radius; usual is "
          "1.1 to 1.3. Check the units of the wall's constants (kPa) and of the pressure; was "
          "the vessel imaged under pressure (Wall / Prestress)?",
          loads_.peak_pressure, E, 1.0 + strain));
  }
  held();
}

void Judge::held() {
  for (const auto& c : case_.wall->options.conditions)
    if (c.kind() != "traction" && c.kind() != "pressure" &&
        c.kind() != boundary::interface_condition)
      return;
  doubts_.emplace_back(
      "no surface holds the wall; usually its ends are held. It will drift away: give a surface "
      "the condition \"clamped\", \"held\" or \"support\".");
}

void Judge::loads() {
  if (loads_.are_zero)
    doubts_.push_back(
        formatted("all loads are zero during the run, up to %.4g ms: nothing will move. Give a "
                  "surface %s, and check the times of the Amplitudes, which are in ms.",
                  loads_.end,
                  vessel_.fluid ? "of the fluid a pressure, a velocity or a flow rate"
                                : "of the wall a pressure"));
  if (loads_.overshoot > 0.2)
    doubts_.push_back(formatted(
        "a load's spline exceeds the values of its table by %.0f %% of their range; usual is below "
        "20 %%. Give it more times where there are few and the values change (a gap at the end of "
        "a period counts), or \"interpolation\" = \"linear\".",
        100.0 * loads_.overshoot));
  if (loads_.gap > 0.0)
    doubts_.push_back(formatted(
        "a table with a period of %.4g ms ends %.4g ms before it is repeated; what lies between is "
        "interpolated. Give it times up to the end of the period, or correct \"period\".",
        loads_.gap_period, loads_.gap));
  if (loads_.peak_pressure > 0.0)
    row("largest pressure given",
        formatted("%.3g kPa = %.3g mmHg", loads_.peak_pressure, loads_.peak_pressure * 7.50062),
        "up to 30 kPa");
  if (loads_.peak_flow > 0.0)
    row("largest flow given",
        formatted("%.3g mm^3/ms (ml/s) in %s", loads_.peak_flow, loads_.flow_surface.c_str()), "");
}

void Judge::openings() {
  if (loads_.balance)
    row("mean flow, and pressure at the outlets",
        formatted("%.3g mm^3/ms, %.3g kPa = %.3g mmHg", loads_.balance->inflow,
                  loads_.balance->pressure, loads_.balance->pressure * 7.50062),
        "8 to 18 kPa");
  for (const std::string& doubt : doubts_of_openings(case_, vessel_, loads_, found_.modulus))
    doubts_.push_back(doubt);
}

double Judge::driven_speed(std::string& how) const {
  const double dp = loads_.pressure_difference, R = vessel_.radius, L = vessel_.length;
  if (dp == 0.0 || R == 0.0 || loads_.has_data) return 0.0;
  const double rho = fluid_.density;
  double inertia = loads_.impulse / (rho * L);
  const char* by_inertia = "its impulse";
  if (const double wave = dp / (rho * std::max(found_.wave_speed, 1e-300));
      found_.wave_speed > 0.0 && wave > inertia) {
    inertia = wave;
    by_inertia = "a wave";
  }
  const std::pair<double, const char*> bounds[] = {
      {dp * R * R / (8.0 * fluid_.viscosity->reference() * L), "Poiseuille"},
      {std::sqrt(2.0 * dp / rho), "Bernoulli"},
      {time_.pseudo_time ? 1e300 : inertia, by_inertia}};
  const auto least = std::min_element(std::begin(bounds), std::end(bounds));
  how = formatted("from %.3g kPa, by %s", dp, least->second);
  return least->first;
}

void Judge::flow() {
  std::string how = formatted("given in %s", loads_.flow_surface.c_str());
  double R = std::sqrt(loads_.flow_area / M_PI);
  found_.speed = loads_.peak_speed;
  if (found_.speed == 0.0) {
    found_.speed = driven_speed(how);
    R = vessel_.radius;
  }
  if (found_.speed == 0.0) return;
  const double nu = fluid_.viscosity->reference() / fluid_.density;
  found_.reynolds = found_.speed * 2.0 * R / nu;
  row("mean velocity expected", formatted("%.3g mm/ms (%s)", found_.speed, how.c_str()),
      "0.05 to 1.5 mm/ms");
  row("Reynolds number", formatted("%.3g", found_.reynolds), "up to 4000");
  if (found_.speed > 5.0)
    doubts_.push_back(
        formatted("the expected mean velocity is %.3g mm/ms (m/s), %s; usual is up to 1.5. Check "
                  "the units: mm/ms, mm^3/ms (= ml/s), kPa.",
                  found_.speed, how.c_str()));
  else if (loads_.course_speed > 0.0 && loads_.course_speed < 0.005 && vessel_.radius > 0.5)
    doubts_.push_back(
        formatted("the largest mean velocity given is %.3g mm/ms (m/s), in %s; usual are 0.05 to "
                  "1.5. Check the units: mm/ms, mm^3/ms (= ml/s; 1 l/min = 16.7 mm^3/ms).",
                  loads_.course_speed, loads_.speed_surface.c_str()));
  else if (found_.reynolds > 10000.0)
    doubts_.push_back(
        formatted("the Reynolds number is about %.3g; usual is up to 4000. Flow beyond that is "
                  "turbulent, and there is no turbulence model. Check velocity and viscosity (kPa "
                  "ms, blood has 0.0035).",
                  found_.reynolds));
  if (loads_.periods.empty()) return;
  const double longest = *std::max_element(loads_.periods.begin(), loads_.periods.end());
  found_.womersley = R * std::sqrt(2.0 * M_PI / (longest * nu));
  row("Womersley number", formatted("%.3g (period %.4g ms)", found_.womersley, longest), "1 to 25");
}

// A beat is not to be seen in less than a wave takes through the vessel. Runs of few steps are
// trials.
void Judge::times() {
  constexpr double usual_speed = 5.0;
  const double c = found_.wave_speed > 0.0 ? found_.wave_speed : usual_speed;
  const double transit = vessel_.length / c;
  const auto doubt = [&](const char* what, double duration) {
    doubts_.push_back(
        formatted("%s takes %.3g ms, less than the %.3g ms in which a wave of %.3g mm/ms runs "
                  "through the vessel; a heartbeat takes 600 to 1200 ms. Are the times in "
                  "seconds? 0.8 s = 800 ms.",
                  what, duration, transit, c));
  };
  if (loads_.flow_table > 0.0 && loads_.flow_table < transit)
    doubt("the table of a flow", loads_.flow_table);
  else if (has_fixed_steps() && loads_.end < transit && loads_.end >= 99.5 * time_.first_step)
    doubt("the run", loads_.end);
}

void Judge::steps() {
  const double dt = time_.first_step;
  if (vessel_.fluid && found_.speed > 0.0) {
    found_.cfl = 2.0 * found_.speed * dt / vessel_.fluid->edge;
    row("CFL, by twice that velocity", formatted("%.2g", found_.cfl), "about 1");
    // Beyond R²/(5.78 ν) a flow has forgotten how it began: such steps seek a steady one.
    const double memory =
        vessel_.radius * vessel_.radius * fluid_.density / (5.78 * fluid_.viscosity->reference());
    if (found_.cfl > 10.0 && dt < memory)
      doubts_.push_back(
          formatted("in a step of %.3g ms the fluid crosses about %.2g elements; usual is about 1; "
                    "above 10 vortices are not resolved and solvers are slow. Use a step of %.2g "
                    "ms, or \"step control\" = \"adaptive\".",
                    dt, found_.cfl, dt / found_.cfl));
  }
  if (found_.wave_speed > 0.0) waves();
  for (const double period : loads_.periods)
    if (period < 40.0 * dt)
      doubts_.push_back(
          formatted("a load of period %.4g ms has %.3g steps of %.3g ms; usual are 100 or more. "
                    "Reduce \"Time / step size\", in ms.",
                    period, period / dt, dt));
  if (loads_.rise > 0.0)
    row("load within a step, off a straight line", formatted("%.0f %%", 100.0 * loads_.missed),
        "below 10 %");
  if (loads_.missed > 0.25)
    doubts_.push_back(
        formatted("within a step of %.3g ms a load deviates from a straight line by %.0f %% of its "
                  "largest value, which the run does not resolve; usual is below 10 %%. Reduce "
                  "\"Time / step size\", or \"step control\" = \"adaptive\"; are the times in ms?",
                  dt, 100.0 * loads_.missed));
}

void Judge::waves() {
  const double dt = time_.first_step, transit = vessel_.length / found_.wave_speed;
  found_.steps_per_transit = transit / dt;
  row("steps while a wave runs through", formatted("%.3g", found_.steps_per_transit),
      "20, if waves matter");
  // Loads that take long beside the transit fill the vessel evenly, and no wave is to be seen.
  const double scale = loads_.rise > 0.0 ? loads_.rise : loads_.end;
  if (found_.steps_per_transit < 4.0 && scale < 2.0 * transit)
    doubts_.push_back(
        formatted("a wave runs through the vessel in %.3g ms, %.2g steps of %.3g ms, and loads "
                  "change as fast; usual are 20 steps. Reduce \"Time / step size\" to %.2g ms.",
                  transit, found_.steps_per_transit, dt, transit / 20.0));
}

void Judge::brief() {
  const auto add = [this](const std::string& part) {
    found_.brief += (found_.brief.empty() ? "expected: " : ", ") + part;
  };
  if (found_.reynolds > 0.0) add(formatted("Re %.3g", found_.reynolds));
  if (found_.womersley > 0.0) add(formatted("Womersley %.3g", found_.womersley));
  if (found_.cfl > 0.0) add(formatted("CFL %.2g", found_.cfl));
  if (found_.wave_speed > 0.0) add(formatted("wave speed %.3g mm/ms", found_.wave_speed));
}

void print_doubts(const Sanity& sanity) {
  for (const std::string& doubt : sanity.doubts) io::print_line("warning: " + doubt);
}

}  // namespace

VesselSurfaces vessel_surfaces(const setup::Case& the_case) {
  VesselSurfaces surfaces;
  std::vector<boundary::Condition> of_fluid;
  if (the_case.fluid) of_fluid = the_case.fluid->options.conditions;
  for (const boundary::Condition& c : of_fluid) {
    if (c.kind() == "no slip" || c.kind() == boundary::interface_condition)
      surfaces.lumen_sides.push_back(c.surface);
    else if (c.kind() == "held")
      surfaces.lumen_planes.push_back(c.surface);
  }
  if (!the_case.wall) return surfaces;
  for (const auto& c : the_case.wall->options.conditions) {
    const std::string kind = c.kind();
    if (kind == "pressure" || kind == boundary::interface_condition)
      surfaces.wall_inside.push_back(c.surface);
    else if (kind != "traction" && kind != "support")
      surfaces.wall_ends.push_back(c.surface);
  }
  return surfaces;
}

Sanity sanity_of(const setup::Case& the_case, const Vessel& vessel) {
  return Judge(the_case, vessel).verdict();
}

void print_table(const Sanity& sanity) {
  std::size_t left = 0, middle = 0;
  for (const Sanity::Row& row : sanity.rows) {
    left = std::max(left, row.what.size());
    middle = std::max(middle, row.found.size());
  }
  const auto print = [&](const char* what, const char* found, const char* usual) {
    io::print_line(formatted("%-*s  %-*s  %s", int(left), what, int(middle), found, usual));
  };
  print("expected, roughly", "found", "usual");
  for (const Sanity::Row& row : sanity.rows)
    print(row.what.c_str(), row.found.c_str(), row.usual.c_str());
  print_doubts(sanity);
}

void print_brief(const Sanity& sanity) {
  if (!sanity.brief.empty()) io::print_line(sanity.brief);
  print_doubts(sanity);
}

}  // namespace tunica::judge
