#include <Teuchos_UnitTestHarness.hpp>

#include "oracle/samples.hpp"
#include "tunica/kernels/fluid_up.hpp"
#include "tunica/kernels/solid_up.hpp"
#include "tunica/materials/carreau_yasuda.hpp"
#include "tunica/materials/holzapfel.hpp"
#include "tunica/materials/newtonian.hpp"
#include "tunica/materials/st_venant_kirchhoff.hpp"

namespace {

using namespace tunica;
using namespace tunica::kernels;
using oracle::Deviation;
using oracle::Samples;

/// What differs between a lane and the element alone, relative to the largest of each kind.
double deviation(const MixedResidualOf<Pack>& packed, int lane, const MixedResidual& alone) {
  Deviation of_u, of_p;
  for (int a = 0; a < 4; ++a) {
    for (int i = 0; i < 3; ++i) of_u.add(packed.u[a][i][lane], alone.u[a][i]);
    of_p.add(packed.p[a][lane], alone.p[a]);
  }
  return std::max(of_u.relative(), of_p.relative());
}

double deviation(const MixedJacobianOf<Pack>& packed, int lane, const MixedJacobian& alone) {
  Deviation of_A, of_B1T, of_B2, of_C;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) of_A.add(packed.A[a][b][i][j][lane], alone.A[a][b][i][j]);
        of_B1T.add(packed.B1T[a][b][i][lane], alone.B1T[a][b][i]);
        of_B2.add(packed.B2[a][b][i][lane], alone.B2[a][b][i]);
      }
      of_C.add(packed.mC[a][b][lane], alone.mC[a][b]);
    }
  return std::max({of_A.relative(), of_B1T.relative(), of_B2.relative(), of_C.relative()});
}

materials::Frame frame_of(Samples& samples) {
  const Vec3 r = samples.vector(1.0), s = samples.vector(1.0);
  materials::Frame frame;
  frame.radial = 1.0 / norm(r) * r;
  const Vec3 t = cross(frame.radial, s);
  frame.circumferential = 1.0 / norm(t) * t;
  frame.axial = cross(frame.radial, frame.circumferential);
  return frame;
}

struct SolidElement {
  std::array<Vec3, 4> x;
  Tet4 T;
  SolidState s;
  SolidCoefficients c;
  materials::Frame frame;

  explicit SolidElement(Samples& samples) : frame(frame_of(samples)) {
    x = samples.tetrahedron();
    T = make_tet4(x);
    do {
      s.d = samples.deformation(x, 0.35);
    } while (solid_jacobian_determinant(T, s.d) < 0.3);
    s.p = samples.numbers(5.0);
    s.r = samples.vectors(20.0);
    s.subscale_r = samples.vector(15.0);
    const auto c_of = samples.numbers(0.4);
    c = {120.0 + c_of[0], 0.5 + c_of[1], 0.5 + c_of[2], 4.0 + c_of[3]};
  }
};

const materials::MooneyRivlin rubber(3.0, 0.3);
const materials::Holzapfel media(materials::MooneyRivlin(3.0, 0.0), {2.3632, 0.8393, 29.0, 0.0});
const materials::Holzapfel dispersed(materials::MooneyRivlin(1.0, 0.4), {5.0, 2.0, 40.0, 0.2});
const materials::StVenantKirchhoff steel(100.0, 0.4);

TEUCHOS_UNIT_TEST(packs, the_geometry_of_an_element_does_not_know_its_lane) {
  Samples samples(2);
  std::array<std::array<Vec3, 4>, Pack::size> x;
  std::array<Vec3Of<Pack>, 4> packed;
  for (int lane = 0; lane < Pack::size; ++lane)
    set_lane(packed, lane, x[lane] = samples.tetrahedron());
  const Tet4Of<Pack> T = make_tet4(packed);
  for (int lane = 0; lane < Pack::size; ++lane) {
    const Tet4 expected = make_tet4(x[lane]);
    TEST_FLOATING_EQUALITY(T.volume[lane], expected.volume, 1e-14);
    for (int a = 0; a < 4; ++a)
      TEST_COMPARE(norm(lane_of(T.grad_N[a], lane) - expected.grad_N[a]), <,
                   1e-14 * norm(expected.grad_N[a]));
  }
}

