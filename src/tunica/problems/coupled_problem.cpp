#include "tunica/problems/coupled_problem.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/io/progress.hpp"

namespace tunica::problems {

namespace {

/// Cut apart where pressures jump: at the interface, and where the wall has two.
std::unique_ptr<fields::SplitMesh> mesh_of_pressures(const CoupledProblem::Parts& parts) {
  std::vector<int> part = parts.wall.field().pressure_parts();
  for (int& p : part) p += 1;  // the lumen comes first
  return fields::split_mesh(parts.mesh, part);
}

constexpr const char* name_of_fluid = "lumen";
constexpr const char* name_of_wall = "wall";

fields::MeshParts parts_of_mesh(const CoupledProblem::Parts& parts) {
  fields::MeshParts named{{name_of_fluid, name_of_wall, "interface"},
                          parts.wall.field().pressure_parts()};
  for (int& part : named.of_region) part = part < 0 ? 0 : 1;
  named.is_solid.assign(named.of_region.begin(), named.of_region.end());
  return named;
}

int rank_of(const FieldProblem& field) { return field.products() ? field.products()->rank() : 0; }

/// What the wall leaves free at its owned interface nodes, at all nodes of the fluid.
std::vector<Mat3> seen_by_fluid(const fields::InterfaceTransfer& interface,
                                const fields::FieldMesh& fluid, const assembly::Constraints& wall) {
  std::vector<Mat3> free(fluid.n_nodes());
  for (int i = 0; i < 3; ++i) {
    Vector owned(fluid.vector_map);  // row i of P
    {
      const auto rows = owned.getLocalViewHost(read_write);
      for (int k = 0; k < interface.n_owned(); ++k) {
        const Mat3 P = wall.projector(interface.wall_nodes[k]);
        for (int j = 0; j < 3; ++j) rows(3 * interface.fluid_nodes[k] + j, 0) = P[i][j];
      }
    }
    const std::vector<Vec3> all = fields::ghosted_vectors(fluid, owned);
    for (int a = 0; a < fluid.n_nodes(); ++a) free[a][i] = all[a];
  }
  return free;
}

}  // namespace

/// What the domain makes of the residual as it follows the interface, where the Jacobian is to
/// know: S E, with the fluid's shape derivatives S and the extension E of the interface's
/// displacement Δt y into the mesh.
class CoupledProblem::FollowingDomain final : public algebra::BlockAction {
public:
  explicit FollowingDomain(const CoupledProblem& problem) : problem_(&problem) {}

  bool is_zero() const override { return !problem_->knows_domain_; }

