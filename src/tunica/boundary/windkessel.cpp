#include "tunica/boundary/windkessel.hpp"

#include "tunica/assembly/gather.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/boundary/backflow.hpp"
#include "tunica/boundary/surface_geometry.hpp"
#include "tunica/boundary/traction.hpp"
#include "tunica/kernels/surface_tri3.hpp"

namespace tunica::boundary {

namespace {

/// p_c at the start.
double initial_pressure(const Teuchos::ParameterList& list) {
  if (const double Q = list.get<double>("mean flow"); Q != 0.0)
    return list.get<double>("distal pressure") + list.get<double>("distal resistance") * Q;
  return list.get<double>("initial pressure");
}

}  // namespace

Windkessel::Windkessel(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh,
                       int surface)
    : name_(mesh.surfaces[surface]), surface_(surface),
      proximal_(list.get<double>("proximal resistance")),
      capacitance_(list.get<double>("capacitance")), distal_(list.get<double>("distal resistance")),
      distal_pressure_(list.get<double>("distal pressure")),
      initial_pressure_(initial_pressure(list)), known_(initial_pressure_) {}

double Windkessel::flow(const Surroundings& s, const std::vector<Vec3>& area) const {
  double mine = 0.0;
  for (std::size_t a = 0; a < area.size(); ++a) mine += dot(area[a], (*s.u)[a] - (*s.w)[a]);
  return global_sum(*s.mesh->comm, mine);
}

void Windkessel::add_whole(const Surroundings& s, assembly::NodalResidual& R,
                           assembly::BlockAssembler* K) const {
  const std::vector<Vec3> area = nodal_areas(*s.mesh, *s.position, {surface_});
  const double Q = flow(s, area), p = proximal_ * Q + stored(Q);
  for (std::size_t a = 0; a < area.size(); ++a) R.u[a] += p * area[a];
  if (K != nullptr) K->add(proximal_ + slope_, area, area);
}

void Windkessel::add_whole_shape(const Surroundings& s, assembly::FluidShapeMatrix& S) const {
  const std::vector<Vec3> area = nodal_areas(*s.mesh, *s.position, {surface_});
  const double Q = flow(s, area), p = proximal_ * Q + stored(Q);
  std::vector<Vec3> of_flow(area.size());  // ∂Q/∂x, by the areas and by w
  for (std::size_t a = 0; a < area.size(); ++a) of_flow[a] = -s.mesh_rate * area[a];
  kernels::SurfaceResidual R;
  kernels::SurfaceJacobian K;
  for (const fields::Face& face : s.mesh->faces) {
    if (face.surface != surface_) continue;
    const auto x = assembly::gather(*s.position, face.nodes);
    kernels::follower_pressure_jacobian(x, p, R, K);
    S.add(face, K);
    Vec3 c{};
    for (const int a : face.nodes) c += 1.0 / 3.0 * ((*s.u)[a] - (*s.w)[a]);
    const std::array<Mat3, 3> D = kernels::area_normal_derivative(x);
    for (int b = 0; b < 3; ++b)
      if (face.nodes[b] < s.mesh->n_owned) of_flow[face.nodes[b]] += transpose(D[b]) * c;
  }
  S.add(proximal_ + slope_, area, of_flow);
}

void Windkessel::observe_whole(const Surroundings& s, std::map<std::string, double>& found) const {
  const std::vector<Vec3> area = nodal_areas(*s.mesh, *s.position, {surface_});
  const double Q = flow(s, area), p = proximal_ * Q + stored(Q);
  double mine = 0.0;
  for (std::size_t a = 0; a < area.size(); ++a) mine -= p * dot(area[a], (*s.u)[a]);
  found["pressure_" + name_ + "_kPa"] = p;
  found["stored_pressure_" + name_ + "_kPa"] = stored(Q);
  found[traction_power] += global_sum(*s.mesh->comm, mine);
}

void Windkessel::follow(const stepping::TimeScheme& scheme) {
  scheme_ = &scheme;
  stored_.emplace(fields::Places::everywhere(), 1, scheme.remembers());
  stored_->value() = {initial_pressure_};
}

void Windkessel::begin_step() {
  const double theta = scheme_->rate() * distal_ * capacitance_;
  slope_ = distal_ / (1.0 + theta);
  known_ = (theta * scheme_->past(*stored_, 0) + distal_pressure_) / (1.0 + theta);
}

void Windkessel::end_step(const Surroundings& s) {
  const double Q = flow(s, nodal_areas(*s.mesh, *s.position, {surface_}));
  scheme_->accept({stored(Q)}, *stored_);
}

std::vector<double> Windkessel::state() const { return stored_->numbers(); }

void Windkessel::restore(const std::vector<double>& state) { stored_->set_numbers(state); }

namespace {

Terms terms_of(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int surface) {
  Terms all = terms(std::make_unique<Windkessel>(list, mesh, surface));
  const double beta = list.get<double>("backflow stabilisation");
  if (beta != 0.0) all.push_back(std::make_unique<Backflow>(beta));
  return all;
}

constexpr const char* units_of_resistance =
    "; 1 dyn s/cm^5 is 1e-4 kPa ms/mm^3, 1 mmHg s/ml is 0.1333";

}  // namespace

ConditionEntry windkessel_condition() {
  params::Table table;
  table
      .number("proximal resistance", std::nullopt, params::non_negative(), "kPa ms/mm^3",
              std::string("R_p of p = R_p Q + p_c, where the flow Q leaves") + units_of_resistance)
      .number("capacitance", std::nullopt, params::non_negative(), "mm^3/kPa",
              "C of C dp_c/dt = Q - (p_c - p_d)/R_d; 0 leaves a resistance, the sum of both")
      .number("distal resistance", std::nullopt, params::non_negative(), "kPa ms/mm^3", "R_d")
      .number("distal pressure", 0.0, params::any(), "kPa", "p_d behind both resistances")
      .number("initial pressure", 0.0, params::any(), "kPa", "p_c at the start")
      .number("mean flow", 0.0, params::any(), "mm^3/ms",
              "mean flow Q through this outlet: p_c starts at p_d + R_d Q instead of the initial "
              "pressure, which shortens the transient");
  add_backflow_key(table);
  table.check([](const Teuchos::ParameterList& list, const std::string& path) {
    if (!list.isParameter("mean flow")) return;  // another condition
    TUNICA_CHECK(
        list.get<double>("mean flow") == 0.0 || list.get<double>("initial pressure") == 0.0,
        path + ": \"mean flow\" and \"initial pressure\" both define its initial state. Give one.");
  });
  return {Field::fluid, "windkessel", table, terms_of, [](const Teuchos::ParameterList& list) {
            const auto distal = list.get<double>("distal resistance");
            return Drive{
                Drive::Kind::pressure, initial_pressure(list),
                Drive::Outlet{list.get<double>("proximal resistance") + distal,
                              list.get<double>("distal pressure"), list.get<double>("mean flow"),
                              distal * list.get<double>("capacitance")}};
          }};
}

ConditionEntry resistance_condition() {
  params::Table table;
  table
      .number("resistance", std::nullopt, params::non_negative(), "kPa ms/mm^3",
              std::string("R of p = R Q + p_d, where the flow Q leaves") + units_of_resistance)
      .number("distal pressure", 0.0, params::any(), "kPa", "p_d behind it");
  add_backflow_key(table);
  return {Field::fluid, "resistance", table,
          [](const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int surface) {
            Teuchos::ParameterList all(list);
            all.set("proximal resistance", list.get<double>("resistance"));
            for (const char* none :
                 {"capacitance", "distal resistance", "initial pressure", "mean flow"})
              all.set(none, 0.0);
            return terms_of(all, mesh, surface);
          },
          [](const Teuchos::ParameterList& list) {
            const auto distal = list.get<double>("distal pressure");
            return Drive{Drive::Kind::pressure, distal,
                         Drive::Outlet{list.get<double>("resistance"), distal, 0.0, 0.0}};
          }};
}

}  // namespace tunica::boundary