TEUCHOS_UNIT_TEST(packs, a_wall_element_does_not_know_its_lane) {
  Samples samples(3);
  using Laws = std::array<const materials::WallLaw*, Pack::size>;
  for (const Laws& laws :
       {Laws{&rubber, &rubber, &rubber, &rubber}, Laws{&media, &media, &media, &media},
        Laws{&dispersed, &dispersed, &dispersed, &dispersed}, Laws{&steel, &steel, &steel, &steel},
        Laws{&rubber, &media, &rubber, &steel}})
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<SolidElement> lanes;
      std::array<Vec3Of<Pack>, 4> x;
      SolidStateOf<Pack> s;
      SolidCoefficientsOf<Pack> c;
      PackedLaws packed{laws, {}};
      for (int lane = 0; lane < Pack::size; ++lane) {
        const SolidElement& mine = lanes.emplace_back(samples);
        set_lane(x, lane, mine.x);
        set_lane(s, lane, mine.s);
        set_lane(c, lane, mine.c);
        set_lane(packed.frames, lane, mine.frame);
      }
      MixedResidualOf<Pack> R, R_alone;
      MixedJacobianOf<Pack> K;
      const Tet4Of<Pack> T = make_tet4(x);
      solid_up_jacobian(T, s, packed, c, R, K);
      solid_up_residual(T, s, packed, c, R_alone);
      for (int lane = 0; lane < Pack::size; ++lane) {
        const SolidElement& mine = lanes[lane];
        MixedResidual expected_R;
        MixedJacobian expected_K;
        solid_up_jacobian(mine.T, mine.s, {*laws[lane], mine.frame}, mine.c, expected_R,
                          expected_K);
        TEST_COMPARE(deviation(R, lane, expected_R), <, 1e-13);
        TEST_COMPARE(deviation(R_alone, lane, expected_R), <, 1e-13);
        TEST_COMPARE(deviation(K, lane, expected_K), <, 1e-13);
      }
    }
}

TEUCHOS_UNIT_TEST(packs, a_fluid_element_does_not_know_its_lane) {
  Samples samples(4);
  const materials::Newtonian newtonian(0.035);
  const materials::CarreauYasuda thinning({0.4, 0.03, 0.7, 0.35, 1.5});
  for (const bool has_skew_convection : {false, true})
    for (const bool has_mean_residual : {false, true})
      for (int trial = 0; trial < 20; ++trial) {
        FluidCoefficients c{1.06, &newtonian, 8.0};
        if (trial % 2 == 1) c.viscosity = &thinning;
        c.has_skew_convection = has_skew_convection;
        c.has_mean_residual = has_mean_residual;
        Tet4 T[Pack::size];
        FluidState s[Pack::size];
        std::array<Vec3Of<Pack>, 4> packed_x;
        FluidStateOf<Pack> packed_s;
        Pack tau;
        for (int lane = 0; lane < Pack::size; ++lane) {
          const auto x = samples.tetrahedron();
          T[lane] = make_tet4(x);
          s[lane] = {samples.vectors(1.0), samples.numbers(5.0), samples.vectors(1.0),
                     samples.vectors(0.5), samples.vectors(2.0), {1.0, 0.0, 0.0, 1.0},
                     samples.vector(0.3),  samples.vector(0.7)};
          set_lane(packed_x, lane, x);
          set_lane(packed_s, lane, s[lane]);
          set_lane(tau, lane, 0.05 + 0.01 * lane);
        }
        MixedResidualOf<Pack> R, R_alone;
        MixedJacobianOf<Pack> K;
        const Tet4Of<Pack> packed_T = make_tet4(packed_x);
        fluid_up_jacobian(packed_T, packed_s, c, tau, R, K);
        fluid_up_residual(packed_T, packed_s, c, tau, R_alone);
        for (int lane = 0; lane < Pack::size; ++lane) {
          MixedResidual expected_R;
          MixedJacobian expected_K;
          fluid_up_jacobian(T[lane], s[lane], c, tau[lane], expected_R, expected_K);
          TEST_COMPARE(deviation(R, lane, expected_R), <, 1e-13);
          TEST_COMPARE(deviation(R_alone, lane, expected_R), <, 1e-13);
          TEST_COMPARE(deviation(K, lane, expected_K), <, 1e-13);
        }
      }
}

// Beyond its bounds a law has no value; that must not reach the other lanes.
TEUCHOS_UNIT_TEST(packs, what_is_no_number_stays_in_its_lane) {
  Sym3Of<Pack> C{1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
  C[1].set(2, 1e6);  // exp(k2 e²) overflows
  const Sym3Of<Pack> S = media.packed_stress(C, {});
  for (int lane = 0; lane < Pack::size; ++lane) {
    bool is_number = true;
    for (const Pack& entry : S) is_number = is_number && std::isfinite(entry[lane]);
    TEST_EQUALITY(is_number, lane != 2);
  }
}

}  // namespace
