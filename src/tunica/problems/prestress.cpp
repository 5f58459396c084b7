#include "tunica/problems/prestress.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <deque>
#include <sstream>

#include "tunica/algebra/least_squares.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/boundary/registry.hpp"

namespace tunica::problems {

namespace {

using Teuchos::ParameterList;

/// The wall in equilibrium with its loads and a pressure on some surfaces.
ParameterList static_list(const ParameterList& list, double pressure) {
  ParameterList wall(list);
  wall.set("analysis", "static");
  wall.sublist("Prestress").set("pressure", 0.0);
  for (const std::string& surface : prestress_surfaces(list)) {
    ParameterList load;
    load.set("surface", surface).set("condition", "pressure").set("pressure", pressure);
    boundary::condition_table("", boundary::wall_conditions()).resolve(load, "Prestress", "");
    wall.sublist("Surfaces").sublist("prestress of " + surface) = load;
  }
  return wall;
}

double largest(const std::vector<Vec3>& values, const Comm& comm) {
  double mine = 0.0;
  for (const Vec3& v : values) mine = std::max(mine, norm(v));
  return global_max(comm, mine);
}

}  // namespace

bool wants_prestress(const ParameterList& list) {
  return list.sublist("Prestress").get<double>("pressure") != 0.0;
}

std::vector<std::string> prestress_surfaces(const ParameterList& list) {
  return list.sublist("Prestress").get<Teuchos::Array<std::string>>("surfaces").toVector();
}

namespace {

/// Iterations in which the way from the mesh must have halved.
constexpr int patience = 10;

/// The way from no load to all of it.
class Search {
public:
  using Report = std::function<void(const PrestressIteration&)>;

  Search(const ParameterList& list, const SolidProblem& wall, const Report& report)
      : list_(&list), wall_(&wall), report_(&report), options_(&list.sublist("Prestress")),
        found_(nothing(wall)) {}

  Result<Prestress> run() {
    double step = 1.0 / options_->get<int>("load steps");
    const double smallest = step / 256.0;
    for (double done = 0.0; done < 1.0;) {
      const double load = done + step > 1.0 - 1e-9 ? 1.0 : done + step;
      const std::vector<Vec3> shape_before = found_.from_stress_free;
      algebra::BlockVector state_before(found_.state.space());
      state_before.assign(found_.state);
      ++load_step_;
      const Outcome outcome = bear(load);
      if (outcome.is_success()) {
        done = load;
        step *= 1.5;
        continue;
      }
      found_.from_stress_free = shape_before;
      found_.state.assign(state_before);
      step *= 0.5;
      if (step < smallest)
        return Result<Prestress>::failure(text(load) + outcome.reason() +
                                          ". Where a wall is too soft for the pressure no such "
                                          "shape exists");
    }
    return std::move(found_);
  }

private:
  static Prestress nothing(const SolidProblem& wall) {
    Prestress none{std::vector<Vec3>(wall.mesh().n_owned), algebra::BlockVector(wall.space())};
    none.state.set_zero();
    return none;
  }

  std::string text(double load) const {
    std::ostringstream words;
    words << "the prestress, at " << load * options_->get<double>("pressure") << " of "
          << options_->get<double>("pressure") << " kPa: ";
    return words.str();
  }

