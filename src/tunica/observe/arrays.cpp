#include "tunica/observe/arrays.hpp"

#include "tunica/fields/state.hpp"
#include "tunica/observe/field.hpp"

namespace tunica::observe {

output::Grid grid_of(const fields::FieldMesh& mesh, const std::string& name) {
  output::Grid grid;
  grid.name = name;
  grid.regions = mesh.regions;
  grid.points_global = static_cast<long long>(mesh.node_map->getGlobalNumElements());
  // Points are numbered rank by rank; where the mesh is split its nodes are not.
  const Map points(grid.points_global, mesh.n_owned, 0, mesh.comm);
  grid.first_point = mesh.n_owned > 0 ? points.getMinGlobalIndex() : 0;
  Vector numbers(mesh.node_map);
  {
    const auto view = numbers.getLocalViewHost(overwrite_all);
    for (int a = 0; a < mesh.n_owned; ++a) view(a, 0) = static_cast<double>(grid.first_point + a);
  }
  const std::vector<double> number = fields::ghosted_scalars(mesh, numbers);
  grid.points.assign(mesh.x.begin(), mesh.x.begin() + mesh.n_owned);
  grid.vertex.assign(mesh.vertex.begin(), mesh.vertex.begin() + mesh.n_owned);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (!mesh.is_owned[e]) continue;
    auto& tet = grid.tets.emplace_back();
    for (int a = 0; a < 4; ++a) tet[a] = static_cast<long long>(number[mesh.tets[e][a]]);
    grid.tet_number.push_back(mesh.tet_number[e]);
    grid.region.push_back(mesh.region[e]);
    grid.partition.push_back(mesh.comm->getRank());
  }
  return grid;
}

output::Array vector_array(const std::string& name, const std::vector<Vec3>& values, int count) {
  return {name, 3, fields::as_rows(values, count)};
}

output::Array dof_array(const std::string& name, int components, const Vector& v) {
  const auto view = v.getLocalViewHost(read_only);
  return {name, components, {view.data(), view.data() + view.extent(0)}};
}

output::Grid Field::grid() { return grid_of(mesh(), name()); }

}  // namespace tunica::observe
