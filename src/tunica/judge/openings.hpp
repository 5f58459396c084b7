#pragma once
#include <string>
#include <vector>

#include "tunica/judge/loads.hpp"
#include "tunica/judge/vessel.hpp"
#include "tunica/setup/case.hpp"

namespace tunica::judge {

/// Doubts about the openings: outlets that do not fit the inflow, forgotten openings, initial
/// pressures that differ from the one under which the wall was imaged, ends that a fibre frame does
/// not name. A line each, with the cure. list: the resolved case. modulus: E of the wall, 0 where
/// there is none [kPa].
std::vector<std::string> doubts_of_openings(const setup::Case& the_case, const Vessel& vessel,
                                            const Loads& loads, double modulus);

}  // namespace tunica::judge
