#pragma once
#include <string>
#include <vector>

#include "tunica/judge/loads.hpp"
#include "tunica/judge/vessel.hpp"
#include "tunica/setup/case.hpp"

namespace tunica::judge {

/// What is wrong where blood enters and leaves: outlets that do not fit what flows in, openings
/// that were forgotten, pressures that begin beside those under which the wall was imaged, ends
/// that a fibre frame does not know. A line each, with the cure.
/// list: the resolved case. modulus: E of the wall, 0 where there is none [kPa].
std::vector<std::string> doubts_of_openings(const setup::Case& the_case, const Vessel& vessel,
                                            const Loads& loads, double modulus);

}  // namespace tunica::judge
