#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "tunica/kernels/fluid_tau.hpp"
#include "tunica/kernels/fluid_up.hpp"
#include "tunica/kernels/laplace_p1.hpp"
#include "tunica/kernels/solid_up.hpp"
#include "tunica/materials/newtonian.hpp"
#include "tunica/materials/registry.hpp"

// Tetrahedra per second of the element kernels alone, without gather and scatter.
//   bench_kernels --benchmark_filter=jacobian

namespace {

using namespace tunica;
using namespace tunica::kernels;

constexpr int n_elements = 1024;  // fits the second-level cache

struct Elements {
  std::vector<std::array<Vec3, 4>> x;
  std::vector<Tet4> T;
  std::vector<SolidState> solid;
  std::vector<FluidState> fluid;

  Elements() {
    std::mt19937 engine(7);
    std::uniform_real_distribution<double> shift(-0.1, 0.1);
    const auto vectors = [&] {
      std::array<Vec3, 4> v;
      for (Vec3& vertex : v)
        for (double& entry : vertex) entry = shift(engine);
      return v;
    };
    for (int e = 0; e < n_elements; ++e) {
      std::array<Vec3, 4> corner = vectors();
      corner[1][0] += 1.0;
      corner[2][1] += 1.0;
      corner[3][2] += 1.0;
      x.push_back(corner);
      T.push_back(make_tet4(corner));
      const std::array<double, 4> p = {shift(engine), shift(engine), shift(engine), shift(engine)};
      solid.push_back({vectors(), p, vectors()});
      fluid.push_back({vectors(), p, vectors(), vectors(), vectors()});
    }
  }
};

const Elements& elements() {
  static const Elements all;
  return all;
}

template <class Kernel>
void run(benchmark::State& state, const Kernel& kernel) {
  elements();
  for (auto _ : state)
    for (int e = 0; e < n_elements; ++e) kernel(e);
  state.counters["tets"] = benchmark::Counter(static_cast<double>(state.iterations()) * n_elements,
                                              benchmark::Counter::kIsRate);
}

/// Four elements at a time, with what it takes to put them into lanes.
template <class Kernel>
void run_packs(benchmark::State& state, const Kernel& kernel) {
  elements();
  for (auto _ : state)
    for (int e = 0; e < n_elements; e += Pack::size) kernel(e);
  state.counters["tets"] = benchmark::Counter(static_cast<double>(state.iterations()) * n_elements,
                                              benchmark::Counter::kIsRate);
}

void geometry(benchmark::State& state) {
  run(state, [](int e) { benchmark::DoNotOptimize(make_tet4(elements().x[e])); });
}

void laplace(benchmark::State& state) {
  run(state, [](int e) { benchmark::DoNotOptimize(laplace_p1(elements().T[e])); });
}

const SolidCoefficients solid_constants{122.9, 1e-5, 2e-3};
const materials::Newtonian viscosity(3.5e-3);
const FluidCoefficients fluid_constants{1.0, &viscosity, 8.0};

void solid_residual(benchmark::State& state, const char* name) {
  const auto law = materials::make_law(name, {});
  run(state, [&](int e) {
    benchmark::DoNotOptimize(
        solid_up_residual(elements().T[e], elements().solid[e], *law, solid_constants));
  });
}

void solid_jacobian(benchmark::State& state, const char* name) {
  const auto law = materials::make_law(name, {});
  MixedResidual R;
  MixedJacobian K;
  run(state, [&](int e) {
    solid_up_jacobian(elements().T[e], elements().solid[e], *law, solid_constants, R, K);
    benchmark::DoNotOptimize(R);
    benchmark::DoNotOptimize(K);
  });
}

void packed_solid_jacobian(benchmark::State& state, const char* name) {
  const auto law = materials::make_law(name, {});
  std::array<Vec3Of<Pack>, 4> x;
  SolidStateOf<Pack> solid;
  const SolidCoefficientsOf<Pack> constants{solid_constants.alpha, solid_constants.inv_kappa,
                                            solid_constants.tau};
  PackedLaws laws;
  laws.laws.fill(law.get());
  MixedResidualOf<Pack> R;
  MixedJacobianOf<Pack> K;
  run_packs(state, [&](int e) {
    for (int lane = 0; lane < Pack::size; ++lane) {
      set_lane(x, lane, elements().x[e + lane]);
      set_lane(solid, lane, elements().solid[e + lane]);
    }
    solid_up_jacobian(make_tet4(x), solid, laws, constants, R, K);
    benchmark::DoNotOptimize(R);
    benchmark::DoNotOptimize(K);
  });
}

void packed_fluid_jacobian(benchmark::State& state) {
  std::array<Vec3Of<Pack>, 4> x;
  FluidStateOf<Pack> fluid;
  MixedResidualOf<Pack> R;
  MixedJacobianOf<Pack> K;
  run_packs(state, [&](int e) {
    Pack tau;
    for (int lane = 0; lane < Pack::size; ++lane) {
      const FluidState& mine = elements().fluid[e + lane];
      set_lane(x, lane, elements().x[e + lane]);
      set_lane(fluid, lane, mine);
      set_lane(
          tau, lane,
          fluid_tau(elements().T[e + lane], mine.u[0], viscosity.reference(), fluid_constants));
    }
    fluid_up_jacobian(make_tet4(x), fluid, fluid_constants, tau, R, K);
    benchmark::DoNotOptimize(R);
    benchmark::DoNotOptimize(K);
  });
}

void fluid_residual(benchmark::State& state) {
  run(state, [](int e) {
    const double tau = fluid_tau(elements().T[e], elements().fluid[e].u[0], viscosity.reference(),
                                 fluid_constants);
    benchmark::DoNotOptimize(
        fluid_up_residual(elements().T[e], elements().fluid[e], fluid_constants, tau));
  });
}

void fluid_jacobian(benchmark::State& state) {
  MixedResidual R;
  MixedJacobian K;
  run(state, [&](int e) {
    const double tau = fluid_tau(elements().T[e], elements().fluid[e].u[0], viscosity.reference(),
                                 fluid_constants);
    fluid_up_jacobian(elements().T[e], elements().fluid[e], fluid_constants, tau, R, K);
    benchmark::DoNotOptimize(R);
    benchmark::DoNotOptimize(K);
  });
}

BENCHMARK(geometry);
BENCHMARK(laplace);
BENCHMARK_CAPTURE(solid_residual, mooney_rivlin, "mooney-rivlin");
BENCHMARK_CAPTURE(solid_jacobian, mooney_rivlin, "mooney-rivlin");
BENCHMARK_CAPTURE(packed_solid_jacobian, mooney_rivlin, "mooney-rivlin");
BENCHMARK_CAPTURE(solid_jacobian, holzapfel, "holzapfel");
BENCHMARK_CAPTURE(packed_solid_jacobian, holzapfel, "holzapfel");
BENCHMARK(fluid_residual);
BENCHMARK(fluid_jacobian);
BENCHMARK(packed_fluid_jacobian);

}  // namespace

BENCHMARK_MAIN();
