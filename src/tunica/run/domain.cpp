#include "tunica/run/domain.hpp"

#include <algorithm>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/fault_point.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/boundary/registry.hpp"
#include "tunica/boundary/rigid_motion.hpp"
#include "tunica/boundary/surface_terms.hpp"
#include "tunica/discretisation/fluid.hpp"
#include "tunica/discretisation/solid.hpp"
#include "tunica/io/messages.hpp"
#include "tunica/judge/cost.hpp"
#include "tunica/judge/sanity.hpp"
#include "tunica/mesh/distributed/share.hpp"
#include "tunica/mesh/validate.hpp"
#include "tunica/observe/surface_report.hpp"
#include "tunica/params/nearest.hpp"
#include "tunica/problems/fibre_frames.hpp"
#include "tunica/problems/prestress.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "tunica/run/extent.hpp"
#include "tunica/stepping/step_control.hpp"

namespace tunica::run {

namespace {

/// What the case says of the mesh.
struct MeshRequirements {
  std::vector<std::string> fluid_regions, wall_regions;
  std::vector<std::string> fluid_surfaces, wall_surfaces, frame_surfaces, reported_surfaces;
  std::vector<std::string> prestress_surfaces, group_surfaces;
  std::vector<std::string> interface;
};

MeshRequirements mesh_requirements_of(const setup::Case& the_case) {
  MeshRequirements requirements;
  requirements.reported_surfaces = observe::named_surfaces(the_case.output.surfaces);
  requirements.group_surfaces = observe::surfaces_of(observe::force_groups_in(the_case.list));
  std::vector<std::string> on_fluid, on_wall;
  if (the_case.fluid) {
    requirements.fluid_regions = the_case.fluid->options.regions;
    for (const auto& c : the_case.fluid->options.conditions)
      requirements.fluid_surfaces.push_back(c.surface);
    on_fluid = boundary::interface_surfaces(the_case.fluid->options.conditions);
  }
  if (the_case.wall) {
    requirements.wall_regions = the_case.wall->options.regions();
    for (const auto& c : the_case.wall->options.conditions)
      requirements.wall_surfaces.push_back(c.surface);
    on_wall = boundary::interface_surfaces(the_case.wall->options.conditions);
    requirements.frame_surfaces = problems::frame_surfaces(the_case.wall->frame);
    requirements.prestress_surfaces = the_case.wall->prestress.surfaces;
  }
  if (!the_case.is_coupled()) {
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

/// Regions of the fields.
struct Regions {
  std::vector<int> fluid, wall;
};

Regions regions_of(const mesh::Mesh& mesh, const MeshRequirements& requirements) {
  Regions regions{region_indices(mesh, requirements.fluid_regions, "Fluid / regions"),
                  region_indices(mesh, requirements.wall_regions, "Wall / Layers")};
  for (const int r : regions.fluid)
    TUNICA_CHECK(std::count(regions.wall.begin(), regions.wall.end(), r) == 0,
                 "the region \"" + mesh.regions[r].name + "\" is both fluid and wall.");
  return regions;
}

/// Of each surface more than zero where it bounds the part that these regions fill. Collective.
std::vector<double> bounds_of(const mesh::Share& share, const std::vector<int>& regions) {
  const mesh::Mesh& mesh = share.mesh;
  const std::vector<char> is_in = mesh::marked_regions(mesh, regions);
  std::vector<double> bounds(mesh.surfaces.size(), 0.0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (share.is_between(i, is_in)) bounds[mesh.triangle_surface[i]] = 1.0;
  return global_sum(*share.comm, bounds);
}

/// Of what is in no field: the regions that a surface bounds, as the end of a message. Collective.
std::string forgotten_regions(const mesh::Share& share, int surface,
                              const std::vector<std::vector<int>>& fields) {
  std::vector<std::string> names;
  for (int r = 0; r < static_cast<int>(share.mesh.regions.size()); ++r)
    if (std::none_of(
            fields.begin(), fields.end(),
            [&](const auto& field) { return std::count(field.begin(), field.end(), r); }) &&
        bounds_of(share, {r})[surface] > 0.0)
      names.push_back(share.mesh.regions[r].name);
  return names.empty()
             ? ""
             : " It bounds the region " + params::quoted(names) + ", which is in no field.";
}

/// Every surface the case names must exist and bound the field, or one of the fields, each of which
/// is given by its regions. Collective.
void check_surfaces(const mesh::Share& share, const std::vector<std::string>& names,
                    const std::vector<std::vector<int>>& fields, const std::string& where) {
  const mesh::Mesh& mesh = share.mesh;
  std::vector<double> bounds(mesh.surfaces.size(), 0.0);
  for (const std::vector<int>& regions : fields) {
    const std::vector<double> of_field = bounds_of(share, regions);
    for (std::size_t s = 0; s < bounds.size(); ++s) bounds[s] += of_field[s];
  }
  for (const std::string& name : names) {
    int surface = 0;
    try {
      surface = mesh::surface_index(mesh, name);
    } catch (const Error& error) {
      throw Error(where + ": " + error.what());
    }
    TUNICA_CHECK(bounds[surface] > 0.0, where + ": the surface \"" + name + "\" does not bound " +
                                            (fields.size() == 1 ? "this field" : "fluid or wall") +
                                            ": it lies outside or inside." +
                                            forgotten_regions(share, surface, fields));
  }
}

void check_case(const mesh::Share& share, const MeshRequirements& requirements,
                const Regions& regions) {
  const auto check = [&](const std::vector<std::string>& names,
                         const std::vector<std::vector<int>>& fields,
                         const std::string& where) { check_surfaces(share, names, fields, where); };
  check(requirements.fluid_surfaces, {regions.fluid}, "Fluid / Surfaces");
  check(requirements.wall_surfaces, {regions.wall}, "Wall / Surfaces");
  check(requirements.frame_surfaces, {regions.wall}, "Wall / Fibre Frame");
  check(requirements.prestress_surfaces, {regions.wall}, "Wall / Prestress");
  check(requirements.reported_surfaces, {regions.fluid, regions.wall}, "Output / surfaces");
  check(requirements.group_surfaces, {regions.fluid}, "Output / Force Groups");
  if (!requirements.interface.empty())
    mesh::check_interface(share, requirements.fluid_regions, requirements.wall_regions,
                          requirements.interface);
}

/// Checks of the case do not know the file.
std::string with_file(const std::string& message, const std::string& file) {
  return message.compare(0, file.size(), file) == 0 ? message : file + ": " + message;
}

void make_fields(const setup::Case& the_case, const mesh::Share& share, const Regions& regions,
                 Domain& domain) {
  if (!regions.fluid.empty())
    domain.meshes.emplace("fluid", fields::make_field_mesh(share, regions.fluid));
  if (!regions.wall.empty())
    domain.meshes.emplace("wall", fields::make_field_mesh(share, regions.wall));
  if (!the_case.coupling || !the_case.coupling->is_monolithic) return;
  std::vector<int> all(regions.fluid);
  all.insert(all.end(), regions.wall.begin(), regions.wall.end());
  domain.common = fields::make_field_mesh(share, all);
}

}  // namespace

Domain load_domain(const setup::Case& the_case, const CommPtr& comm) {
  const MeshRequirements requirements = mesh_requirements_of(the_case);
  const std::string& file = the_case.mesh->file;
  Domain domain;
  domain.comm = comm;
  try {
    domain.memory.end("program", *comm);
    fault_point("mesh reading");
    mesh::Slab slab = mesh::read_slab(file, comm);
    scale(slab.rows, the_case.mesh->scale);
    domain.memory.end("rows of the mesh", *comm);
    domain.fingerprint = mesh::fingerprint(slab);
    domain.extent = mesh::extent(slab);
    const Regions regions = regions_of(slab.rows, requirements);
    const std::vector<char> of_fluid = mesh::marked_regions(slab.rows, regions.fluid);
    const std::vector<bool> is_fluid(of_fluid.begin(), of_fluid.end());
    const auto by = mesh::partitioner_of(the_case.mesh->partitioner);
    const auto fields = mesh::vertex_fields(slab, is_fluid, file);
    const mesh::SlabPartition partition = mesh::partition(slab, is_fluid, fields, by, file);
    domain.memory.end("partition", *comm);
    const mesh::Share share = mesh::distribute(std::move(slab), partition, file);
    domain.memory.end("shares", *comm);
    check_case(share, requirements, regions);
    domain.vessel =
        judge::vessel_of(share, regions.fluid, regions.wall, judge::vessel_surfaces(the_case));
    domain.memory.end("checks", *comm);
    fault_point("field mesh");
    make_fields(the_case, share, regions, domain);
    domain.memory.end("fields", *comm);
    for (const std::string& name : requirements.interface)
      domain.interface_surfaces.push_back(mesh::surface_index(share.mesh, name));
    if (domain.has("fluid") && domain.has("wall"))
      domain.interface.emplace(domain.mesh("fluid"), domain.mesh("wall"),
                               domain.interface_surfaces);
    domain.probes = observe::Probes(the_case.list, domain.meshes);
  } catch (const Error& error) {
    throw Error(with_file(error.what(), file));
  }
  return domain;
}

void print_expectations(const setup::Case& the_case, const Domain& domain) {
  const bool is_root = domain.comm->getRank() == 0;
  if (is_root) judge::print_table(judge::sanity_of(the_case, domain.vessel));
  if (!domain.common) return;
  const std::string cost = text_of(judge::expected_cost(domain.mesh("fluid"), domain.mesh("wall")),
                                   domain.comm->getSize());
  if (is_root) io::print_line(cost);
}

namespace {

/// Prescribes what the case gives at so many times of the run: flows through a fluid that no
/// surface lets out must balance at all of them.
void check_flows(discretisation::Fluid& fluid, const stepping::StepControlOptions& time) {
  const int n = time.pseudo_time ? 1 : 20;  // a steady flow has the loads at the end
  algebra::BlockVector x(fluid.space());
  stepping::Clock clock(time.end / n, n);
  for (; !clock.is_done(); clock.advance()) {
    fluid.begin_step(clock);
    fluid.prescribe(x);
  }
}

}  // namespace

void check_fields(const setup::Case& the_case, const Domain& domain) {
  const bool is_monolithic = the_case.coupling && the_case.coupling->is_monolithic;
  if (domain.has("wall"))
    const discretisation::Solid wall(the_case.wall->options, domain.mesh("wall"),
                                     problems::frames_of_wall(*the_case.wall, domain.mesh("wall")));
  if (domain.has("fluid")) {
    discretisation::Fluid fluid(the_case.fluid->options, domain.mesh("fluid"));
    // One whose wall moves with it within a step is not closed.
    if (!is_monolithic) check_flows(fluid, the_case.time->steps);
  }
  check_held(the_case, domain);
}

void check_held(const setup::Case& the_case, const Domain& domain) {
  if (!the_case.wall) return;
  const bool is_static = the_case.wall->options.is_static;
  if (!is_static && the_case.wall->prestress.pressure == 0.0) return;
  const boundary::SurfaceTerms terms(the_case.wall->options.conditions, boundary::wall_conditions(),
                                     domain.mesh("wall"));
  const std::string free = boundary::free_rigid_motions(terms, domain.mesh("wall"));
  TUNICA_CHECK(free.empty(), "Wall / Surfaces: nothing holds the wall against " + free + ", but " +
                                 (is_static ? "\"analysis\" = \"static\"" : "its prestress") +
                                 " is an equilibrium, which is then not unique. Give a surface the "
                                 "condition \"clamped\", \"held\" or \"support\".");
}

}  // namespace tunica::run
