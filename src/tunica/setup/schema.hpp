#pragma once
#include "tunica/params/table.hpp"

namespace tunica::setup {

/// Every key of a case of tunica-fsi, tunica-solid and tunica-fluid.
params::Table fsi_table();
params::Table solid_table();
params::Table fluid_table();
/// Schema of tunica-solvers: every case of tunica-fsi, with the additional list "Solvers".
params::Table solvers_table();
/// Schema of tunica-solvers for a system of another program: no fields, no mesh.
params::Table system_solvers_table();

}  // namespace tunica::setup
