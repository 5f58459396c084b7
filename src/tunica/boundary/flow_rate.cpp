#include "tunica/boundary/flow_rate.hpp"

#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/surface_tri3.hpp"

namespace tunica::boundary {

namespace {

Vec3 area_vector(const Cap& cap) {
  Vec3 sum{};
  for (const auto& t : cap.triangles)
    sum += kernels::area_normal({cap.x[t[0]], cap.x[t[1]], cap.x[t[2]]});
  return sum;
}

/// Q_k of f(t) = Re Σ_k Q_k e^{ikωt} over a period, k = 0…K, from so many samples that kinks of a
/// table do not matter.
std::vector<std::complex<double>> fourier(const stepping::TimeFunction& f, int K) {
  constexpr int n = 4096;
  std::vector<std::complex<double>> Q(K + 1);
  for (int j = 0; j < n; ++j) {
    const double value = f(f.period() * j / n);
    for (int k = 0; k <= K; ++k)
      Q[k] += (k == 0 ? 1.0 : 2.0) / n * value * std::polar(1.0, -2.0 * M_PI * k * j / n);
  }
  return Q;
}

}  // namespace

FlowRate::FlowRate(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int surface)
    : surface_(surface), flow_rate_(list.get<double>("flow rate")),
      amplitude_(list.sublist("Amplitude")),
      n_harmonics_(list.isParameter("harmonics") ? list.get<int>("harmonics") : 0),
      cap_(gather_cap(mesh, surface)), place_(mesh.n_owned) {
  const Vec3 all = area_vector(cap_);
  area_ = norm(all);
  normal_ = 1.0 / area_ * all;
  const bool is_flat = list.get<std::string>("profile") == "flat";
  steady_ = is_flat ? flat_profile(cap_) : harmonic_profile(cap_);
  for (int a = 0; a < mesh.n_owned; ++a) place_[a] = cap_.find(mesh.vertex[a]);
}

void FlowRate::find_harmonics(double nu) {
  Q_ = fourier(amplitude_, n_harmonics_);
  for (int k = 1; k <= n_harmonics_; ++k)
    phi_.push_back(womersley_profile(cap_, 2.0 * M_PI * k / amplitude_.period(), nu));
}

std::vector<double> FlowRate::speeds(double time) const {
  double rest = amplitude_(time);
  std::vector<double> speed(cap_.vertex.size(), 0.0);
  for (int k = 1; k <= n_harmonics_; ++k) {
    const auto Q = Q_[k] * std::polar(1.0, 2.0 * M_PI * k * time / amplitude_.period());
    rest -= Q.real();
    for (std::size_t a = 0; a < speed.size(); ++a) speed[a] += std::real(Q * phi_[k - 1][a]);
  }
  for (std::size_t a = 0; a < speed.size(); ++a)
    speed[a] = flow_rate_ * (speed[a] + rest * steady_[a]);
  return speed;
}

double FlowRate::relative_area(const Surroundings& s) const {
  double mine = 0.0;
  for (const Vec3& a : nodal_areas(*s.mesh, *s.position, {surface_})) mine += dot(a, normal_);
  return global_sum(*s.mesh->comm, mine) / area_;
}

void FlowRate::prepare(const Surroundings& s) {
  if (n_harmonics_ > 0 && phi_.empty()) find_harmonics(s.viscosity / s.density);
  speed_ = speeds(s.time);
  const double grown = relative_area(s);
  for (double& v : speed_) v /= grown;
}

Vec3 FlowRate::prescribed(const Surroundings& s, int node) const {
  if (s.velocity != nullptr) return (*s.velocity)((*s.position)[node], s.time);
  return -speed_[place_[node]] * normal_;
}

ConditionEntry flow_rate_condition() {
  params::Table womersley;
  womersley.integer(
      "harmonics", 16, params::between(1.0, 200.0),
      "of the flow rate that have profiles of their own; the rest has that of a steady "
      "flow");
  params::Table table("A flow rate into the fluid, along the normal of a surface of any shape.");
  table
      .number("flow rate", std::nullopt, params::any(), "mm^3/ms",
              "that flows in, times the amplitude; 1 ml/s is 1 mm^3/ms")
      .variant(
          "profile", "parabolic",
          {{"flat", params::Table("the same everywhere but for the rim")},
           {"parabolic", params::Table("of a steady flow in a long pipe of this section")},
           {"womersley", womersley}},
          "how the velocity is distributed; womersley: of a periodic flow in a long pipe of this "
          "section, each harmonic by itself")
      .sublist("Amplitude", stepping::time_function_table())
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        if (!list.isParameter("profile") || list.get<std::string>("profile") != "womersley") return;
        const Teuchos::ParameterList& amplitude = list.sublist("Amplitude");
        TUNICA_CHECK(amplitude.isParameter("period") && amplitude.get<double>("period") > 0.0,
                     path +
                         ": the profile \"womersley\" is that of a periodic flow. Give the "
                         "Amplitude a \"period\".");
      });
  return {Field::fluid, "flow rate", table,
          [](const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int surface) {
            try {
              return terms(std::make_unique<FlowRate>(list, mesh, surface));
            } catch (const Error& error) {
              throw Error("Fluid / Surfaces / " + mesh.surfaces[surface] + ": " + error.what());
            }
          },
          [](const Teuchos::ParameterList& list) {
            return Drive{Drive::Kind::flow, list.get<double>("flow rate")};
          }};
}

}  // namespace tunica::boundary
