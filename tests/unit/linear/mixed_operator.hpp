#pragma once
#include "tunica/assembly/block_assembler.hpp"
#include "tunica/assembly/element_geometry.hpp"
#include "tunica/assembly/solid_assembly.hpp"
#include "tunica/materials/registry.hpp"
#include "unit/fields/small_tube.hpp"

namespace tunica::test {

/// The Jacobian of a clamped Mooney–Rivlin tube wall, at rest or somewhat deformed: a real
/// indefinite block system.
class WallJacobian {
public:
  /// parts: with those of a solid multigrid can interpolate rotations.
  explicit WallJacobian(const SmallTube& tube, const fields::MeshParts& parts = {})
      : mesh_(&tube.wall), law_(materials::make_law("mooney-rivlin", {})),
        K(tube.wall, fields::mixed_blocks, nullptr, parts), fixed_(tube.wall.n_nodes()) {
    elements_.geometry = assembly::ElementGeometry(tube.wall, tube.wall.x);
    const std::size_t n = tube.wall.tets.size();
    elements_.layers = {{law_.get(), 1.2, {1.2 / (0.625 * 0.125 * 0.125), 1e-5, 0.0}}};
    elements_.layer_number.assign(n, 0);
    elements_.tau.assign(n, 1e-3);
    for (int a = 0; a < tube.wall.n_nodes(); ++a)
      if (tube.wall.is_on(a, tube.surface("struct_in"))) fixed_.fix_vector(a);
    set(0.0);
  }

  /// The Jacobian at a displacement without pattern of the given size [mm].
  void set(double size) {
    const auto x = scattered(*mesh_, 5, size);
    const assembly::SolidFields state{fields::ghosted_vectors(*mesh_, x[0]),
                                      std::vector<double>(mesh_->n_nodes(), 0.0),
                                      std::vector<Vec3>(mesh_->n_nodes())};
    assembly::NodalResidual R(*mesh_);
    assembly::BlockAssembler assembler(K, fixed_);
    assembly::assemble_solid(*mesh_, elements_, state, R, &assembler);
    assembler.finish();
  }

private:
  const fields::FieldMesh* mesh_;
  std::unique_ptr<materials::WallLaw> law_;
  assembly::SolidElements elements_;

public:
  fields::BlockOperator K;

private:
  assembly::Constraints fixed_;
};

}  // namespace tunica::test
