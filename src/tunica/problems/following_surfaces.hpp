#pragma once
#include <memory>
#include <vector>

#include "tunica/problems/extension_problem.hpp"

namespace tunica::problems {

/// Surfaces of the fluid that stretch with their rims where these lie on the interface: openings
/// whose rims widen, planes of symmetry. First the lines in which two surfaces meet are extended
/// from their ends, then the surfaces from their edges, by the law of the mesh's motion, so that
/// what is plane and whose rim moves in the plane stays in it. Corners of three such surfaces stay,
/// and so does what no edge ties to a rim. Nothing is set up before a rim moves.
class FollowingSurfaces {
public:
  /// interface: indices of its surfaces; staying: of those that never move. mesh must outlive the
  /// object.
  FollowingSurfaces(MeshMotionSettings settings, const fields::FieldMesh& mesh,
                    const std::vector<int>& interface, const std::vector<int>& staying);

  /// values: on entry those of the interface's nodes, zero elsewhere; on return those of the
  /// surfaces' nodes too. See ExtensionProblem::extend() and extend_roughly(). Collective.
  Outcome extend(MultiVector& values, const ExtensionAccuracy& accuracy);
  void extend_roughly(double tolerance, MultiVector& values);
  /// Makes the next extend() begin with these values of all nodes. Collective.
  void start_from(const MultiVector& values);

private:
  using Stages = std::vector<LawExtension>;

  bool moves_rim(const MultiVector& values) const;
  Stages& stages();

  MeshMotionSettings settings_;
  const fields::FieldMesh* mesh_;
  std::vector<char> on_surface_, on_line_;  ///< per local node: that is where it follows
  std::vector<int> interface_;              ///< its owned nodes
  std::vector<int> rim_;                    ///< those at surfaces that follow
  Stages stages_;                           ///< none before they are needed
};

}  // namespace tunica::problems
