#include "tunica/boundary/support.hpp"

#include "tunica/assembly/gather.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/boundary/follower_pressure.hpp"

namespace tunica::boundary {

namespace {

/// P of a face, and ∫ N_a N_b dA = m (1 + δ_ab).
struct Bed {
  Mat3 P;
  double m;
};

Bed bed_of(const Surroundings& s, const fields::Face& face, bool is_normal) {
  const Vec3 n = kernels::area_normal(assembly::gather(*s.reference, face.nodes));
  const double A = norm(n);
  const Vec3 N = 1.0 / A * n;
  return {is_normal ? Mat3{N[0] * N, N[1] * N, N[2] * N} : identity(), A / 12.0};
}

// d + o
std::array<Vec3, 3> stretch_of(const Surroundings& s, const fields::Face& face) {
  std::array<Vec3, 3> d = assembly::gather(*s.u, face.nodes);
  if (s.spring_offset == nullptr) return d;
  const auto offset = assembly::gather(*s.spring_offset, face.nodes);
  for (int a = 0; a < 3; ++a) d[a] += offset[a];
  return d;
}

}  // namespace

Support::Support(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int surface)
    : name_(mesh.surfaces[surface]), surface_(surface), stiffness_(list.get<double>("stiffness")),
      damping_(list.get<double>("damping")),
      is_normal_(list.get<std::string>("direction") == "normal") {}

void Support::add(const Surroundings& s, const fields::Face& face, assembly::NodalResidual& R,
                  assembly::BlockAssembler* K) const {
  const Bed bed = bed_of(s, face, is_normal_);
  const auto d = stretch_of(s, face), v = assembly::gather(*s.w, face.nodes);
  std::array<Vec3, 3> t;  // at the nodes
  for (int a = 0; a < 3; ++a) t[a] = bed.P * (stiffness_ * d[a] + damping_ * v[a]);
  kernels::SurfaceResidual Re;
  for (int a = 0; a < 3; ++a) Re.u[a] = bed.m * (t[0] + t[1] + t[2] + t[a]);
  R.add(*s.mesh, face, Re);
  if (K == nullptr) return;
  const double k = stiffness_ + damping_ * scheme_->rate();
  kernels::SurfaceJacobian Ke;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          Ke.A[a][b][i][j] = k * bed.m * (a == b ? 2.0 : 1.0) * bed.P[i][j];
  K->add(face, Ke);
}

std::vector<Vec3> Support::sprung_directions(const fields::FieldMesh& mesh,
                                             const fields::Face& face) const {
  if (stiffness_ == 0.0) return {};
  if (!is_normal_) return {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  return {unit(kernels::area_normal(assembly::gather(mesh.x, face.nodes)))};
}

std::array<double, 5> Support::sums_of(const Surroundings& s, const fields::Face& face) const {
  const Bed bed = bed_of(s, face, is_normal_);
  const auto d = stretch_of(s, face), v = assembly::gather(*s.w, face.nodes);
  const auto square = [&bed](const std::array<Vec3, 3>& x) {  // ∫ x·P x dA
    const Vec3 sum = x[0] + x[1] + x[2];
    double total = dot(sum, bed.P * sum);
    for (const Vec3& each : x) total += dot(each, bed.P * each);
    return bed.m * total;
  };
  const Vec3 t = stiffness_ * (d[0] + d[1] + d[2]) + damping_ * (v[0] + v[1] + v[2]);
  const Vec3 force = -4.0 * bed.m * (bed.P * t);  // a third of the area each
  return {0.5 * stiffness_ * square(d), damping_ * square(v), force[0], force[1], force[2]};
}

void Support::observe_whole(const Surroundings& s, std::map<std::string, double>& found) const {
  std::vector<double> mine(5, 0.0);
  for (const fields::Face& face : s.mesh->faces) {
    if (face.surface != surface_ || !face.is_owned) continue;
    const std::array<double, 5> sums = sums_of(s, face);
    for (int k = 0; k < 5; ++k) mine[k] += sums[k];
  }
  const std::vector<double> all = global_sum(*s.mesh->comm, mine);
  found["support_energy_" + name_ + "_kPa_mm3"] = all[0];
  found["support_power_" + name_ + "_kPa_mm3_per_ms"] = all[1];
  for (int i = 0; i < 3; ++i) found["support_force_" + name_ + "_" + "xyz"[i] + "_mN"] = all[2 + i];
}

ConditionEntry support_condition() {
  params::Table table("The tissue around the wall: springs and dashpots, and a pressure.");
  table
      .number("stiffness", 0.0, params::non_negative(), "kPa/mm",
              "stiffness of the springs, which are relaxed in the geometry of the mesh unless the "
              "search for a Prestress stretches them; 1e7 dyn/cm^3 are 100")
      .number("damping", 0.0, params::non_negative(), "kPa ms/mm",
              "damping of the dashpots; 1e4 dyn s/cm^3 are 100")
      .choice("direction", "normal", {"normal", "all"},
              "direction of springs and dashpots: along the normal of the undeformed surface, or "
              "all directions")
      .number("pressure", 0.0, params::any(), "kPa",
              "external pressure, which follows the deformed surface, times the amplitude")
      .sublist("Amplitude", stepping::time_function_table());
  return {Field::wall, "support", table,
          [](const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int surface) {
            Terms all = terms(std::make_unique<Support>(list, mesh, surface));
            if (list.get<double>("pressure") != 0.0)
              all.push_back(std::make_unique<FollowerPressure>(list));
            return all;
          },
          [](const Teuchos::ParameterList& list) {
            return Drive{Drive::Kind::pressure, list.get<double>("pressure")};
          }};
}

}  // namespace tunica::boundary
