// Each smoother by itself, without multigrid: the factor by which 20 sweeps reduce |b − K x|.
#include <cstdio>
#include <functional>

#include "stokes.hpp"
#include "tunica/smoothers/braess_sarazin/braess_sarazin.hpp"
#include "tunica/smoothers/node_ilu/node_ilu.hpp"
#include "tunica/smoothers/vanka/vanka.hpp"

namespace {

double norm(const Stokes& stokes, const MultiVector& x) {
  MultiVector r(*stokes.b, Teuchos::Copy);
  stokes.K->apply(x, r, Teuchos::NO_TRANS, -1.0, 1.0);
  Teuchos::Array<double> of_r(1);
  r.norm2(of_r());
  return of_r[0];
}

void report(const char* name, const Stokes& stokes,
            const std::function<void(MultiVector&)>& sweep) {
  MultiVector x(stokes.map, 1);
  const double first = norm(stokes, x);
  for (int k = 0; k < 20; ++k) sweep(x);
  const double reduction = norm(stokes, x) / first;
  if (stokes.map->getComm()->getRank() == 0) std::printf("%s %.3e\n", name, reduction);
}

}  // namespace

int main(int argc, char** argv) {
  Tpetra::ScopeGuard session(&argc, &argv);
  const Stokes stokes(6);
  tunica::smoothers::MixedRows mixed;
  for (long long row = stokes.map->getMinGlobalIndex(); row <= stokes.map->getMaxGlobalIndex();
       ++row)
    mixed.is_pressure.push_back(row % 4 == 3);

  const auto vanka = tunica::smoothers::make_vanka(*stokes.K, mixed, {});
  vanka->refresh();
  report("vanka", stokes, [&](MultiVector& x) { vanka->smooth(*stokes.b, x); });
  const auto ilu = tunica::smoothers::make_node_ilu(*stokes.K, {}, {});
  ilu->refresh();
  report("node-ilu", stokes, [&](MultiVector& x) { ilu->smooth(1.0, *stokes.b, x); });
  const tunica::smoothers::BraessSarazin braess_sarazin(*stokes.K, {}, {});
  report("braess-sarazin", stokes, [&](MultiVector& x) { braess_sarazin.smooth(*stokes.b, x); });
  return 0;
}