  void add(const algebra::BlockVector& x, algebra::BlockVector& result) const override {
    if (is_zero()) return;
    const CoupledProblem& p = *problem_;
    algebra::BlockVector y(p.fluid_->space()), F(y.space());
    Vector& velocity = y["velocity"];
    Vector d(velocity.getMap());
    p.fluid_part_->restrict(x, y);
    p.fluid_->hold_prescribed(y);
    velocity.scale(p.dt_);
    p.motion_->extend_increment(p.product_tolerance_, velocity, d);  // d = E Δt y
    p.fluid_->field().shape_jacobian().add_product(d, F);
    p.fluid_part_->add(F, result);
  }

private:
  const CoupledProblem* problem_;
};

CoupledProblem::CoupledProblem(const CoupledSettings& settings, const Parts& parts)
    : mesh_(&parts.mesh), interface_(&parts.interface), fluid_(&parts.fluid), wall_(&parts.wall),
      motion_(&parts.motion), is_extrapolated_(settings.geometry == DomainRule::extrapolated),
      wants_shape_derivatives_(settings.geometry == DomainRule::newton),
      product_tolerance_(settings.product_tolerance), knows_domain_(wants_shape_derivatives_),
      split_(mesh_of_pressures(parts)),
      K_(std::make_unique<fields::BlockOperator>(
          parts.mesh, fields::NodalBlocks{{"velocity", 3}, {"pressure", 1}}, split_.get(),
          parts_of_mesh(parts))),
      newton_(settings.solves.newton), rule_(newton_.jacobian_cost), fluid_x_(fluid_->space()),
      wall_x_(wall_->space()), fluid_F_(fluid_->space()), wall_F_(wall_->space()),
      jacobian_fluid_x_(fluid_->space()), jacobian_wall_x_(wall_->space()),
      reference_(wall_->space()), followed_(wall_x_["displacement"].getMap()) {
  tie_fields();
  // A system cannot be solved better than its products are known.
  const double best =
      newton_.forcing.kind == "constant" ? newton_.forcing.tolerance : newton_.forcing.smallest;
  product_tolerance_ = std::min(product_tolerance_, std::max(best, 1e-14));
  if (!is_extrapolated_) {
    // Nor need the mesh follow an increment better than the increment is known.
    mesh_accuracy_ = {settings.mesh_tolerance, best};
    K_->set_action(std::make_shared<FollowingDomain>(*this));
  }
  solver_ = linear::make_linear_solver(settings.solves.linear_solver, *K_, *this);
}

CoupledProblem::~CoupledProblem() = default;

// P_f and P_w pick the unknowns of the fields from x; at the interface both pick the same y, free
// as far as the wall leaves it.
void CoupledProblem::tie_fields() {
  for (std::size_t s = 0; s < mesh_->surfaces.size(); ++s) {
    bool meets = false;
    for (const int a : interface_->wall_nodes)
      meets = meets || wall_->mesh().is_on(a, static_cast<int>(s));
    TUNICA_CHECK(!wall_->field().moves_as_one(static_cast<int>(s)) ||
                     global_max(*mesh_->comm, meets ? 1.0 : 0.0) == 0.0,
                 "Wall / Surfaces / " + mesh_->surfaces[s] +
                     ": nodes of the interface cannot move as one where Coupling / scheme is "
                     "\"monolithic\"; use \"dirichlet-neumann\", or \"clamped\" or \"held\".");
  }
  fluid_->field().release_interface(
      seen_by_fluid(*interface_, fluid_->mesh(), wall_->constraints()));
  fluid_place_ = fields::place_in(fluid_->mesh(), *mesh_);
  wall_place_ = fields::place_in(wall_->mesh(), *mesh_);
  fluid_part_ =
      std::make_unique<algebra::Embedding>(fields::embed({fluid_->mesh(), fluid_->split()}, *K_));
  wall_part_ =
      std::make_unique<algebra::Embedding>(fields::embed({wall_->mesh(), wall_->split()}, *K_));
  const int rank = rank_of(*fluid_) + rank_of(*wall_);
  if (rank > 0) K_->make_low_rank(rank);
}

// On the interface d̃ is the past of the mesh, which moves with the wall; elsewhere in the wall any
// d̃ does, as only d counts.
void CoupledProblem::set_reference() {
  reference_["displacement"].assign(wall_->state()["displacement"]);
  reference_["pressure"].putScalar(0.0);
  const std::vector<Vec3> past = motion_->past_displacement();
  const auto d = reference_["displacement"].getLocalViewHost(read_write);
  for (int k = 0; k < interface_->n_owned(); ++k)
    for (int i = 0; i < 3; ++i)
      d(3 * interface_->wall_nodes[k] + i, 0) = past[interface_->fluid_nodes[k]][i];
}

// Units of the wall in the whole: its displacement is Δt y, so that on the interface both fields
// have the velocity y, and its continuity is divided by Δt, so that K stays of one size.
Outcome CoupledProblem::begin_step(const stepping::Clock& clock) {
  fluid_->begin_step(clock);
  wall_->begin_step(clock);
  wall_->field().set_nodal_force(std::vector<Vec3>(wall_->mesh().n_owned));
  rule_ = nonlinear::JacobianRule(newton_.jacobian_cost);  // as the fields' begin_step()
  solver_->forget();
  dt_ = 1.0 / fluid_->time_scheme().rate();
  wall_part_->set_units({dt_, 1.0}, {1.0, 1.0 / dt_});
  set_reference();
  has_followed_ = false;
  seconds_ = {};
  if (!is_extrapolated_) return Outcome::success();  // the domain follows the guess
  const Outcome placed =
      fluid_->field().set_domain(motion_->predicted_displacement(), motion_->past_displacement());
  fluid_->field().fix_coefficients();
  return placed.at("the fluid's mesh");
}

// x_f = P_f x,   x_w = P_w S x + (d̃, 0)
void CoupledProblem::read(const algebra::BlockVector& x) {
  fluid_part_->restrict(x, fluid_x_);
  wall_part_->restrict(x, wall_x_);
  for (int b = 0; b < wall_x_.n_blocks(); ++b) wall_x_[b].update(1.0, reference_[b], 1.0);
}

// d_m = E d on the interface, of the wall's present d;   w = (d_m − d̃)/Δt
Outcome CoupledProblem::follow_wall(const ExtensionAccuracy& accuracy) {
  const Stopwatch watch;
  const std::vector<Vec3> d = fields::owned_vectors(wall_->mesh(), wall_x_["displacement"]);
  has_followed_ = false;
  const Outcome moved = motion_->extend(interface_->to_fluid(interface_->from_wall(d)), accuracy);
  seconds_.motion += watch.seconds();
  if (moved.is_failure()) return moved.at("the mesh motion");
  const Outcome placed =
      fluid_->field().set_domain(motion_->displacement(), motion_->past_displacement());
  has_followed_ = placed.is_success();
  followed_.assign(wall_x_["displacement"]);
  return placed.at("the fluid's mesh");
}

bool CoupledProblem::is_domain_of_wall() const {
  const auto at = followed_.getLocalViewHost(read_only);
  const auto now = wall_x_["displacement"].getLocalViewHost(read_only);
  bool is_same = has_followed_;
  for (std::size_t k = 0; k < at.extent(0) && is_same; ++k) is_same = at(k, 0) == now(k, 0);
  return all_agree(*mesh_->comm, is_same);
}

// F(x) = R_f P_fᵀ F_f(x_f, d_m(x_w)) + R_w P_wᵀ F_w(x_w): on the interface the sum of both is the
// balance of forces.
Outcome CoupledProblem::residual(const algebra::BlockVector& x, algebra::BlockVector& F) {
  read(x);
  if (!is_extrapolated_) {
    if (const Outcome outcome = follow_wall(mesh_accuracy_); outcome.is_failure()) return outcome;
    fluid_->field().prescribe(fluid_x_);  // a flow rate through an opening that has changed
  }
  const Stopwatch flowing;
  if (const Outcome outcome = fluid_->residual(fluid_x_, fluid_F_); outcome.is_failure())
    return outcome.at("the fluid");
  seconds_.fluid += flowing.seconds();
  const Stopwatch straining;
  if (const Outcome outcome = wall_->residual(wall_x_, wall_F_); outcome.is_failure())
    return outcome.at("the wall");
  seconds_.wall += straining.seconds();
  F.set_zero();
  fluid_part_->add(fluid_F_, F);
  wall_part_->add(wall_F_, F);
  return Outcome::success();
}

void CoupledProblem::jacobian(const algebra::BlockVector& x) {
  read(x);
  if (!is_extrapolated_) {
    if (!is_domain_of_wall())
      if (const Outcome outcome = follow_wall(mesh_accuracy_); outcome.is_failure())
        throw std::logic_error("a Jacobian where there is no residual: " + outcome.reason());
    fluid_->field().prescribe(fluid_x_);
  }
  jacobian_fluid_x_.assign(fluid_x_);
  jacobian_wall_x_.assign(wall_x_);
  // K = Σ R Pᵀ K_i P S over the fields, see algebra::Embedding
  const Stopwatch opening;
  K_->begin_assembly();
  seconds_.matrix += opening.seconds();
  const Stopwatch flowing;
  fluid_->add_jacobian(fluid_x_, {K_.get(), &fluid_place_, fluid_part_.get()});
  if (knows_domain_) fluid_->field().assemble_shape_jacobian(fluid_x_);
  seconds_.fluid += flowing.seconds();
  const Stopwatch straining;
  wall_->add_jacobian(wall_x_, {K_.get(), &wall_place_, wall_part_.get()});
  seconds_.wall += straining.seconds();
  const Stopwatch closing;
  if (const auto& L = fluid_->products()) fluid_part_->set_products(*L, *K_->low_rank(), 0);
  if (const auto& L = wall_->products())
    wall_part_->set_products(*L, *K_->low_rank(), rank_of(*fluid_));
  K_->end_assembly();
  solver_->matrix_changed();
  seconds_.matrix += closing.seconds();
}

void CoupledProblem::watch_solves(SolveWatch watch) {
  solver_ = watched(std::move(solver_), std::move(watch));
}

namespace {

constexpr const char* mass = "Schur Mass";

}  // namespace

std::vector<std::string> CoupledProblem::operator_names() const {
  return {mass, linear::own_block_of(name_of_fluid), linear::own_block_of(name_of_wall)};
}

// In units of the whole the wall has the modulus Δt μ, and its continuity is divided by Δt.
Teuchos::RCP<const CrsMatrix> CoupledProblem::assemble_operator(const std::string& name) const {
  const auto names = operator_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) return Teuchos::null;
  const int b = name == mass ? 1 : 0;
  const auto M =
      algebra::matrix_on(name == mass ? (*K_->space())[1].nodes.graph : (*K_)(0, 0)->getCrsGraph());
  M->resumeFill();
  const auto add = [&](FieldProblem& field, const algebra::BlockVector& at,
                       const algebra::Embedding& part) {
    if (b == 1) return part.add_block(*field.operators().assemble_operator(mass), 1, 1, *M);
    fields::BlockOperator own(field.mesh(), fields::mixed_blocks, field.split());
    own.begin_assembly();
    field.add_jacobian(at, {&own, nullptr, nullptr});
    part.add_block(*own(0, 0), 0, 0, *M);
  };
  if (name != linear::own_block_of(name_of_wall)) add(*fluid_, jacobian_fluid_x_, *fluid_part_);
  if (name != linear::own_block_of(name_of_fluid)) add(*wall_, jacobian_wall_x_, *wall_part_);
  M->fillComplete(M->getDomainMap(), M->getRangeMap());
  return M;
}

