#include "tunica/app/field_output.hpp"

#include <iostream>

#include "tunica/assembly/gather.hpp"
#include "tunica/kernels/wall_stress.hpp"

namespace tunica::app {

namespace {

output::Array vector_array(const std::string& name, const std::vector<Vec3>& values, int count) {
  output::Array array{name, 3, {}};
  for (int a = 0; a < count; ++a)
    array.values.insert(array.values.end(), values[a].begin(), values[a].end());
  return array;
}

output::Array dof_array(const std::string& name, int components, const Vector& v) {
  const auto view = v.getLocalViewHost(read_only);
  return {name, components, {view.data(), view.data() + view.extent(0)}};
}

}  // namespace

output::Grid grid_of(const fields::FieldMesh& mesh, const std::string& name) {
  output::Grid grid;
  grid.name = name;
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

std::vector<output::Array> fluid_arrays(const problems::FluidProblem& fluid,
                                        const std::vector<Vec3>& mesh_displacement) {
  std::vector<output::Array> arrays{dof_array("velocity", 3, fluid.state()[0]),
                                    dof_array("pressure", 1, fluid.state()[1])};
  if (!mesh_displacement.empty())
    arrays.push_back(vector_array("displacement", mesh_displacement, fluid.mesh().n_owned));
  return arrays;
}

std::vector<output::Array> wall_arrays(const problems::SolidProblem& wall) {
  const int n_points = wall.scalar_mesh().n_owned;
  const auto at_points = [&wall](const std::vector<Vec3>& nodal) {
    if (wall.split() == nullptr) return nodal;
    std::vector<Vec3> values;
    for (int a = 0; a < wall.split()->n_owned; ++a) values.push_back(nodal[wall.split()->node[a]]);
    return values;
  };
  return {vector_array("displacement", at_points(wall.displacement()), n_points),
          dof_array("pressure", 1, wall.state()[1]),
          vector_array("velocity", at_points(wall.velocity()), n_points)};
}

std::vector<output::Array> wall_cell_arrays(const problems::SolidProblem& wall) {
  const fields::FieldMesh& mesh = wall.mesh();
  auto d = fields::ghosted_vectors(mesh, wall.state()[0]);
  for (std::size_t a = 0; a < d.size(); ++a) d[a] += wall.from_stress_free()[a];
  const auto p = fields::ghosted_scalars(wall.scalar_mesh(), wall.state()[1]);
  output::Array stress{"cauchy_stress", 6, {}}, von_mises{"von_mises", 1, {}};
  output::Array around{"circumferential", 3, {}}, along{"axial", 3, {}};
  const bool has_frames = !wall.elements().frames.empty();
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (!mesh.is_owned[e]) continue;
    const Sym3 sigma =
        kernels::cauchy_stress(wall.elements().geometry[e], assembly::gather(d, mesh.tets[e]),
                               assembly::gather(p, wall.scalar_mesh().tets[e]),
                               *wall.elements().law[e], wall.elements().frame(e));
    stress.values.insert(stress.values.end(), sigma.begin(), sigma.end());
    von_mises.values.push_back(kernels::von_mises(sigma));
    if (!has_frames) continue;
    const materials::Frame& frame = wall.elements().frames[e];
    for (auto& [array, direction] :
         {std::pair(&around, frame.circumferential), std::pair(&along, frame.axial)})
      array->values.insert(array->values.end(), direction.begin(), direction.end());
  }
  std::vector<output::Array> arrays{stress, von_mises};
  if (has_frames) arrays.insert(arrays.end(), {around, along});
  return arrays;
}

FieldSeries::FieldSeries(const RunOutput& output, const std::vector<output::Grid>& grids,
                         const CommPtr& comm)
    : every_(output.fields_every) {
  if (every_ == 0 && !output.has_asked_times) return;
  writer_.emplace(output.folder.path(), grids, comm, output.steps_done());
  if (comm->getRank() == 0 && !writer_->remark().empty())
    std::cerr << "warning: " << writer_->remark() << std::endl;
}

bool FieldSeries::is_due(const stepping::Clock& clock) const {
  return writer_ &&
         (clock.is_asked_for() || (every_ > 0 && (clock.is_every(every_) || clock.is_last())));
}

void FieldSeries::write(const stepping::Clock& clock, const std::vector<GridFields>& fields) {
  for (const GridFields& f : fields)
    writer_->write(clock.step(), clock.time(), f.grid, f.points, f.cells);
  writer_->finish_step();
}

}  // namespace tunica::app
