#include "tunica/app/domain.hpp"

#include <algorithm>

#include "tunica/app/extent.hpp"
#include "tunica/app/sanity/sanity.hpp"
#include "tunica/app/surface_report.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/fault_point.hpp"
#include "tunica/boundary/registry.hpp"
#include "tunica/boundary/surface_terms.hpp"
#include "tunica/coupling/registry.hpp"
#include "tunica/discretisation/fluid_options.hpp"
#include "tunica/discretisation/solid_options.hpp"
#include "tunica/fields/broadcast_mesh.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/fingerprint.hpp"
#include "tunica/mesh/partition.hpp"
#include "tunica/mesh/read.hpp"
#include "tunica/mesh/validate.hpp"
#include "tunica/problems/fibre_frames.hpp"
#include "tunica/problems/prestress.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::app {

namespace {

/// What the case says of the mesh.
struct MeshRequirements {
  std::vector<std::string> fluid_regions, wall_regions;
  std::vector<std::string> fluid_surfaces, wall_surfaces, frame_surfaces, reported_surfaces;
  std::vector<std::string> prestress_surfaces;
  std::vector<std::string> interface;
};

MeshRequirements mesh_requirements_of(const Teuchos::ParameterList& list) {
  MeshRequirements requirements;
  requirements.reported_surfaces = named_surfaces(list.sublist("Output"));
  std::vector<std::string> on_fluid, on_wall;
  if (list.isSublist("Fluid")) {
    const Teuchos::ParameterList& fluid = list.sublist("Fluid");
    requirements.fluid_regions = discretisation::fluid_options(fluid).regions;
    const auto conditions = boundary::conditions_of(fluid.sublist("Surfaces"));
    for (const auto& c : conditions) requirements.fluid_surfaces.push_back(c.surface);
    on_fluid = boundary::interface_surfaces(conditions);
  }
  if (list.isSublist("Wall")) {
    const Teuchos::ParameterList& wall = list.sublist("Wall");
    requirements.wall_regions = discretisation::solid_options(wall).regions();
    const auto conditions = boundary::conditions_of(wall.sublist("Surfaces"));
    for (const auto& c : conditions) requirements.wall_surfaces.push_back(c.surface);
    on_wall = boundary::interface_surfaces(conditions);
    requirements.frame_surfaces = problems::frame_surfaces(wall.sublist("Fibre Frame"));
    if (problems::wants_prestress(wall))
      requirements.prestress_surfaces = problems::prestress_surfaces(wall);
  }
  if (!list.isSublist("Fluid") || !list.isSublist("Wall")) {
    TUNICA_CHECK(on_fluid.empty() && on_wall.empty(),
                 "Surfaces: the condition \"interface\" needs both fluid and wall.");
    return requirements;
  }
  std::sort(on_fluid.begin(), on_fluid.end());
  std::sort(on_wall.begin(), on_wall.end());
  TUNICA_CHECK(!on_fluid.empty(), "Fluid / Surfaces: no surface has the condition \"interface\".");
  TUNICA_CHECK(on_fluid == on_wall,
               "Fluid / Surfaces and Wall / Surfaces name different surfaces as \"interface\".");
  requirements.interface = on_fluid;
  return requirements;
}

std::vector<int> region_indices(const mesh::Mesh& mesh, const std::vector<std::string>& names,
                                const std::string& where) {
  std::vector<int> indices;
  try {
    for (const std::string& name : names) indices.push_back(mesh::region_index(mesh, name));
  } catch (const Error& error) {
    throw Error(where + ": " + error.what());
  }
  return indices;
}

struct MeshWithFaces {
  const mesh::Mesh& mesh;
  std::vector<mesh::Face> faces;
};

/// Every surface the case names must exist and bound the field, or one of the fields, each of which
/// is given by its regions.
void check_surfaces(const MeshWithFaces& with_faces, const std::vector<std::string>& names,
                    const std::vector<std::vector<int>>& fields, const std::string& where) {
  const mesh::Mesh& mesh = with_faces.mesh;
  const std::vector<mesh::Face>& faces = with_faces.faces;
  const auto is_between = [&](const mesh::Face& face, const std::vector<int>& regions) {
    const auto is_in_field = [&](int tet) {
      return tet >= 0 && std::count(regions.begin(), regions.end(), mesh.tet_region[tet]) > 0;
    };
    return is_in_field(face.tets[0]) != is_in_field(face.tets[1]);
  };
  for (const std::string& name : names) {
    int surface = 0;
    try {
      surface = mesh::surface_index(mesh, name);
    } catch (const Error& error) {
      throw Error(where + ": " + error.what());
    }
    bool bounds_field = false;
    for (std::size_t t = 0; t < mesh.triangles.size() && !bounds_field; ++t) {
      if (mesh.triangle_surface[t] != surface) continue;
      const mesh::Face& face = *mesh::find_face(faces, mesh.triangles[t]);  // a valid mesh has it
      bounds_field = std::any_of(fields.begin(), fields.end(),
                                 [&](const auto& regions) { return is_between(face, regions); });
    }
    TUNICA_CHECK(bounds_field, where + ": the surface \"" + name + "\" does not bound " +
                                   (fields.size() == 1 ? "this field" : "fluid or wall") +
                                   ": it lies outside or inside.");
  }
}

struct Shares {
  mesh::Mesh mesh;
  std::vector<int> fluid, wall;  ///< regions
  Vessel vessel;
};

Shares read_and_check(const Teuchos::ParameterList& list, const MeshRequirements& requirements,
                      int ranks) {
  const auto& file = list.sublist("Mesh").get<std::string>("file");
  Shares shares;
  shares.mesh = mesh::read(file);
  scale(shares.mesh, list.sublist("Mesh").get<double>("scale"));
  const MeshWithFaces with_faces{shares.mesh, mesh::faces(shares.mesh)};
  try {
    shares.fluid = region_indices(shares.mesh, requirements.fluid_regions, "Fluid / regions");
    shares.wall = region_indices(shares.mesh, requirements.wall_regions, "Wall / Layers");
    check_surfaces(with_faces, requirements.fluid_surfaces, {shares.fluid}, "Fluid / Surfaces");
    check_surfaces(with_faces, requirements.wall_surfaces, {shares.wall}, "Wall / Surfaces");
    check_surfaces(with_faces, requirements.frame_surfaces, {shares.wall}, "Wall / Fibre Frame");
    check_surfaces(with_faces, requirements.prestress_surfaces, {shares.wall}, "Wall / Prestress");
    check_surfaces(with_faces, requirements.reported_surfaces, {shares.fluid, shares.wall},
                   "Output / surfaces");
    for (const int r : shares.fluid)
      TUNICA_CHECK(std::count(shares.wall.begin(), shares.wall.end(), r) == 0,
                   "the region \"" + shares.mesh.regions[r].name + "\" is both fluid and wall.");
    if (!requirements.interface.empty())
      mesh::check_interface(shares.mesh, requirements.fluid_regions, requirements.wall_regions,
                            requirements.interface);
    TUNICA_CHECK(ranks <= static_cast<int>(shares.mesh.tets.size()),
                 "more ranks than elements: " + std::to_string(ranks) + " ranks, " +
                     std::to_string(shares.mesh.tets.size()) + " tetrahedra.");
  } catch (const Error& error) {
    throw Error(file + ": " + error.what());
  }
  shares.vessel =
      vessel_of(shares.mesh, with_faces.faces, shares.fluid, shares.wall, vessel_surfaces(list));
  return shares;
}

std::vector<bool> marks(const std::vector<int>& regions, std::size_t count) {
  std::vector<bool> is_marked(count, false);
  for (const int r : regions) is_marked[r] = true;
  return is_marked;
}

Probes probes_of(const Teuchos::ParameterList& list, const Domain& domain) {
  const auto pointer = [](const auto& mesh) { return mesh ? &*mesh : nullptr; };
  try {
    return Probes(list.sublist("Probes"), pointer(domain.fluid), pointer(domain.wall));
  } catch (const Error& error) {
    throw Error(list.sublist("Mesh").get<std::string>("file") + ": " + error.what());
  }
}

}  // namespace

