#include "tunica/problems/mesh_motion.hpp"

#include "tunica/algebra/components.hpp"
#include "tunica/base/fault_point.hpp"
#include "tunica/base/traffic.hpp"
#include "tunica/io/progress.hpp"

namespace tunica::problems {

namespace {

/// Steps from which the next one may be guessed.
constexpr int most_guessed_from = 3;

// The whole boundary is given to the volume: surfaces that follow have been found before it.
std::vector<char> nodes_of_surfaces(const fields::FieldMesh& mesh) {
  std::vector<char> is_given(mesh.n_nodes());
  for (int a = 0; a < mesh.n_nodes(); ++a) is_given[a] = mesh.is_on_boundary(a);
  return is_given;
}

}  // namespace

MeshMotionSettings::MeshMotionSettings(const Teuchos::ParameterList& list)
    : stiffening(list.get<double>("stiffening")), linear_solver(list.sublist("Linear Solver")) {
  if (list.get<std::string>("law") == "elastic") poisson_ratio = list.get<double>("poisson ratio");
}

// The scheme is the fluid's: w = (d_f − d̃_f)/Δt_e is made as u̇ is, from the timeline kept here.
MeshMotion::MeshMotion(const MeshMotionSettings& settings, const fields::FieldMesh& mesh,
                       const std::vector<int>& interface, const std::vector<int>& staying,
                       const stepping::TimeScheme& scheme)
    : mesh_(&mesh), is_interface_(mesh.n_owned, 0), surfaces_(settings, mesh, interface, staying),
      volume_(settings, mesh, nodes_of_surfaces(mesh), discretisation::Extent::volume),
      scheme_(&scheme),
      timeline_(fields::Places::nodes(mesh), 3, scheme.remembers(), most_guessed_from),
      d_(mesh.n_nodes()) {
  for (int a = 0; a < mesh.n_owned; ++a) is_interface_[a] = mesh.is_on_any(a, interface);
}

// d_f = E d: d on the interface and zero on what stays, then lines, surfaces and volume in turn,
// each with what was found before for its boundary. E is linear and acts on the undeformed mesh, so
// that d_f does not depend on the way there.
Outcome MeshMotion::extend(const std::vector<Vec3>& interface_displacement,
                           const ExtensionAccuracy& accuracy) {
  const TrafficScope scope(Work::mesh_motion);
  const io::ProgressScope progress("mesh motion");
  MultiVector total(mesh_->node_map, 3);
  {
    const auto view = total.getLocalViewHost(overwrite_all);
    for (int a = 0; a < mesh_->n_owned; ++a)
      for (int i = 0; i < 3; ++i)
        view(a, i) = is_interface_[a] ? interface_displacement[a][i] : 0.0;
  }
  fault_point("mesh motion");
  if (const Outcome outcome = surfaces_.extend(total, accuracy); outcome.is_failure())
    return outcome;
  if (const Outcome outcome = volume_.problem().extend(total, accuracy); outcome.is_failure())
    return outcome;
  // Elements between ranks need d_f at ghosts as well.
  MultiVector ghosted(mesh_->ghosted_map, 3);
  ghosted.doImport(total, *mesh_->import, insert);
  const auto view = ghosted.getLocalViewHost(read_only);
  for (int a = 0; a < mesh_->n_nodes(); ++a) d_[a] = {view(a, 0), view(a, 1), view(a, 2)};
  return Outcome::success();
}

Outcome MeshMotion::start_from(const std::vector<Vec3>& interface_displacement) {
  const Outcome outcome = extend(interface_displacement);
  if (outcome.is_success()) timeline_.value() = fields::as_rows(d_);
  return outcome;
}

// δd_f = E δd, the same map, only as well as a product with the Jacobian needs it. The last d_f,
// with which extend() begins next time, stays.
void MeshMotion::extend_increment(double tolerance, const Vector& interface, Vector& d) {
  const TrafficScope scope(Work::mesh_motion);
  const io::ProgressScope progress("mesh motion");
  MultiVector total(mesh_->node_map, 3);
  {
    const auto from = interface.getLocalViewHost(read_only);
    const auto to = total.getLocalViewHost(overwrite_all);
    for (int a = 0; a < mesh_->n_owned; ++a)
      for (int i = 0; i < 3; ++i) to(a, i) = is_interface_[a] ? from(3 * a + i, 0) : 0.0;
  }
  surfaces_.extend_roughly(tolerance, total);
  volume_.problem().extend_roughly(tolerance, total);
  algebra::from_columns(total, d);
}

// E Σ_k c_k dⁿ⁻ᵏ = Σ_k c_k d_fⁿ⁻ᵏ
void MeshMotion::begin_extrapolated(int degree, const stepping::StepSizes& sizes) {
  begin_with(timeline_.extrapolated(degree, sizes));
}

void MeshMotion::begin_with(const stepping::Rows& local) {
  MultiVector values(mesh_->node_map, 3);
  {
    const auto view = values.getLocalViewHost(overwrite_all);
    for (int a = 0; a < mesh_->n_owned; ++a)
      for (int i = 0; i < 3; ++i) view(a, i) = local[3 * a + i];
  }
  surfaces_.start_from(values);
  volume_.problem().start_from(values);
}

fields::State MeshMotion::save() const {
  fields::State state = fields::state_on(*mesh_);
  state.arrays["displacement"] = fields::rows_of(d_, mesh_->n_owned);
  timeline_.save_past("", state);
  return state;
}

std::string MeshMotion::restore(const fields::State& state) {
  const stepping::Rows local = fields::Places::nodes(*mesh_).local_rows(state, "displacement", 3);
  d_ = fields::as_vectors(local);
  timeline_.restore_past("", state, local);
  // d_f is where iterative solvers begin: with it a restarted run makes the same iterations.
  begin_with(local);
  return "";
}

params::Table mesh_motion_table() {
  params::Table table(
      "ALE mesh motion: extension of the wall's displacement into the fluid's mesh.");
  params::Table elastic("as a linear elastic body, which shears before it is squeezed");
  elastic.number("poisson ratio", 0.3, params::between(0.0, 0.45), "1",
                 "Poisson's ratio, the resistance to a change of volume");
  table.variant(
      "law", "harmonic",
      {{"harmonic", params::Table("harmonic extension of each component")}, {"elastic", elastic}},
      "law of the mesh between its boundaries");
  table.number("stiffening", 0.0, params::between(0.0, 4.0), "1",
               "elements have the modulus (mean volume / their volume) to this power, so that "
               "small ones keep their shape where the wall moves far; 0: all equal, 1: usual");
  table.sublist("Linear Solver", linear::scalar_solver_table());
  return table;
}

}  // namespace tunica::problems
