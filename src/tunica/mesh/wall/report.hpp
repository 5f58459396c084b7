#pragma once
#include "tunica/mesh/wall/grow.hpp"
#include "tunica/mesh/wall/plan.hpp"

namespace tunica::mesh::wall {

/// Measures the wall that was made by this plan.
Report make_report(const Mesh& mesh, const Plan& plan, const Options& options);

}  // namespace tunica::mesh::wall
