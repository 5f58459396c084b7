// Tetrahedra per second of one whole assembly: gathering the state, element residuals and
// Jacobians, scatter into the four matrices, surface terms, Dirichlet rows. One rank.
//
//   bench_assembly CASE.xml MESH

#include <benchmark/benchmark.h>

#include <Tpetra_Core.hpp>
#include <filesystem>
#include <memory>

#include "tunica/params/read_xml.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "tunica/run/domain.hpp"
#include "tunica/setup/schema.hpp"

namespace {

using namespace tunica;

/// The fields of a case in their initial state.
struct Fields {
  Teuchos::ParameterList list;
  run::Domain domain;
  std::unique_ptr<problems::FluidProblem> fluid;
  std::unique_ptr<problems::SolidProblem> wall;

  Fields(const std::string& case_file, const std::string& mesh)
      : list(params::read_xml(case_file)) {
    list.sublist("Mesh").set("file", std::filesystem::absolute(mesh).string());
    for (const char* field : {"Fluid", "Wall"})
      list.sublist(field).sublist("Linear Solver") =
          Teuchos::ParameterList("Linear Solver").set("preconditioner", "none");
    setup::fsi_table().resolve(list, "", "/");
    domain = run::load_domain(list, Tpetra::getDefaultComm());
    fluid = std::make_unique<problems::FluidProblem>(list.sublist("Fluid"), domain.mesh("fluid"));
    wall = std::make_unique<problems::SolidProblem>(list.sublist("Wall"), domain.mesh("wall"));
    const stepping::Clock clock(list.sublist("Time"));
    fluid->begin_step(clock);
    wall->begin_step(clock);
    const std::vector<Vec3> at_rest(domain.mesh("fluid").n_nodes());
    if (fluid->field().set_domain(at_rest, at_rest).is_failure())
      throw std::logic_error("inverted");
    fluid->prepare();
  }
};

template <class Problem>
void assemble(benchmark::State& state, Problem& problem) {
  for (auto _ : state) problem.jacobian(problem.state());
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations()) *
                          static_cast<int64_t>(problem.mesh().tets.size()));
}

template <class Problem>
void residual(benchmark::State& state, Problem& problem) {
  algebra::BlockVector F(problem.space());
  for (auto _ : state)
    if (problem.residual(problem.state(), F).is_failure()) state.SkipWithError("not admissible");
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations()) *
                          static_cast<int64_t>(problem.mesh().tets.size()));
}

}  // namespace

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  benchmark::Initialize(&argc, argv);
  if (argc != 3) {
    std::fprintf(stderr, "usage: bench_assembly CASE.xml MESH\n");
    return 1;
  }
  Fields fields(argv[1], argv[2]);
  using benchmark::RegisterBenchmark;
  RegisterBenchmark("wall residual and Jacobian", assemble<problems::SolidProblem>,
                    std::ref(*fields.wall));
  RegisterBenchmark("wall residual", residual<problems::SolidProblem>, std::ref(*fields.wall));
  RegisterBenchmark("fluid residual and Jacobian", assemble<problems::FluidProblem>,
                    std::ref(*fields.fluid));
  RegisterBenchmark("fluid residual", residual<problems::FluidProblem>, std::ref(*fields.fluid));
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
