#include "tunica/discretisation/mesh_motion.hpp"

#include <cmath>

#include "tunica/algebra/components.hpp"
#include "tunica/assembly/element_geometry.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/energy.hpp"

namespace tunica::discretisation {

namespace {

std::vector<char> nodes_of_surfaces(const fields::FieldMesh& mesh) {
  std::vector<char> is_given(mesh.n_nodes());
  for (int a = 0; a < mesh.n_nodes(); ++a) is_given[a] = mesh.is_on_boundary(a);
  return is_given;
}

}  // namespace

MeshMotion::MeshMotion(const fields::FieldMesh& mesh, const MotionLaw& law)
    : mesh_(&mesh), space_(fields::nodal_space(mesh, {{"mesh displacement", 3}})) {
  const std::vector<char> given = nodes_of_surfaces(mesh);
  if (law.is_elastic)
    elastic_ = std::make_unique<ElasticExtension>(mesh, given, law.poisson, law.stiffening);
  else
    harmonic_ = std::make_unique<HarmonicExtension>(mesh, given, Extent::volume, law.stiffening);
}

const Extension& MeshMotion::extension() const {
  return elastic_ ? static_cast<const Extension&>(*elastic_) : *harmonic_;
}

Outcome MeshMotion::residual(const algebra::BlockVector& x, algebra::BlockVector& F) {
  MultiVector d(mesh_->node_map, 3), forces(mesh_->node_map, 3);
  algebra::to_columns(x[0], d);
  extension().residual(d, forces);
  algebra::from_columns(forces, F[0]);
  return Outcome::success();
}

void MeshMotion::assemble_jacobian(const algebra::BlockVector&) {
  if (K_.space()) return;
  fields::BlockOperator K(*mesh_, {{"mesh displacement", 3}});
  double* const to = K.begin_assembly();
  // A row holds at each neighbour the columns of all components; a harmonic L stands in its own.
  // Rows and columns of given nodes keep their diagonal.
  const auto entry = [&](int a, int i, int b, int j) -> double& {
    return to[K.rows(0).start[a] + K.place(a, b) + i * K.rows(0).length[a] + j];
  };
  const auto from = (elastic_ ? elastic_->matrix() : harmonic_->jacobian())->getLocalMatrixHost();
  for (int row = 0; row < from.numRows(); ++row) {
    const auto values = from.rowConst(row);
    const int a = elastic_ ? row / 3 : row;
    for (int k = 0; k < values.length; ++k) {
      const int column = values.colidx(k);
      if (elastic_) {
        const bool is_given = extension().is_given(a) || extension().is_given(column / 3);
        if (!is_given || row == column) entry(a, row % 3, column / 3, column % 3) = values.value(k);
      } else {
        for (int i = 0; i < 3; ++i) entry(a, i, column, i) = values.value(k);
      }
    }
  }
  K.end_assembly();
  K_ = K;
}

double MeshMotion::mass_norm(const algebra::BlockVector& dx) const {
  const fields::FieldMesh& mesh = *mesh_;
  const std::vector<Vec3> d = fields::ghosted_vectors(mesh, dx[0]);
  const assembly::ElementGeometry geometry(mesh, mesh.x);
  double sum = 0.0;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    if (mesh.is_owned[e])
      sum += kernels::squared_norm(geometry[e].volume, assembly::gather(d, mesh.tets[e]));
  return std::sqrt(global_sum(*mesh.comm, sum));
}

}  // namespace tunica::discretisation
