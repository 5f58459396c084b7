#pragma once
#include "tunica/assembly/block_assembler.hpp"

namespace tunica::assembly {

/// Unknowns that move as one: a component of the vector unknown at nodes of a surface. The common
/// value q is given, or a force is given that the unknowns take together.
///
///   u_a = q for the members a,    q = ū   or   Σ_a R_a = P
///
/// The increments of the members are y_a = q. With e, one at the n members and zero elsewhere, d_a
/// the diagonal of K and the columns and rows that the members take out of it
///
///   [ K_ff   0  ]     [ K_ff e ]             [ 0 ]
///   [  0   d_a  ]  +  [ −d_a   ] (e/n)ᵀ  +   [ e/n ] rᵀ,       F_a = 1/n (Σ R_a − P),
///
///   r  K_fᵀ e on free unknowns, eᵀ K e/n on members, summed over all such motions
///
/// is Newton's equation for all of them: the first product moves the others along, and the rows of
/// the members differ by d_a (y_a − q) only, which is zero. Where q is given r = k e/n and F_a =
/// k/n (q − ū), k = 1 mN/mm.
class CommonMotions {
public:
  /// split: carries the scalars where it is not null. The meshes must outlive the object.
  explicit CommonMotions(const fields::FieldMesh& mesh, const fields::SplitMesh* split = nullptr);

  /// members: nodes, owned and ghosts. Those whose component is fixed already are left out, the
  /// others are fixed from now on; an Error where one belongs to another motion along the
  /// component. Returns the number of members on all ranks. Collective.
  int add(int component, bool has_force, const std::vector<char>& members, Constraints& fixed);

  bool is_empty() const { return motions_.empty(); }
  /// Products that they add to K.
  int rank() const { return 2 * static_cast<int>(motions_.size()); }

  /// The rows of the members in F. u: on owned nodes at least; values: ū [mm] or P [mN].
  /// Collective.
  void store(const NodalResidual& R, const std::vector<Vec3>& u, const std::vector<double>& values,
             algebra::BlockVector& F) const;

  /// The mean of each motion's members, of values at owned nodes. Collective.
  std::vector<double> means(const Vector& u) const;
  /// Gives each motion's members one value.
  void insert(const std::vector<double>& values, Vector& u) const;

  /// A Jacobian begins; what its elements and faces hold of members, before it is dropped; and,
  /// where all are in, the last rank() of the field's products. diagonal: of K, in the field's
  /// units. Collective.
  void begin();
  void collect(std::size_t e, const kernels::MixedJacobian& K);
  void collect(const fields::Face& face, const kernels::SurfaceJacobian& K);
  void store(const Constraints& fixed, const Vector& diagonal, algebra::LowRank& products) const;

private:
  /// On owned nodes.
  struct Values {
    std::vector<Vec3> u;
    std::vector<double> p;
  };
  struct Motion {
    int component;
    bool has_force;
    double count;        ///< n
    Values column, row;  ///< K e and Kᵀ e
  };
  bool is_fixed_scalar(int node, const Constraints& fixed) const {
    return fixed.is_scalar_fixed(fields::host_of(node, split_));
  }
  int motion_of(int node, int component) const { return motion_of_[3 * node + component]; }
  template <class Jacobian, class Nodes>
  void collect_vectors(const Nodes& nodes, const Jacobian& K);
  /// eᵀ K e of each pair, row by row. Collective.
  std::vector<double> pair_sums() const;
  void store_first(int m, const Constraints& fixed, const Vector& diagonal,
                   algebra::RankOne& product) const;
  void store_second(int m, const Constraints& fixed, const std::vector<double>& products,
                    algebra::RankOne& product) const;

  const fields::FieldMesh *mesh_, *scalar_mesh_;
  const fields::SplitMesh* split_;
  std::vector<Motion> motions_;
  std::vector<int> motion_of_;    ///< per local node and component; -1: none
  std::vector<char> is_touched_;  ///< per local node: it has a member
};

}  // namespace tunica::assembly
