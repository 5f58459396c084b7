#include "tunica/assembly/scalar_matrix.hpp"
#include "tunica/discretisation/solid.hpp"

namespace tunica::discretisation {

namespace {

constexpr const char* mass = "Schur Mass";
constexpr const char* bulk_mass = "Schur Bulk Mass";

}  // namespace

std::vector<std::string> Solid::operator_names() const { return {mass, bulk_mass}; }

// The parts of [LY1] eq:lpreschur, S̃ = (1/θ + 1/κ) diag(Mp). θ is O(c10) there, chosen by
// trials on a coarse mesh; here it is the law's own modulus c10 + c01, layer by layer.
Teuchos::RCP<const CrsMatrix> Solid::assemble_operator(const std::string& name) const {
  if (name != mass && name != bulk_mass) return Teuchos::null;
  const std::vector<char> none_fixed(scalar_mesh().n_nodes(), 0);
  return assembly::scalar_matrix(
      scalar_mesh(), scalar_graph(),
      [&](std::size_t e) {
        const assembly::SolidLayer& layer = elements_.layer(e);
        const double factor = name == bulk_mass ? layer.coefficients.inv_kappa
                                                : 2.0 / layer.law->stabilisation_modulus();
        return assembly::mass_element(elements_.geometry[e].volume, factor);
      },
      none_fixed);
}

}  // namespace tunica::discretisation
