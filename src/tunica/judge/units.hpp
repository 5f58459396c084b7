#pragma once
#include "tunica/judge/loads.hpp"
#include "tunica/setup/case.hpp"

namespace tunica::judge {

/// Values of a resolved case that look as if they were in other units than mm, ms, mg and kPa: a
/// line each with what is usual and the factor that was probably forgotten.
std::vector<std::string> doubts_of_units(const setup::Case& the_case, const Loads& loads);

}  // namespace tunica::judge