// On the interface both leave free what the wall does.
void CoupledProblem::hold_prescribed(algebra::BlockVector& dx) const {
  const auto hold = [&](const FieldProblem& field, const algebra::Embedding& part) {
    algebra::BlockVector y(field.space());
    part.restrict(dx, y);
    field.hold_prescribed(y);
    part.insert(y, dx);
  };
  hold(*fluid_, *fluid_part_);
  hold(*wall_, *wall_part_);
}

// Δt |dy|, the root mean square over the vertices [mm]: velocities of the fluid count as
// displacements.
double CoupledProblem::increment_norm(const algebra::BlockVector& dx) {
  return dt_ * dx["velocity"].norm2() /
         std::sqrt(static_cast<double>(mesh_->node_map->getGlobalNumElements()));
}

CoupledProblem::Solution CoupledProblem::solve(const algebra::BlockVector& fluid,
                                               const algebra::BlockVector& wall, bool wants_any) {
  if (wants_shape_derivatives_ != knows_domain_) rule_.forget();  // the last Jacobian is another
  knows_domain_ = wants_shape_derivatives_;
  return solve(newton_, rule_, fluid, wall, wants_any);
}

CoupledProblem::Solution CoupledProblem::solve_carefully(const algebra::BlockVector& fluid,
                                                         const algebra::BlockVector& wall,
                                                         bool wants_any) {
  knows_domain_ = !is_extrapolated_;
  nonlinear::NewtonOptions careful = newton_;
  careful.line_search = "decrease";
  careful.max_iterations *= 4;
  nonlinear::JacobianRule always(0.0);
  rule_.forget();
  return solve(careful, always, fluid, wall, wants_any);
}

