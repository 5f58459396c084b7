#include "tunica/run/watch.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/boundary/registry.hpp"
#include "tunica/discretisation/solid_options.hpp"
#include "tunica/judge/stiffness.hpp"
#include "tunica/mesh/info.hpp"

namespace tunica::run {

namespace {

double volume(const std::array<Vec3, 4>& x) { return signed_volume(x[0], x[1], x[2], x[3]); }

/// Zero where the element is inverted.
double quality(const std::array<Vec3, 4>& x) { return volume(x) > 0.0 ? mesh::quality(x) : 0.0; }

bool has_nearly_incompressible_layers(const problems::SolidSettings& wall) {
  const std::vector<discretisation::Layer>& layers = wall.options.layers;
  return std::any_of(layers.begin(), layers.end(), [](const discretisation::Layer& layer) {
    return judge::is_nearly_incompressible(*discretisation::law_of(layer), layer.bulk_modulus);
  });
}

/// What may still be set of the mesh's motion to keep elements in shape, "" if nothing.
std::string unused_cures(const problems::MeshMotionSettings& motion) {
  std::string cures;
  if (motion.stiffening == 0.0) cures = "stiffening = 1";
  if (!motion.poisson_ratio) cures += (cures.empty() ? "" : " and ") + std::string("law = elastic");
  return cures.empty() ? "" : "Mesh Motion / " + cures + ", or ";
}

const double* find(const discretisation::Observables& all, const std::string& name) {
  for (const auto& o : all)
    if (o.name == name) return &o.value;
  return nullptr;
}

}  // namespace

Deformation worst_deformation(const fields::FieldMesh& mesh, const std::vector<Vec3>& d) {
  Deformation worst;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    auto x = assembly::gather(mesh.x, mesh.tets[e]);
    const double V = volume(x), q = quality(x);
    for (int a = 0; a < 4; ++a) x[a] += d[mesh.tets[e][a]];
    const double now = quality(x);
    worst.quality = std::min(worst.quality, now);
    worst.part_of_quality = std::min(worst.part_of_quality, now / q);
    worst.part_of_volume = std::min(worst.part_of_volume, volume(x) / V);
  }
  return {global_min(*mesh.comm, worst.quality), global_min(*mesh.comm, worst.part_of_quality),
          global_min(*mesh.comm, worst.part_of_volume)};
}

Watch::Watch(const setup::Case& the_case) {
  if (the_case.wall) has_nearly_incompressible_ = has_nearly_incompressible_layers(*the_case.wall);
  if (the_case.fluid)
    for (const auto& c : the_case.fluid->options.conditions)
      if (!c.list.isParameter("backflow stabilisation") ||
          c.list.get<double>("backflow stabilisation") > 0.0)
        guarded_.insert(c.surface);
  if (the_case.motion) mesh_cures_ = unused_cures(*the_case.motion);
  if (!the_case.coupling) return;
  most_newton_ = the_case.coupling->most_newton;
  most_iterations_ = the_case.coupling->most_iterations;
}

void Watch::say(const std::string& kind, const std::string& line) {
  if (said_.insert(kind).second) lines_.push_back("warning: " + line);
}

void Watch::look_at_volume(const discretisation::Observables& observables,
                           const std::function<std::vector<judge::LayerVolume>()>& wall) {
  const double *low = find(observables, "min_det_F"), *high = find(observables, "max_det_F");
  if (!has_nearly_incompressible_ || low == nullptr || high == nullptr || !wall) return;
  if ((*low >= 0.9 && *high <= 1.1) || said_.count("volume") > 0) return;
  for (const judge::LayerVolume& layer : wall()) {
    if (layer.beyond == 0) continue;  // other layers lose volume as they may
    if (judge::loses_volume(layer))
      say("volume", text_of(layer));
    else if (said_.insert("spread of " + layer.layer).second)
      lines_.push_back(text_of(layer));
  }
}

void Watch::look_at_outlets(const discretisation::Observables& observables, double step_size) {
  const std::string head = "inflow_", tail = "_mm3_per_ms";
  for (const auto& o : observables) {
    if (o.name.rfind(head, 0) != 0 || o.name.size() <= head.size() + tail.size()) continue;
    const std::string name = o.name.substr(head.size(), o.name.size() - head.size() - tail.size());
    largest_flow_ = std::max(largest_flow_, std::abs(o.value));
    if (guarded_.count(name) > 0) continue;
    double& out = volume_out_[name];
    if (out > 0.0 && o.value > 0.1 * largest_flow_)
      say("backflow " + name,
          formatted("flow returns through %s, at %.3g mm^3/ms, without backflow stabilisation to "
                    "remove the energy that it brings in; it may grow without bound. Set "
                    "\"backflow stabilisation\" = 0.2 in Fluid / Surfaces / %s.",
                    name.c_str(), o.value, name.c_str()));
    out -= o.value * step_size;
  }
}

void Watch::look_at_iterations(const StepSummary& step) {
  const auto near_cap = [&](int made, int most, const char* what, const std::string& cure) {
    if (most < 10 || made < 0.8 * most) return;
    say("iterations", formatted("the step took %d %s, where an attempt ends at %d; usual is a "
                                "third of that or less. Use shorter steps (Time / cuts = 4 halves "
                                "those that fail), a load that rises more slowly, or %s.",
                                made, what, most, cure.c_str()));
  };
  near_cap(step.coupling_iterations, most_iterations_, "coupling iterations",
           "a higher \"Coupling / max iterations\"");
  int newton = 0;
  for (const StepSummary::Solves& field : step.fields) newton = std::max(newton, field.newton);
  near_cap(newton, most_newton_, "Newton steps",
           mesh_cures_ + "larger elements where walls move far");
}

void Watch::look_at_mesh(const fields::FieldMesh& mesh, const std::vector<Vec3>& d) {
  const Deformation worst = worst_deformation(mesh, d);
  if (worst.part_of_quality > 0.3 && worst.part_of_volume > 0.1) return;
  say("mesh",
      formatted("an element of the fluid's mesh has %.2g of the quality that it had, one %.2g of "
                "its volume, the worst is of quality %.2g; usual are 0.5 or more. It will soon be "
                "inverted. Use %slarger elements beside the interface, where it moves far.",
                worst.part_of_quality, worst.part_of_volume, worst.quality, mesh_cures_.c_str()));
}

std::vector<std::string> Watch::look(const StepSummary& step, double step_size,
                                     const discretisation::Observables& observables,
                                     const fields::FieldMesh* fluid, const std::vector<Vec3>& d,
                                     const std::function<std::vector<judge::LayerVolume>()>& wall) {
  lines_.clear();
  look_at_volume(observables, wall);
  look_at_outlets(observables, step_size);
  look_at_iterations(step);
  if (fluid != nullptr && !d.empty() && said_.count("mesh") == 0) look_at_mesh(*fluid, d);
  return lines_;
}

void Watch::tell(const RunLog& log, const stepping::Clock& clock, const StepSummary& step,
                 const discretisation::Observables& observables, const fields::FieldMesh* fluid,
                 const std::vector<Vec3>& d,
                 const std::function<std::vector<judge::LayerVolume>()>& wall) {
  if (!step.is_accepted) return;
  for (const std::string& line : look(step, clock.step_size(), observables, fluid, d, wall))
    log.note(line);
}

}  // namespace tunica::run