Domain load_domain(const Teuchos::ParameterList& list, const CommPtr& comm) {
  const MeshRequirements requirements = mesh_requirements_of(list);
  Shares shares;
  fault_point("mesh reading");
  on_root(*comm, [&] { shares = read_and_check(list, requirements, comm->getSize()); });
  fields::broadcast_mesh(*comm, shares.mesh);
  shares.fluid = region_indices(shares.mesh, requirements.fluid_regions, "Fluid / regions");
  shares.wall = region_indices(shares.mesh, requirements.wall_regions, "Wall / Layers");

  Domain domain;
  domain.vessel = shares.vessel;
  fault_point("field mesh");
  domain.fingerprint = mesh::fingerprint(shares.mesh);
  domain.extent = extent(shares.mesh);
  const mesh::Partition partition = mesh::partition(
      shares.mesh, comm->getSize(), marks(shares.fluid, shares.mesh.regions.size()));
  if (!shares.fluid.empty())
    domain.fluid = fields::make_field_mesh(shares.mesh, partition, shares.fluid, comm);
  if (!shares.wall.empty())
    domain.wall = fields::make_field_mesh(shares.mesh, partition, shares.wall, comm);
  if (list.isSublist("Coupling") && coupling::is_monolithic(list.sublist("Coupling"))) {
    std::vector<int> all(shares.fluid);
    all.insert(all.end(), shares.wall.begin(), shares.wall.end());
    domain.common = fields::make_field_mesh(shares.mesh, partition, all, comm);
  }
  for (const std::string& name : requirements.interface)
    domain.interface_surfaces.push_back(mesh::surface_index(shares.mesh, name));
  if (domain.fluid && domain.wall)
    domain.interface.emplace(*domain.fluid, *domain.wall, domain.interface_surfaces);
  domain.probes = probes_of(list, domain);
  return domain;
}

void check_fields(const Teuchos::ParameterList& list, const Domain& domain) {
  if (domain.wall) problems::frames_of_wall(list.sublist("Wall"), *domain.wall);
  const auto check = [&list](const char* field, const auto& registry, const auto& mesh) {
    const auto conditions = boundary::conditions_of(list.sublist(field).sublist("Surfaces"));
    const boundary::SurfaceTerms terms(conditions, registry, mesh);
  };
  if (domain.fluid) check("Fluid", boundary::fluid_conditions(), *domain.fluid);
  if (domain.wall) check("Wall", boundary::wall_conditions(), *domain.wall);
}

}  // namespace tunica::app
