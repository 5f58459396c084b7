#pragma once
#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

namespace tunica::params {

/// A parameter that is not the same in two lists.
struct Difference {
  std::string path;           ///< "Wall / Layers / media / c10"
  std::string before, after;  ///< as in XML; "none" where it is not there
};

/// All changes, at all depths, in the order of the lists, first those of `before`.
std::vector<Difference> differences(const Teuchos::ParameterList& before,
                                    const Teuchos::ParameterList& after);

/// `Fluid / viscosity: 0.0035 -> 0.004`, with long values cut.
std::string text_of(const Difference& difference);

}  // namespace tunica::params
