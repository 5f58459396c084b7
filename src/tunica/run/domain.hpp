#pragma once
#include <map>
#include <memory>
#include <optional>

#include "tunica/base/memory.hpp"
#include "tunica/fields/field_mesh.hpp"
#include "tunica/fields/interface_transfer.hpp"
#include "tunica/judge/vessel.hpp"
#include "tunica/observe/probes.hpp"
#include "tunica/setup/case.hpp"

namespace tunica::run {

/// The calling rank's shares of the fields that a case has.
struct Domain {
  CommPtr comm;
  std::map<std::string, fields::FieldMesh> meshes;  ///< "fluid", "wall"
  std::optional<fields::FieldMesh> common;          ///< of both, where the coupling needs it
  std::optional<fields::InterfaceTransfer> interface;
  std::string fingerprint;              ///< of the mesh
  Vec3 extent;                          ///< of the mesh, in mm
  std::vector<int> interface_surfaces;  ///< indices into FieldMesh::surfaces
  observe::Probes probes;
  judge::Vessel vessel;
  MemoryByPhase memory;  ///< up to the fields

  bool has(const std::string& field) const { return meshes.count(field) > 0; }
  const fields::FieldMesh& mesh(const std::string& field) const { return meshes.at(field); }
};

/// Reads and checks the mesh against the case (names of regions and surfaces, conforming
/// interface, number of ranks, probes within their fields), partitions it and builds the fields.
/// Throws Error on all ranks alike. Collective.
Domain load_domain(const setup::Case& the_case, const CommPtr& comm);

/// Prints the expected properties of the case and, if known, the cost of a run on rank 0's screen,
/// before a run. Collective.
void print_expectations(const setup::Case& the_case, const Domain& domain);

/// Checks that a run makes on that domain before its first step: the directions of the wall's
/// fibres, the conditions of all surfaces with their files, and check_held(); and in its steps:
/// unbalanced flows through a fluid without an open surface. Throws Error on all ranks alike.
/// Collective.
void check_fields(const setup::Case& the_case, const Domain& domain);

/// Throws Error where the case seeks equilibria of a wall that may move as a rigid body: in
/// statics, and for a prestress. Collective.
void check_held(const setup::Case& the_case, const Domain& domain);

}  // namespace tunica::run
