// One sweep of Vanka's smoother on the wall's Jacobian of a case in its initial state, one rank:
//
//   bench_vanka CASE.xml MESH
//
// "MB" is what a sweep must read and write if each patch finds nothing in the caches: its
// inverse, the blocks of its nodes' rows, the vectors at its rows and columns. The rows of a patch
// are rows of a dozen others, so caches can supply them; "MB of inverses" counts only what is read
// once. "share" is their rate over that of the triad a = b + s c measured here, "MB kept" what
// the smoother holds.

#include <benchmark/benchmark.h>

#include <Ifpack2_BlockRelaxation.hpp>
#include <Tpetra_Core.hpp>
#include <filesystem>
#include <map>
#include <memory>

#include "tunica/algebra/merged_matrix.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/params/read_xml.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "tunica/run/domain.hpp"
#include "tunica/setup/schema.hpp"
#include "tunica/smoothers/node_ilu/node_ilu.hpp"
#include "tunica/smoothers/vanka/vanka.hpp"

namespace {

using namespace tunica;

/// Best seconds of each benchmark, for the ratios at the end.
std::map<std::string, double>& best() {
  static std::map<std::string, double> seconds;
  return seconds;
}

template <class Work>
double measure(benchmark::State& state, const std::string& name, const Work& work) {
  double& least = best().emplace(name, 1e300).first->second;
  for (auto _ : state) {
    const Stopwatch watch;
    work();
    least = std::min(least, watch.seconds());
  }
  return least;
}

void triad(benchmark::State& state, std::size_t n) {
  static std::vector<double> a, b, c;
  a.resize(n), b.assign(n, 1.0), c.assign(n, 2.0);
  measure(state, "triad", [&] {
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 3.0 * c[i];
    benchmark::ClobberMemory();
  });
  best()["bandwidth"] = 24.0 * static_cast<double>(n) / best()["triad"];
  state.counters["GB/s"] = best()["bandwidth"] / 1e9;
}

/// The Jacobian of the wall as one matrix.
struct Wall {
  Teuchos::ParameterList list;
  run::Domain domain;
  std::unique_ptr<problems::SolidProblem> problem;
  std::unique_ptr<algebra::MergedMatrix> merged;

  Wall(const std::string& case_file, const std::string& mesh) : list(params::read_xml(case_file)) {
    list.sublist("Mesh").set("file", std::filesystem::absolute(mesh).string());
    for (const char* field : {"Fluid", "Wall"})
      list.sublist(field).sublist("Linear Solver") =
          Teuchos::ParameterList("Linear Solver").set("preconditioner", "none");
    setup::fsi_table().resolve(list, "", "/");
    domain = run::load_domain(list, Tpetra::getDefaultComm());
    problem = std::make_unique<problems::SolidProblem>(list.sublist("Wall"), domain.mesh("wall"));
    problem->begin_step(stepping::Clock(list.sublist("Time")));
    problem->jacobian(problem->state());
    merged = std::make_unique<algebra::MergedMatrix>(problem->last_jacobian());
    merged->refresh();
  }

