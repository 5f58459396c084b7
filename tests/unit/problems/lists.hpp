#pragma once
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <limits>
#include <string>

#include "tunica/params/table.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "unit/fields/small_tube.hpp"

namespace tunica::test {

/// Adds a surface condition to a "Fluid" or "Wall" list and returns it.
inline Teuchos::ParameterList& condition(Teuchos::ParameterList& list, const std::string& surface,
                                         const std::string& kind) {
  return list.sublist("Surfaces").sublist(surface).set("condition", kind);
}

inline void set_vector(Teuchos::ParameterList& list, const std::string& key, const Vec3& v) {
  list.set(key, Teuchos::Array<double>(std::vector<double>(v.begin(), v.end())));
}

inline Teuchos::ParameterList fluid_list(double density, double viscosity) {
  Teuchos::ParameterList list;
  list.set("density", density);
  list.set("viscosity", viscosity);
  list.sublist("Linear Solver").set("method", std::string("direct"));
  return list;
}

inline Teuchos::ParameterList wall_list() {
  Teuchos::ParameterList list;
  list.sublist("Layers").sublist("media");
  list.sublist("Layers").sublist("adventitia");
  list.sublist("Linear Solver").set("method", std::string("direct"));
  return list;
}

inline Teuchos::ParameterList resolved(Teuchos::ParameterList list, const params::Table& table) {
  table.resolve(list, "Case", "");
  return list;
}

/// x without the entries of nodes on the given surfaces, where conditions fix the vector.
inline algebra::BlockVector free_part(const fields::FieldMesh& mesh, algebra::BlockVector x,
                                      const std::vector<int>& surfaces) {
  const auto u = x[0].getLocalViewHost(Tpetra::Access::ReadWrite);
  for (int a = 0; a < mesh.n_owned; ++a)
    for (const int s : surfaces)
      if (mesh.is_on(a, s))
        for (int i = 0; i < 3; ++i) u(3 * a + i, 0) = 0.0;
  return x;
}

/// Numbers without pattern for all unknowns of a problem, as test::scattered() on its mesh.
inline algebra::BlockVector scattered(const problems::FieldProblem& problem, int seed,
                                      double size = 1.0) {
  algebra::BlockVector x(problem.space());
  x[0].assign(scattered(problem.mesh(), seed, size)[0]);
  const auto p = x[1].getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (int a = 0; a < problem.scalar_mesh().n_owned; ++a)
    p(a, 0) =
        size * scatter(1000.0 * seed + 4.0 * problem.scalar_mesh().vertex[a] + 3 + 0.37 * seed);
  return x;
}

/// |K v − (F(x + εv) − F(x − εv))/2ε| / |K v|
template <class Problem>
double jacobian_error(Problem& problem, const algebra::BlockVector& x,
                      const algebra::BlockVector& v, double epsilon) {
  const algebra::BlockSpacePtr& space = problem.space();
  algebra::BlockVector plus(space), minus(space), F(space), quotient(space), Kv(space);
  plus.assign(x);
  minus.assign(x);
  add(epsilon, v, plus);
  add(-epsilon, v, minus);
  if (problem.residual(plus, quotient).is_failure() || problem.residual(minus, F).is_failure())
    return std::numeric_limits<double>::infinity();
  add(-1.0, F, quotient);
  quotient[0].scale(0.5 / epsilon);
  quotient[1].scale(0.5 / epsilon);
  problem.jacobian(x);
  problem.apply_jacobian(v, Kv);
  return relative_difference(quotient, Kv);
}

inline double observed(const discretisation::Observables& all, const std::string& name) {
  for (const auto& o : all)
    if (o.name == name) return o.value;
  return std::nan("");
}

/// Brings a problem into the saved state of another, with all parts that belong to it, as a restart
/// does. Returns what could not be used.
inline std::string take_over(fields::Restartable& from, fields::Restartable& to) {
  std::string remarks = to.restore(from.save());
  for (const auto& [name, part] : from.inner_parts())
    remarks += to.inner_parts().at(name)->restore(part->save());
  return remarks;
}

}  // namespace tunica::test
