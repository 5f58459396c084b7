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
    : mesh_(&mesh), surface_(surface), flow_rate_(list.get<double>("flow rate")),
      is_flat_(list.get<std::string>("profile") == "flat"), amplitude_(list.sublist("Amplitude")),
      n_harmonics_(list.isParameter("harmonics") ? list.get<int>("harmonics") : 0),
      place_(mesh.n_owned) {}

void FlowRate::make_profile(const std::vector<int>& planes) {
  cap_ = gather_cap(*mesh_, surface_, planes);
  const Vec3 all = area_vector(cap_);
  normal_ = 1.0 / norm(all) * all;
  try {
    steady_ = is_flat_ ? flat_profile(cap_) : harmonic_profile(cap_);
  } catch (const Error& error) {
    throw Error("Fluid / Surfaces / " + mesh_->surfaces[surface_] + ": " + error.what());
  }
  for (int a = 0; a < mesh_->n_owned; ++a) place_[a] = cap_.find(mesh_->vertex[a]);
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

std::array<double, 2> FlowRate::flows(const Surroundings& s, const std::vector<double>& speed,
                                      const std::vector<double>& other) const {
  std::vector<double> mine{0.0, 0.0};
  const std::vector<Vec3> areas = nodal_areas(*s.mesh, *s.position, {surface_});
  for (int a = 0; a < s.mesh->n_owned; ++a) {
    if (place_[a] < 0) continue;
    mine[0] += speed[place_[a]] * dot(areas[a], normal_);
    mine[1] += other[place_[a]] * dot(areas[a], normal_);
  }
  const std::vector<double> all = global_sum(*s.mesh->comm, mine);
  return {all[0], all[1]};
}

void FlowRate::prepare(const Surroundings& s) {
  if (n_harmonics_ > 0 && phi_.empty()) find_harmonics(s.viscosity / s.density);
  speed_ = speeds(s.time);
  // v = (f + (Q − F(f)/g) φ)/g with the flows g = F(φ) and F(f), so that F(v) = Q on a surface
  // that has stretched; where it has done so evenly F(f) = g Q
  const auto [grown, through] = flows(s, steady_, speed_);
  const double rest = flow_rate_ * amplitude_(s.time) - through / grown;
  for (std::size_t a = 0; a < speed_.size(); ++a)
    speed_[a] = (speed_[a] + rest * steady_[a]) / grown;
}

Vec3 FlowRate::prescribed(const Surroundings& s, int node) const {
  if (s.velocity != nullptr) return (*s.velocity)((*s.position)[node], s.time);
  return -speed_[place_[node]] * normal_;
}

ConditionEntry flow_rate_condition() {
  params::Table womersley;
  womersley.integer("harmonics", 16, params::between(1.0, 200.0),
                    "number of harmonics of the flow rate with profiles of their own; the rest has "
                    "the profile of steady flow");
  params::Table table("A flow rate into the fluid, along the normal of a surface of any shape.");
  table
      .number("flow rate", std::nullopt, params::any(), "mm^3/ms",
              "flow into the fluid, times the amplitude; 1 ml/s is 1 mm^3/ms. Where planes of "
              "symmetry cut the surface, through what the mesh has of it")
      .variant("profile", "parabolic",
               {{"flat", params::Table("uniform except at the rim")},
                {"parabolic", params::Table("that of steady flow in a long pipe of this section")},
                {"womersley", womersley}},
               "velocity profile; womersley: that of periodic flow in a long pipe of this section, "
               "for each harmonic separately")
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
            return terms(std::make_unique<FlowRate>(list, mesh, surface));
          },
          [](const Teuchos::ParameterList& list) {
            return Drive{Drive::Kind::flow, list.get<double>("flow rate")};
          }};
}

}  // namespace tunica::boundary
