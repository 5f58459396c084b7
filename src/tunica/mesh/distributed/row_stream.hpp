#pragma once
#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tunica/base/types.hpp"
#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// Content of a text file for a tetrahedron, a triangle, a vector on a tetrahedron. Tag 0: none in
/// the file.
struct TetRow {
  std::array<int, 4> corners;  ///< places of vertices
  int tag;
  long long number;  ///< in the file, for messages
};
struct TriangleRow {
  std::array<int, 3> corners;
  int tag;
};
struct VectorRow {
  long long tet;  ///< place
  int set;        ///< place among the names
  Vec3 value;
};

/// Rows of one kind on their way from rank 0 to all: pieces of equally many go to one rank after
/// the other, and none is kept but those of the own rank.
template <class Row>
class RowChannel {
public:
  /// piece: rows that are sent at once. tag: of the messages, one for each channel.
  RowChannel(const CommPtr& comm, int piece, int tag);

  /// On rank 0.
  void put(const Row& row);
  void flush();
  /// On others: the bytes of a message.
  void take(const std::vector<char>& message, int bytes);

  /// On rank 0: rows that were put.
  long long count() const { return count_; }
  /// All of them in equal portions, in the order in which they were put. Collective.
  std::vector<Row> take_portions();

private:
  CommPtr comm_;
  int piece_, tag_;
  long long count_ = 0;
  std::vector<Row> filling_, mine_;
};

/// Sink for a reader of a text format on rank 0. No rank ever holds more than its portion and a
/// piece.
class RowStream {
public:
  static constexpr int piece = 1 << 15;
  explicit RowStream(const CommPtr& comm, int rows_at_once = piece);

  RowChannel<Vec3> vertices;
  RowChannel<TetRow> tets;
  RowChannel<TriangleRow> triangles;
  RowChannel<VectorRow> vectors;

  /// On rank 0: names by tags, and those of sets of vectors.
  std::map<int, std::string> region_names, surface_names;
  std::vector<std::string> vector_names;

  /// Lets rank 0 read, and all take their rows. Throws on all ranks what it throws. Collective.
  void run(const std::function<void(RowStream&)>& reader);

private:
  void flush();
  void send_end() const;
  void receive_all(std::vector<char>& message);
  void take(int tag, const std::vector<char>& message, int bytes);

  CommPtr comm_;
  int piece_;
};

}  // namespace tunica::mesh
