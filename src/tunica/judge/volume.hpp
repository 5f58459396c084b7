#pragma once
#include <string>
#include <vector>

#include "tunica/problems/solid_problem.hpp"

namespace tunica::judge {

/// How the elements of a layer keep their volume, by det F from where they are free of stress.
///
/// Linear elements of an incompressible wall do not keep it one by one: what is zero is the mean
/// about each node, and where the strain varies over an element's neighbours det F varies about it,
/// as that of the nodal interpolant of the exact displacement does, to first order in the size of
/// elements. At sharp edges, where stress has no bound, finer elements show more of it.
struct LayerVolume {
  std::string layer;
  long long elements = 0;
  long long beyond = 0, at_edges = 0;        ///< outside 0.9 to 1.1; of these at sharp edges
  double least = 1.0, largest = 1.0;         ///< of all elements
  double low = 1.0, high = 1.0;              ///< one per cent of the elements are below, above
  double least_mean = 1.0, most_mean = 1.0;  ///< of means about nodes, apart from sharp edges
  Vec3 place{};                              ///< of the worst element, as it was meshed [mm]
};

/// The nodes of a wall at which a face of its boundary is turned by more than 30 degrees from the
/// mean of all that meet there, per local node.
std::vector<char> nodes_at_edges(const fields::FieldMesh& mesh);

/// Volumes of the elements of a region; geometry: where they are free of stress; d: displacement
/// from the positions of their vertices, at local nodes [mm]; is_at_edge: per local node.
/// Collective.
LayerVolume layer_volume(const fields::FieldMesh& mesh, int region,
                         const assembly::ElementGeometry& geometry, const std::vector<Vec3>& d,
                         const std::vector<char>& is_at_edge);

/// Volumes of the nearly incompressible layers: κ beyond 50 times the shear modulus. Collective.
std::vector<LayerVolume> layer_volumes(const problems::SolidProblem& wall);

/// Whether means about nodes leave 0.9 to 1.1.
bool loses_volume(const LayerVolume& volume);

/// The warning about a layer with elements beyond 0.9 to 1.1.
std::string text_of(const LayerVolume& volume);

}  // namespace tunica::judge
