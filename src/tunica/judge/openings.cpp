#include "tunica/judge/openings.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/base/formatted.hpp"
#include "tunica/problems/prestress.hpp"

namespace tunica::judge {

namespace {

using Doubts = std::vector<std::string>;

void doubt_outlets(const Loads& loads, Doubts& doubts) {
  if (!loads.balance) return;
  const Loads::Balance& b = *loads.balance;
  if (b.inflow < 0.0)
    doubts.push_back(
        formatted("the given flow rates draw %.3g mm^3/ms out of the vessel on average, and the "
                  "outlets must supply it; usual is the opposite. A positive flow rate flows in.",
                  -b.inflow));
  else if (b.pressure > 50.0)
    doubts.push_back(formatted(
        "with the resistances of the outlets a mean flow of %.3g mm^3/ms raises the pressure to "
        "%.3g kPa; arteries have 8 to 18. 1 mmHg s/ml = 0.1333 kPa ms/mm^3, 1 dyn s/cm^5 = 1e-4 "
        "kPa ms/mm^3, 1 ml/s = 1 mm^3/ms. Check the units of these values.",
        b.inflow, b.pressure));
  else if (b.pressure < 0.0)
    doubts.push_back(
        formatted("with these outlets the pressure settles at %.3g kPa, below zero; arteries have "
                  "8 to 18. Check their \"distal pressure\".",
                  b.pressure));
  if (b.mean_flow != 0.0 && std::abs(b.mean_flow - b.inflow) > 0.25 * std::abs(b.inflow))
    doubts.push_back(formatted(
        "the outlets begin as if %.3g mm^3/ms left through them (their \"mean flow\"), but %.3g "
        "flow in on average: the pressure drifts for some time constants. Make them equal in sum.",
        b.mean_flow, b.inflow));
}

// One that is left free is usual; beside outlets, or a prestress, it drains the vessel.
void doubt_bare(const Loads& loads, double imaged, Doubts& doubts) {
  if (imaged == 0.0 && !loads.has_outlets) return;
  for (const std::string& surface : loads.bare)
    doubts.push_back(formatted(
        "the opening %s has no condition, so that blood leaves there against a pressure of 0 kPa, "
        "%s; was it forgotten? Name it in Fluid / Surfaces, with \"traction\" = {0, 0, 0} if this "
        "is intended.",
        surface.c_str(),
        imaged != 0.0 ? formatted("but the wall was imaged under %.3g kPa", imaged).c_str()
                      : "past outlets that hold it back"));
}

// Where the vessel was imaged under pressure, the blood begins with it.
void doubt_prestress(const Loads& loads, const Vessel& vessel, double imaged, double modulus,
                     Doubts& doubts) {
  for (const auto& [surface, p] : loads.first_pressures)
    if (imaged != 0.0 && std::abs(p - imaged) > 0.25 * std::abs(imaged))
      doubts.push_back(formatted(
          "%s begins with a pressure of %.3g kPa, but the wall was imaged under %.3g kPa "
          "(Wall / Prestress): the vessel jumps in its first steps. Begin with that pressure "
          "(a windkessel: \"initial pressure\" or \"mean flow\").",
          surface.c_str(), p, imaged));
  if (imaged != 0.0 || vessel.thickness == 0.0) return;
  for (const auto& [surface, p] : loads.first_pressures) {
    const double strain = p * vessel.radius / (modulus * vessel.thickness);
    if (strain < 0.05) continue;
    doubts.push_back(
        formatted("%s begins with a pressure of %.3g kPa, under which a wall that is free of "
                  "stress widens by about %.0f %% at once. If the vessel was imaged under it, set "
                  "Wall / Prestress / pressure = %.3g; otherwise let it rise from zero.",
                  surface.c_str(), p, 100.0 * strain, p));
    return;  // the others say the same
  }
}

// The prestress bears the pressure of the image; pressures of the case on the same surfaces take
// its place when the run begins, all else adds to it.
void doubt_loads_on_wall(const problems::SolidSettings& wall, const Loads& loads, bool is_coupled,
                         Doubts& doubts) {
  const double imaged = wall.prestress.pressure;
  if (imaged == 0.0) return;
  const std::vector<std::string>& bearing = wall.prestress.surfaces;
  for (const Loads::OnWall& load : loads.on_wall) {
    if (std::count(bearing.begin(), bearing.end(), load.surface) == 0) continue;
    const char* const surface = load.surface.c_str();
    if (!load.is_pressure && load.first != 0.0)
      doubts.push_back(
          formatted("%s bears a traction of %.3g kPa at the start, and the %.3g kPa under which "
                    "the wall was imaged (Wall / Prestress) besides: the mesh is then the shape "
                    "under both together. If the traction is that pressure, omit one of them, or "
                    "use \"condition\" = \"pressure\" instead.",
                    surface, load.first, imaged));
    else if (load.is_pressure && is_coupled)
      doubts.push_back(
          formatted("%s bears the pressure of the fluid, and one of %.3g kPa that Wall / Surfaces "
                    "gives it besides: from the start on they add up, but the wall was imaged "
                    "under %.3g kPa (Wall / Prestress). Omit that of the wall.",
                    surface, load.first, imaged));
    else if (load.is_pressure && std::abs(load.first - imaged) > 0.25 * std::abs(imaged))
      doubts.push_back(
          formatted("%s begins with a pressure of %.3g kPa, but the wall was imaged under %.3g kPa "
                    "(Wall / Prestress), which it replaces: the vessel jumps in its first step. "
                    "Begin with that pressure.",
                    surface, load.first, imaged));
  }
}

// Without a value there, the direction along the vessel lies in the plane of its end.
void doubt_frame(const Teuchos::ParameterList& frame, const Vessel& vessel, Doubts& doubts) {
  if (frame.get<std::string>("kind") != "laplace") return;
  const auto names = [&](const char* key) {
    return frame.get<Teuchos::Array<std::string>>(key).toVector();
  };
  const std::vector<std::string> starts = names("start surfaces"), ends = names("end surfaces");
  for (const Vessel::Opening& o : vessel.openings) {
    if (o.wall_end.empty() || std::count(starts.begin(), starts.end(), o.wall_end) > 0 ||
        std::count(ends.begin(), ends.end(), o.wall_end) > 0)
      continue;
    doubts.push_back(formatted(
        "%s, the wall's end at the opening %s, is in neither \"start surfaces\" nor \"end "
        "surfaces\" of Wall / Fibre Frame: fibres do not follow the vessel to it. Add it to the "
        "latter.",
        o.wall_end.c_str(), o.surface.c_str()));
  }
}

}  // namespace

std::vector<std::string> doubts_of_openings(const setup::Case& the_case, const Vessel& vessel,
                                            const Loads& loads, double modulus) {
  Doubts doubts;
  doubt_outlets(loads, doubts);
  const bool is_coupled = vessel.wall && vessel.fluid;
  const double imaged = is_coupled ? the_case.wall->prestress.pressure : 0.0;
  doubt_bare(loads, imaged, doubts);
  if (vessel.wall) doubt_loads_on_wall(*the_case.wall, loads, is_coupled, doubts);
  if (!is_coupled) return doubts;
  doubt_prestress(loads, vessel, imaged, modulus, doubts);
  doubt_frame(the_case.list.sublist("Wall").sublist("Fibre Frame"), vessel, doubts);
  return doubts;
}

}  // namespace tunica::judge
