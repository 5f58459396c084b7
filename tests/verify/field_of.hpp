#pragma once
#include <Teuchos_XMLParameterListHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "tunica/base/reduce.hpp"
#include "tunica/fields/field_mesh.hpp"
#include "tunica/mesh/distributed/share.hpp"
#include "tunica/mesh/tube.hpp"
#include "tunica/params/table.hpp"

namespace tunica::verify {

/// The calling rank's share of a mesh that rank 0 has and that belongs to one field as a whole.
inline fields::FieldMesh field_of(const mesh::Mesh& mesh,
                                  const CommPtr& comm = Tpetra::getDefaultComm()) {
  const std::vector<bool> is_fluid(mesh.regions.size(), true);
  const mesh::Share share =
      mesh::share_of(mesh::slab_of(mesh, comm), is_fluid, mesh::Partitioner::automatic, "mesh");
  std::vector<int> regions;
  for (int r = 0; r < static_cast<int>(mesh.regions.size()); ++r) regions.push_back(r);
  return fields::make_field_mesh(share, regions);
}

/// The list with these entries ("<Parameter .../>", "<ParameterList ...>") and all defaults.
inline Teuchos::ParameterList resolved(const params::Table& table, const std::string& entries) {
  Teuchos::ParameterList list = *Teuchos::getParametersFromXmlString(
      "<ParameterList name=\"Verification\">" + entries + "</ParameterList>");
  table.resolve(list, "Verification", "");
  return list;
}

inline std::string entry(const std::string& name, const std::string& type,
                         const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
}
inline std::string sublist(const std::string& name, const std::string& entries) {
  return "<ParameterList name=\"" + name + "\">" + entries + "</ParameterList>";
}

/// The field of a round tube without a wall, the finer the larger n.
inline fields::FieldMesh lumen(double radius, double length, int n) {
  mesh::Tube tube;
  tube.with_wall = false;
  tube.radius = radius;
  tube.length = length;
  tube.around = 8 * n;
  tube.axial = 6 * n;
  return field_of(mesh::make_tube(tube));
}

/// Mean of f over the nodes where it is a number. Collective.
template <class Value>
double mean_over_nodes(const fields::FieldMesh& mesh, const Value& f) {
  double sum = 0.0, count = 0.0;
  for (int a = 0; a < mesh.n_owned; ++a)
    if (const double value = f(a); !std::isnan(value)) {
      sum += value;
      count += 1.0;
    }
  return global_sum(*mesh.comm, sum) / global_sum(*mesh.comm, count);
}

/// Euclidean distance of two fields of nodal vectors on one rank.
inline double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i] - b[i], a[i] - b[i]);
  return std::sqrt(sum);
}

/// Exponent of h in the error between two meshes whose lengths differ by the factor.
inline double order(double coarse_error, double fine_error, double factor = 2.0) {
  return std::log(coarse_error / fine_error) / std::log(factor);
}

}  // namespace tunica::verify
