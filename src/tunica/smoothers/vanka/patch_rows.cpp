#include "tunica/smoothers/vanka/patch_rows.hpp"

#include "tunica/smoothers/vanka/node_rows.hpp"

namespace tunica::smoothers {

namespace {

/// The matrix itself, as bare arrays.
class PlainRows final : public PatchRows {
public:
  explicit PlainRows(const CrsMatrix& K) : K_(&K), local_(K.getLocalMatrixHost()) {}

  void refresh() override { local_ = K_->getLocalMatrixHost(); }
  void residual(const int* rows, int n, const double* b, const double* x, double* r,
                const PrefetchRange& ahead) const override {
    const std::size_t* const start = local_.graph.row_map.data();
    const int* const columns = local_.graph.entries.data();
    const double* const values = local_.values.data();
    for (int a = 0; a < n; ++a) {
      prefetch(ahead, a, a + 1, n);
      double Kx = 0.0;
      for (std::size_t k = start[rows[a]]; k < start[rows[a] + 1]; ++k)
        Kx += values[k] * x[columns[k]];
      r[a] = b[rows[a]] - Kx;
    }
  }
  double bytes() const override { return 0.0; }

private:
  const CrsMatrix* K_;
  decltype(std::declval<CrsMatrix>().getLocalMatrixHost()) local_;
};

}  // namespace

std::unique_ptr<PatchRows> make_patch_rows(const CrsMatrix& K,
                                           const std::vector<char>& is_pressure) {
  if (NodeRows::can_hold(K, is_pressure)) return std::make_unique<NodeRows>(K);
  return std::make_unique<PlainRows>(K);
}

}  // namespace tunica::smoothers
