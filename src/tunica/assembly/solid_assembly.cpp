#include "tunica/assembly/solid_assembly.hpp"

#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/kernels/deformation.hpp"
#include "tunica/kernels/prestretch.hpp"

namespace tunica::assembly {

namespace {

[[gnu::always_inline]] inline kernels::SolidState state_of(const SolidFields& s,
                                                           const fields::FieldMesh& mesh,
                                                           const SolidElements& elements,
                                                           std::size_t e) {
  const std::array<int, 4>& nodes = mesh.tets[e];
  const double density = elements.layer(e).density;
  const auto& pressure_nodes = fields::scalar_mesh(mesh, elements.split).tets[e];
  kernels::SolidState state{gather(s.d, nodes), gather(s.p, pressure_nodes), gather(s.r, nodes)};
  // Histories of the scheme are those of unit density.
  for (Vec3& r : state.r) r = density * r;
  // Kernels see the displacement D = d + x − X from where the element is free of stress.
  if (elements.geometry.is_prestretched()) {
    const std::array<Vec3, 4> from = elements.geometry.from_stress_free(e);
    const double alpha = elements.layer(e).coefficients.alpha;
    for (int a = 0; a < 4; ++a) {
      state.d[a] += from[a];
      state.r[a] += alpha * from[a];  // inertia is that of d: α d − r = α D − (r + α (x − X))
    }
  }
  // s = α d − r − r' + J F⁻ᵀ∇p − J div σ'*: both of the last stand where the kernel has r'.
  if (!s.subscale_r.empty()) state.subscale_r = density * s.subscale_r[e];
  if (!s.stress_force.empty()) state.subscale_r += s.stress_force[e];
  return state;
}

}  // namespace

WorstElement worst_solid_element(const fields::FieldMesh& mesh, const SolidElements& elements,
                                 const std::vector<Vec3>& d) {
  // min_e det F
  WorstElement worst{1.0, -1};
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const double J = kernels::solid_jacobian_determinant(
        elements.geometry[e], elements.displacement(e, gather(d, mesh.tets[e])));
    if (worst.element < 0 || !(J >= worst.determinant)) worst = {J, static_cast<int>(e)};
    if (std::isnan(worst.determinant)) break;  // no other element may hide it
  }
  return worst;
}

// d' = −τ s̄
std::vector<Vec3> solid_subscales(const fields::FieldMesh& mesh, const SolidElements& elements,
                                  const SolidFields& state) {
  std::vector<Vec3> subscales(mesh.tets.size());
  for (std::size_t e = 0; e < subscales.size(); ++e)
    subscales[e] = kernels::solid_subscale(elements.geometry[e], state_of(state, mesh, elements, e),
                                           elements.coefficients(e));
  return subscales;
}

// Each law takes what it needs from C = FᵀF at the end of the step.
std::vector<double> remembered_by_laws(const fields::FieldMesh& mesh, const SolidElements& elements,
                                       const std::vector<Vec3>& d) {
  std::vector<double> rows(elements.past_width * mesh.tets.size(), 0.0);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const Mat3 F = kernels::deformation_gradient(elements.geometry[e],
                                                 elements.displacement(e, gather(d, mesh.tets[e])));
    elements.layer(e).law->remember(kernels::right_cauchy_green(F), elements.frame(e),
                                    elements.past_of(e), rows.data() + elements.past_width * e);
  }
  return rows;
}

// R ← R + Σ_e R_e, K ← K + Σ_e K_e, the kernels for all elements of a pack at once. These may be of
// different layers: coefficients, laws and frames have lanes as the state has.
void assemble_solid(const fields::FieldMesh& mesh, const SolidElements& elements,
                    const SolidFields& state, NodalResidual& R, BlockAssembler* K) {
  std::array<Vec3Of<Pack>, 4> x;
  kernels::SolidStateOf<Pack> s;
  kernels::SolidCoefficientsOf<Pack> c;
  kernels::PackedLaws laws;
  kernels::MixedResidualOf<Pack> Re;
  kernels::MixedJacobianOf<Pack> Ke;
  for (std::size_t first = 0; first < mesh.tets.size(); first += Pack::size) {
    const PackedElements pack(first, mesh.tets.size());
    if (K != nullptr) K->begin(pack);
    for (int lane = 0; lane < Pack::size; ++lane) {
      const std::size_t e = pack.number[lane];
      set_lane(x, lane, elements.geometry.vertices(e));
      set_lane(s, lane, state_of(state, mesh, elements, e));
      set_lane(c, lane, elements.coefficients(e));
      laws.laws[lane] = elements.layer(e).law;
      if (!elements.frames.empty()) set_lane(laws.frames, lane, elements.frames[e]);
      laws.pasts[lane] = elements.past_of(e);
    }
    const auto T = kernels::make_tet4(x);
    if (K == nullptr) {
      kernels::solid_up_residual(T, s, laws, c, Re);
    } else {
      kernels::solid_up_jacobian(T, s, laws, c, Re, Ke);
      K->add(Ke);
    }
    R.add(mesh, pack, Re);
  }
}

// K ← K + Σ_e (dR_e/ds − dR_e/dd), s in G ← (I + sym ∇s) G: blocks A and B2 of the wall's Jacobian
// at d = 0, whose derivative by the pressure stays as it is
void assemble_prestretch(const fields::FieldMesh& mesh, const SolidElements& elements,
                         const std::vector<materials::Frame>& frames, const SolidFields& state,
                         BlockAssembler& K) {
  // V and ∇N where the wall lies, beside V₀ and Gᵀ∇N of its elements without stress
  const ElementGeometry image(mesh, mesh.x);
  const auto& scalar_mesh = fields::scalar_mesh(mesh, elements.split);
  // B1ᵀ and C of it stay zero.
  kernels::MixedJacobianOf<Pack> Ke{};
  for (std::size_t first = 0; first < mesh.tets.size(); first += Pack::size) {
    const PackedElements pack(first, mesh.tets.size());
    K.begin(pack);
    for (int lane = 0; lane < Pack::size; ++lane) {
      const std::size_t e = pack.number[lane];
      kernels::PrestretchedElement element;
      element.in_place = image[e];
      element.stress_free = elements.geometry[e];
      element.d = elements.geometry.from_stress_free(e);
      element.p = gather(state.p, scalar_mesh.tets[e]);
      element.coefficients = elements.coefficients(e);
      element.law = elements.layer(e).law;
      element.frame = elements.frame(e);
      if (!frames.empty()) element.frame_in_place = frames[e];
      const kernels::MixedJacobian of_lane = kernels::prestretch_jacobian(element);
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b)
          for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) set_lane(Ke.A[a][b][i][j], lane, of_lane.A[a][b][i][j]);
            set_lane(Ke.B2[a][b][i], lane, of_lane.B2[a][b][i]);
          }
    }
    K.add(Ke);
  }
}

}  // namespace tunica::assembly
