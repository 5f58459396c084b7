#include "tunica/problems/coupled_settings.hpp"

#include <string>

namespace tunica::problems {

namespace {

DomainRule domain_rule(const std::string& geometry) {
  if (geometry == "extrapolated") return DomainRule::extrapolated;
  if (geometry == "newton") return DomainRule::newton;
  return geometry == "quasi" ? DomainRule::quasi : DomainRule::automatic;
}

}  // namespace

CoupledSettings::CoupledSettings(const Teuchos::ParameterList& list)
    : geometry(domain_rule(list.get<std::string>("geometry"))), mesh_tolerance(0.0),
      product_tolerance(0.0), solves(list) {
  if (geometry == DomainRule::extrapolated) return;
  mesh_tolerance = list.get<double>("mesh tolerance");
  product_tolerance = list.get<double>("product tolerance");
}

}  // namespace tunica::problems
