#pragma once
#include "tunica/linear/preconditioner_registry.hpp"

namespace tunica::linear {

/// "two-level schwarz": FROSch's monolithic overlapping Schwarz method for the merged matrix, a
/// subdomain per rank, with coarse functions that continue the constants of the interface between
/// them ([HHK19]).
PreconditionerEntry schwarz_preconditioner();

}  // namespace tunica::linear