  /// The shape that this part of the pressure deforms to the mesh, from that of a smaller part.
  Outcome bear(double load) {
    // The shape of a smaller load is only where the next one begins.
    const double tolerance = std::max(options_->get<double>("tolerance"), load < 1.0 ? 0.01 : 0.0);
    const int most = options_->get<int>("max iterations");
    const stepping::Clock start(1e-9, 1);  // other loads are those at the beginning
    SolidProblem equilibrium(static_list(*list_, load * options_->get<double>("pressure")),
                             wall_->mesh(), wall_->elements().frames);
    model_ = {};
    std::vector<double> history;  // of the way from the mesh
    for (int k = 1; k <= most; ++k) {
      const Outcome shaped = equilibrium.set_stress_free(found_.from_stress_free);
      if (shaped.is_failure()) return shaped;
      equilibrium.take(found_.state);
      equilibrium.begin_step(start);
      const nonlinear::NewtonReport newton = equilibrium.solve();
      if (!newton.is_converged) return Outcome::failure(newton.reason);
      found_.state["pressure"].assign(equilibrium.state()["pressure"]);
      const std::vector<Vec3> d = equilibrium.displacement();
      unload(d);
      const double moved = largest(d, comm()), way = largest(found_.from_stress_free, comm());
      (*report_)({load_step_, k, load, moved, way});
      if (moved <= tolerance * way) return Outcome::success();
      history.push_back(moved);
      if (k > patience && moved > 0.5 * history[k - 1 - patience])
        return Outcome::failure("the wall comes no closer to the mesh than " +
                                std::to_string(moved) + " mm");
    }
    return Outcome::failure("the shape without stress is not found in " + std::to_string(most) +
                            " iterations");
  }

  // e ← e + d − Σ_j c_j (Δe_j + Δd_j),   c = argmin |d − Σ_j c_j Δd_j|,   e = x − X:
  // what did not fall by itself is taken from what the last iterations have changed [DBV].
  void unload(const std::vector<Vec3>& d) {
    const std::vector<double> r = numbers(d), e = numbers(found_.from_stress_free);
    if (!model_.last_r.empty()) {
      model_.of_r.push_front(difference(r, model_.last_r));
      model_.of_e.push_front(difference(e, model_.last_e));
    }
    if (model_.of_r.size() > 12) {
      model_.of_r.pop_back();
      model_.of_e.pop_back();
    }
    model_.last_r = r;
    model_.last_e = e;
    const auto fit = algebra::solve_least_squares(comm(), model_.of_r, r, 1e-3);
    for (std::size_t i = 0; i < r.size(); ++i) {
      double change = r[i];
      for (std::size_t j = 0; j < model_.of_r.size(); ++j)
        change -= fit.coefficients[j] * (model_.of_e[j][i] + model_.of_r[j][i]);
      found_.from_stress_free[i / 3][i % 3] += change;
    }
  }

  static std::vector<double> numbers(const std::vector<Vec3>& values) {
    std::vector<double> all;
    for (const Vec3& v : values) all.insert(all.end(), v.begin(), v.end());
    return all;
  }
  static std::vector<double> difference(std::vector<double> a, const std::vector<double>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
    return a;
  }
  const Comm& comm() const { return *wall_->mesh().comm; }

  /// What the iterations of a load step have changed, newest first.
  struct Model {
    std::vector<double> last_r, last_e;
    std::deque<std::vector<double>> of_r, of_e;
  };

  const ParameterList* list_;
  const SolidProblem* wall_;
  const Report* report_;
  const ParameterList* options_;
  Prestress found_;
  Model model_;
  int load_step_ = 0;
};

}  // namespace

Result<Prestress> find_prestress(const ParameterList& list, const SolidProblem& wall,
                                 const std::function<void(const PrestressIteration&)>& report) {
  return Search(list, wall, report).run();
}

params::Table prestress_table() {
  params::Table table("The stress that the wall has in the geometry of the mesh.");
  table
      .number(
          "pressure", 0.0, params::any(), "kPa",
          "in the lumen of the vessel when it was imaged; 0: the mesh is free of stress. 80 mmHg "
          "are 10.67 kPa")
      .names("surfaces", std::vector<std::string>{"interface"}, "that bear this pressure")
      .integer(
          "load steps", 4, params::Range{1.0, 1000.0},
          "in which the pressure is raised at first; where one fails it is halved, where it does "
          "not the next is longer")
      .number("tolerance", 1e-5, params::Range{0.0, 0.1, true, false}, "1",
              "how far the wall may be from the mesh, in parts of its way from the shape without "
              "stress")
      .integer("max iterations", 100, params::Range{1.0, 10000.0}, "in each load step");
  return table;
}

}  // namespace tunica::problems
