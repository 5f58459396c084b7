#pragma once
#include <complex>
#include <functional>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::smoothers {

/// Estimates of eigenvalues of a linear map, best for those at the border of the spectrum: the
/// eigenvalues of the Hessenberg matrix after so many steps of Arnoldi's method [Sa03, 6.3] from a
/// start that no mesh has a pattern of. Fewer where an invariant space is found; none of a map of
/// no unknowns or of one that is not finite. apply: y ← A x. Collective.
std::vector<std::complex<double>> ritz_values(
    const Teuchos::RCP<const Map>& map,
    const std::function<void(const Vector& x, Vector& y)>& apply, int steps);

}  // namespace tunica::smoothers