// x ← x − J⁻¹ F(x), with J = K at first and, where that takes or would take too long, J = K + S E;
// from where the steps with K have led, if they have become shorter, else from the start.
nonlinear::NewtonReport CoupledProblem::find_root(const nonlinear::NewtonOptions& options,
                                                  nonlinear::JacobianRule& rule,
                                                  algebra::BlockVector& x) {
  if (knows_domain_ || is_extrapolated_ || most_steps_without_ == 0)
    return nonlinear::solve_newton(*this, options, x, &rule);
  algebra::BlockVector start(x.space());
  start.assign(x);
  nonlinear::NewtonOptions without = options;
  without.max_iterations = std::min(options.max_iterations, most_steps_without_);
  without.tries_again = false;
  without.looks_ahead = true;
  const nonlinear::NewtonReport first = nonlinear::solve_newton(*this, without, x, &rule);
  if (first.is_converged) return first;
  const bool is_nearer =
      first.is_too_slow && first.steps.back().increment < first.steps.front().increment;
  if (!is_nearer) x.assign(start);
  knows_domain_ = true;
  rule.forget();
  nonlinear::NewtonReport all = nonlinear::solve_newton(*this, options, x, &rule);
  all.comes_after(first);
  return all;
}

CoupledProblem::Solution CoupledProblem::solve(const nonlinear::NewtonOptions& options,
                                               nonlinear::JacobianRule& rule,
                                               const algebra::BlockVector& fluid,
                                               const algebra::BlockVector& wall, bool wants_any) {
  const io::ProgressScope scope("fluid and wall");
  algebra::BlockVector x(space());
  wall_x_.assign(wall);
  wall_->field().prescribe(wall_x_);
  if (!is_extrapolated_)  // what is prescribed may depend on where the domain lies
    if (const Outcome outcome = follow_wall({mesh_accuracy_.tolerance}); outcome.is_failure())
      return {{false, outcome.reason(), {}}, false};
  // y of the wall, which is that of the interface
  for (int b = 0; b < wall_x_.n_blocks(); ++b) wall_x_[b].update(-1.0, reference_[b], 1.0);
  fluid_x_.assign(fluid);
  fluid_->field().prescribe(fluid_x_);
  fluid_part_->insert(fluid_x_, x);
  wall_part_->insert(wall_x_, x);
  const bool knew = knows_domain_;
  Solution solution{find_root(options, rule, x), false};
  solution.has_gone_over = knows_domain_ && !knew;
  solution.is_taken = solution.newton.is_converged;
  // Not accurate, but admissible after all the steps that are permitted
  if (!solution.is_taken && wants_any &&
      static_cast<int>(solution.newton.steps.size()) - solution.newton.earlier_steps >=
          options.max_iterations) {
    algebra::BlockVector F(space());
    solution.is_taken = residual(x, F).is_success();
  }
  if (solution.is_taken) {
    read(x);
    if (!is_extrapolated_) fluid_->field().prescribe(fluid_x_);
    fluid_->take(fluid_x_);
    wall_->take(wall_x_);
  }
  return solution;
}

Outcome CoupledProblem::accept() {
  // f = −R_u of the fluid, with which the wall's residual is that of the wall alone
  wall_->field().set_nodal_force(interface_->to_wall(interface_->from_fluid(fluid_->reaction())));
  fluid_->end_step();
  wall_->end_step();
  if (is_extrapolated_)
    if (const Outcome outcome = follow_wall({}); outcome.is_failure()) return outcome;
  motion_->end_step();
  return Outcome::success();
}

}  // namespace tunica::problems