  Teuchos::RCP<CrsMatrix> K() const { return merged->matrix(); }
};

struct Bytes {
  double inverses = 0.0, rows = 0.0, vectors = 0.0;
};

Bytes bytes_of_sweep(const CrsMatrix& K, const smoothers::VankaPatches& patches, int per_value) {
  const auto start = K.getLocalMatrixHost().graph.row_map;
  Bytes bytes;
  for (int p = 0; p < patches.n_patches(); ++p) {
    const double n = patches.size(p);
    std::size_t entries = 0, columns = 0;
    for (std::size_t k = patches.start[p]; k < patches.start[p + 1]; ++k) {
      const std::size_t length = start(patches.rows[k] + 1) - start(patches.rows[k]);
      entries += length;
      columns = std::max(columns, length);
    }
    bytes.inverses += per_value * n * n;
    bytes.rows += (8.0 + 4.0 / 12.0) * static_cast<double>(entries);
    bytes.vectors += 8.0 * static_cast<double>(columns) + 28.0 * n;  // x; b, x, x, row numbers
  }
  return bytes;
}

void sweep(benchmark::State& state, const Wall& wall, bool is_single) {
  smoothers::VankaOptions options;
  options.order = "forward";
  options.is_single = is_single;
  const auto mixed = smoothers::mixed_rows(*wall.K(), {});
  const auto smoother = smoothers::make_vanka(*wall.K(), mixed, options);
  smoother->refresh();
  Vector b(wall.K()->getRowMap()), x(b.getMap());
  b.randomize();
  const double seconds =
      measure(state, is_single ? "single sweep" : "double sweep", [&] { smoother->smooth(b, x); });
  const Bytes bytes =
      bytes_of_sweep(*wall.K(), smoothers::make_vanka_patches(*wall.K(), mixed.is_pressure),
                     is_single ? sizeof(float) : sizeof(double));
  const double all = bytes.inverses + bytes.rows + bytes.vectors;
  state.counters["MB kept"] = smoother->bytes() / 1e6;
  state.counters["MB"] = all / 1e6;
  state.counters["MB of inverses"] = bytes.inverses / 1e6;
  state.counters["GB/s"] = all / seconds / 1e9;
  state.counters["share"] = all / seconds / best()["bandwidth"];
  state.counters["share of inverses"] = bytes.inverses / seconds / best()["bandwidth"];
}

/// With the other kinds of patches, in double precision.
void sweep_of_kind(benchmark::State& state, const Wall& wall, const std::string& patch) {
  smoothers::VankaOptions options;
  options.order = "forward";
  options.patch = patch;
  const auto smoother =
      smoothers::make_vanka(*wall.K(), smoothers::mixed_rows(*wall.K(), {}), options);
  smoother->refresh();
  Vector b(wall.K()->getRowMap()), x(b.getMap());
  b.randomize();
  measure(state, patch + " sweep", [&] { smoother->smooth(b, x); });
  state.counters["MB kept"] = smoother->bytes() / 1e6;
}

std::string word_of(smoothers::Precision precision) {
  if (precision == smoothers::Precision::half) return "half";
  return precision == smoothers::Precision::single ? "single" : "double";
}

void ilu_sweep(benchmark::State& state, const Wall& wall, int fill,
               smoothers::Precision precision) {
  const auto factors = smoothers::make_node_ilu(*wall.K(), {}, {fill, precision});
  factors->refresh();
  Vector r(wall.K()->getRowMap()), x(r.getMap());
  r.randomize();
  const std::string name = word_of(precision) + " ILU(" + std::to_string(fill) + ")";
  const double seconds = measure(state, name, [&] { factors->smooth(1.0, r, x); });
  state.counters["MB kept"] = factors->bytes() / 1e6;
  state.counters["share"] = factors->bytes() / seconds / best()["bandwidth"];
}

void ilu_set_up(benchmark::State& state, const Wall& wall, int fill) {
  const auto factors = smoothers::make_node_ilu(*wall.K(), {}, {fill});
  measure(state, "ILU(" + std::to_string(fill) + ") set-up", [&] { factors->refresh(); });
}

void product(benchmark::State& state, const Wall& wall) {
  Vector x(wall.K()->getDomainMap()), y(wall.K()->getRangeMap());
  x.randomize();
  measure(state, "product with K", [&] { wall.K()->apply(x, y); });
}

void set_up(benchmark::State& state, const Wall& wall, const std::string& patch, bool is_single) {
  smoothers::VankaOptions options;
  options.is_single = is_single;
  options.patch = patch;
  const auto smoother =
      smoothers::make_vanka(*wall.K(), smoothers::mixed_rows(*wall.K(), {}), options);
  const std::string kind = patch != "full" ? patch : is_single ? "single" : "double";
  measure(state, kind + " set-up", [&] { smoother->refresh(); });
}

using BlockRelaxation = Ifpack2::BlockRelaxation<RowMatrix>;

/// Ifpack2's on the same patches: what it calls Gauss-Seidel is the forward sweep.
std::unique_ptr<BlockRelaxation> block_relaxation(const Wall& wall) {
  const auto patches =
      smoothers::make_vanka_patches(*wall.K(), smoothers::mixed_rows(*wall.K(), {}).is_pressure);
  Teuchos::Array<Teuchos::ArrayRCP<int>> parts;
  for (int p = 0; p < patches.n_patches(); ++p)
    parts.push_back(Teuchos::arcpClone(
        Teuchos::ArrayView<const int>(patches.rows.data() + patches.start[p], patches.size(p))));
  Teuchos::ParameterList list;
  list.set("relaxation: container", "Dense").set("relaxation: type", "Gauss-Seidel");
  list.set("relaxation: zero starting solution", false);
  list.set("partitioner: type", "user").set("partitioner: parts", parts);
  auto relaxation = std::make_unique<BlockRelaxation>(wall.K());
  relaxation->setParameters(list);
  relaxation->initialize();
  return relaxation;
}

void ifpack2_sweep(benchmark::State& state, const Wall& wall) {
  const auto relaxation = block_relaxation(wall);
  relaxation->compute();
  Vector b(wall.K()->getRowMap()), x(b.getMap());
  b.randomize();
  measure(state, "Ifpack2 sweep", [&] { relaxation->apply(b, x); });
}

void ifpack2_set_up(benchmark::State& state, const Wall& wall) {
  for (auto _ : state) {
    const auto relaxation = block_relaxation(wall);  // compute() expects empty blocks
    const Stopwatch watch;
    relaxation->compute();
    double& least = best().emplace("Ifpack2 set-up", 1e300).first->second;
    least = std::min(least, watch.seconds());
    state.SetIterationTime(watch.seconds());
  }
}

void print_ratio(const std::string& slow, const std::string& fast) {
  std::printf("%-15s / %-15s %6.2f\n", slow.c_str(), fast.c_str(), best()[slow] / best()[fast]);
}

}  // namespace

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  benchmark::Initialize(&argc, argv);
  if (argc != 3) {
    std::fprintf(stderr, "usage: bench_vanka CASE.xml MESH\n");
    return 1;
  }
  const Wall wall(argv[1], argv[2]);
  std::printf("%lld unknowns\n", static_cast<long long>(wall.K()->getGlobalNumRows()));
  const std::size_t n = 20'000'000;
  using benchmark::RegisterBenchmark;
  RegisterBenchmark("triad", triad, n)->Unit(benchmark::kMillisecond);
  const auto add = [&](const char* name, auto function, auto... rest) {
    return RegisterBenchmark(name, function, std::cref(wall), rest...)
        ->Unit(benchmark::kMillisecond);
  };
  add("product with K", product);
  add("forward sweep, double", sweep, false);
  add("forward sweep, single", sweep, true);
  for (const std::string patch : {"diagonal", "node pair"})
    add(("forward sweep, " + patch).c_str(), sweep_of_kind, patch);
  add("forward sweep, Ifpack2", ifpack2_sweep);
  add("ILU(0) sweep, double", ilu_sweep, 0, smoothers::Precision::full);
  add("ILU(0) sweep, single", ilu_sweep, 0, smoothers::Precision::single);
  add("ILU(0) sweep, half", ilu_sweep, 0, smoothers::Precision::half);
  add("ILU(1) sweep, half", ilu_sweep, 1, smoothers::Precision::half);
  add("set-up, ILU(0)", ilu_set_up, 0);
  add("set-up, ILU(1)", ilu_set_up, 1);
  add("set-up, double", set_up, "full", false);
  add("set-up, single", set_up, "full", true);
  for (const std::string patch : {"diagonal", "node pair"})
    add(("set-up, " + patch).c_str(), set_up, patch, false);
  add("set-up, Ifpack2", ifpack2_set_up)->UseManualTime();
  benchmark::RunSpecifiedBenchmarks();
  print_ratio("double sweep", "single sweep");
  print_ratio("Ifpack2 sweep", "double sweep");
  print_ratio("Ifpack2 sweep", "single sweep");
  for (const std::string patch : {"diagonal", "node pair"})
    print_ratio("double sweep", patch + " sweep");
  print_ratio("Ifpack2 set-up", "double set-up");
  for (const std::string patch : {"diagonal", "node pair"})
    print_ratio("double set-up", patch + " set-up");
  print_ratio("double sweep", "product with K");
  print_ratio("double set-up", "double sweep");
  return 0;
}
