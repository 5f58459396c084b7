#pragma once
#include <memory>
#include <stdexcept>
#include <vector>

#include "tunica/algebra/dof_layout.hpp"

namespace tunica::smoothers {

/// Incomplete factors ILU(k) [Sa03, 10.3] of a mixed matrix, in blocks of a node's unknowns: fill
/// is counted on the graph of the nodes, and the unknowns of one are eliminated exactly, together
/// with those of the nodes it is host of.
class NodeIlu {
public:
  virtual ~NodeIlu() = default;
  /// Takes over the present values of the matrix. The factors are those of K + s diag(K_ii), K_ii
  /// the blocks of the nodes: a small shift s keeps factors of indefinite or flat matrices from
  /// growing along chains of nodes [Sa03, 10.3.5]. Throws std::runtime_error on all ranks where one
  /// has a block that cannot be inverted. Collective.
  virtual void refresh(double shift = 0.0) = 0;
  enum class Start { given, zero };  ///< zero: whatever x contains
  /// x += ω (L U)⁻¹ (b − K x) for one damping ω after the other; factors include the rows of other
  /// ranks that own ones reach, and each rank moves its own unknowns. Column by column. Throws
  /// std::invalid_argument for unlike numbers of columns. Collective.
  virtual void sweep(const std::vector<double>& dampings, Start start, const MultiVector& b,
                     MultiVector& x) = 0;
  /// One sweep. Throws as sweep(). Collective.
  void smooth(double damping, const MultiVector& b, MultiVector& x) {
    sweep({damping}, Start::given, b, x);
  }
  void smooth_from_zero(double damping, const MultiVector& b, MultiVector& x) {
    sweep({damping}, Start::zero, b, x);
  }
  /// r ← b − K x by the copy of the matrix. Throws as sweep(). Collective.
  virtual void residual(const MultiVector& b, const MultiVector& x, MultiVector& r) = 0;
  /// Bytes of the factors and a copy of the matrix on this rank.
  virtual double bytes() const = 0;
};

/// Of the copy of the matrix and of the factors, which have 16 bits with half and the copy 32:
/// incomplete as they are, eight binary digits are enough for them. Vectors are in double precision
/// but for what a sweep adds.
enum class Precision { half, single, full };

struct NodeIluOptions {
  int fill = 0;  ///< k
  Precision precision = Precision::half;
  /// Hosts of nodes that coincide with others, such as further pressures of a vertex: the number of
  /// the other node, by node; -1 or their own number for single nodes. Null: all nodes are single.
  Teuchos::RCP<const Vector> hosts{};
};

/// Factors with fill would be many times as large as K, as beside rows that couple nodes all over.
class TooMuchFill : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// K must outlive the factors, and keep its graph. Throws std::invalid_argument for more than
/// three components, TooMuchFill on all ranks. Collective.
std::unique_ptr<NodeIlu> make_node_ilu(const CrsMatrix& K, const algebra::DofLayout& numbering,
                                       const NodeIluOptions& options);

}  // namespace tunica::smoothers
