#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/judge/vessel.hpp"
#include "tunica/setup/case.hpp"

namespace tunica::judge {

/// Loads by which a resolved case drives its vessel, during the run.
struct Loads {
  double end = 0.0;        ///< of the run [ms]
  bool are_zero = true;    ///< nothing pushes, pulls or flows
  bool has_data = false;   ///< some come from files, which are not looked at
  double peak_flow = 0.0;  ///< largest that is prescribed through an opening [mm³/ms]
  double flow_area = 0.0;  ///< of this opening [mm²]
  std::string flow_surface{};
  double flow_table = 0.0;    ///< the shortest of a flow or velocity without a period; 0: none [ms]
  double peak_speed = 0.0;    ///< largest mean velocity that is prescribed [mm/ms]
  double course_speed = 0.0;  ///< the same in all of the amplitudes' courses
  std::string speed_surface{};       ///< of that
  double peak_pressure = 0.0;        ///< largest on openings of the fluid and on the wall [kPa]
  std::string pressure_surface{};    ///< with the list that names it
  double pressure_difference = 0.0;  ///< largest between openings [kPa]
  /// First pressures of openings, prescribed or those of an outlet [kPa].
  std::vector<std::pair<std::string, double>> first_pressures{};
  /// Loads of the case on the wall at the start; a traction by its magnitude [kPa].
  struct OnWall {
    std::string surface;
    bool is_pressure;
    double first;
  };
  std::vector<OnWall> on_wall{};
  std::vector<std::string> bare{};  ///< openings without a condition: zero pressure
  bool has_outlets = false;         ///< some answer the flow with a pressure
  /// Where all that flows in leaves through outlets: means over the period of what is given, or
  /// over the run.
  struct Balance {
    double inflow;     ///< mean [mm³/ms]
    double pressure;   ///< mean to which they let it settle [kPa]
    double mean_flow;  ///< what they expect together [mm³/ms]; 0: not all of them do
  };
  std::optional<Balance> balance{};
  double impulse = 0.0;           ///< largest that it gives: its integral over time [kPa ms]
  std::vector<double> periods{};  ///< of the amplitudes, each once [ms]
  double gap = 0.0;               ///< longest of a table with a period, at its end [ms]
  double gap_period = 0.0;        ///< of that table [ms]
  /// Rise time of the fastest amplitude that changes during the run: its range over its largest
  /// slope; 0: all are constant [ms]. A run of a few steps makes no load fast.
  double rise = 0.0;
  /// Part of an amplitude that fixed steps do not resolve: its largest deviation from a straight
  /// line within a step, over its largest value. Tables of steps count where they change faster
  /// than that.
  double missed = 0.0;
  /// How far a spline goes beyond the values of its table, over their range.
  double overshoot = 0.0;
};

/// Amplitudes count at their kinks and at 2000 times. Only the normal part of an opening's traction
/// counts; the response of an outlet to the flow counts in the balance alone.
Loads loads_of(const setup::Case& the_case, const std::vector<Vessel::Opening>& openings);

}  // namespace tunica::judge
