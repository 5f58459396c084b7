#include "tunica/systems/node_map_file.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <fstream>
#include <sstream>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/rows.hpp"
#include "tunica/params/plain_text.hpp"

namespace tunica::systems {

namespace {

class MapFile {
public:
  MapFile(const std::string& path, long long n_vector)
      : path_(path), file_(path), n_vector_(n_vector) {
    params::begin_text(file_, path);
  }

  /// Those of the next lines; none behind the last.
  std::vector<Unknown> next(std::size_t count) {
    std::vector<Unknown> unknowns;
    for (std::string line; unknowns.size() < count && std::getline(file_, line);) {
      ++line_;
      if (line.empty() || line[0] == '%' || line[0] == '#') continue;
      unknowns.push_back(parsed(line));
    }
    return unknowns;
  }

private:
  Unknown parsed(const std::string& line) {
    std::istringstream words(line);
    Unknown unknown{-1, 0, line_};
    const bool is_number = static_cast<bool>(words >> unknown.node);
    constexpr long long most = 1LL << 62;
    check(is_number && unknown.node >= 0 && unknown.node < most,
          "expected the number of a node, from 0 on, found \"" + line + "\"");
    const bool is_vector = n_read_++ < n_vector_;
    if (is_vector && !(words >> unknown.component)) unknown.component = next_component;
    words.clear();
    std::string rest;
    const bool is_over = !(words >> rest);
    check(is_over, "found \"" + rest + "\" after the numbers");
    return unknown;
  }
  void check(bool is_good, const std::string& problem) const {
    TUNICA_CHECK(is_good, complaint(path_, line_, problem));
  }

  std::string path_;
  std::ifstream file_;
  long long n_vector_, n_read_ = 0;
  long long line_ = 0;
};

void append(std::vector<Unknown>& all, const std::vector<Unknown>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

Unknowns read_node_map(const std::string& path, long long n_vector, long long n_scalar,
                       const CommPtr& comm, std::size_t lines_at_once) {
  MapFile file(comm->getRank() == 0 ? path : "", n_vector);
  Unknowns mine;
  for (long long count = -1; count != 0; mine.total += count) {
    const long long first = mine.total;
    std::vector<Unknown> vectors, scalars;
    on_root(*comm, [&] {
      vectors = file.next(lines_at_once);
      count = static_cast<long long>(vectors.size());
      const auto end = vectors.begin() + std::clamp(n_vector - first, 0LL, count);
      scalars.assign(end, vectors.end());
      vectors.erase(end, vectors.end());
    });
    Teuchos::broadcast(*comm, 0, 1, &count);
    append(mine.vectors, spread(*comm, vectors, first, n_vector));
    append(mine.scalars, spread(*comm, scalars, std::max(first - n_vector, 0LL), n_scalar));
  }
  return mine;
}

std::string complaint(const std::string& path, long long line, const std::string& problem) {
  return path + ", line " + std::to_string(line) + ": " + problem + ".";
}

}  // namespace tunica::systems
