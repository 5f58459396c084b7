#pragma once
#include <string>
#include <vector>

#include "tunica/judge/loads.hpp"
#include "tunica/judge/vessel.hpp"
#include "tunica/setup/case.hpp"

namespace tunica::judge {

/// Expected properties of a case, compared with the usual ones of vessels.
///
///   U   mean velocity: what is prescribed; else the least that the pressure difference Δp can
///       drive: Δp R²/(8 μ L) of Poiseuille, √(2 Δp/ρ) of Bernoulli, and the larger of
///       ∫Δp dt/(ρ L) of inertia and, with a wall, Δp/(ρ c) of a wave
///   c   √(E h/(2 ρ R)) of Moens and Korteweg
///
///   R, L, h   of the vessel                mm      ρ, μ  of the fluid
///   E   circumferential_modulus(), the mean over the wall's layers   kPa
///
/// An expectation of the order of magnitude, to find what is wrong by more than a factor of some.
struct Sanity {
  struct Row {
    std::string what, found, usual;
  };
  std::vector<Row> rows;
  std::vector<std::string> doubts;  ///< a line each: what was found, what is usual, the cure
  std::string brief;                ///< a line of the most important numbers

  // the numbers themselves; zero where they cannot be told
  double speed = 0.0, reynolds = 0.0, womersley = 0.0, cfl = 0.0;
  double modulus = 0.0, wave_speed = 0.0, steps_per_transit = 0.0;
};

/// The surfaces of a case by what they are to its vessel.
VesselSurfaces vessel_surfaces(const setup::Case& the_case);

Sanity sanity_of(const setup::Case& the_case, const Vessel& vessel);

/// The table and the doubts, or a line and the doubts.
void print_table(const Sanity& sanity);
void print_brief(const Sanity& sanity);

}  // namespace tunica::judge
