#include "tunica/boundary/surface_data.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_LAPACK.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/boundary/held.hpp"
#include "tunica/params/plain_text.hpp"
#include "tunica/stepping/period.hpp"

namespace tunica::boundary {

namespace {

/// What a file says: the same points at each time.
struct PointData {
  std::vector<double> times;  ///< one, of no meaning, where the file has none [ms]
  std::vector<Vec3> points;   ///< [mm]
  std::vector<Vec3> values;   ///< per time and point
};

std::string text_of(const std::string& file, const Comm& comm) {
  std::string text;
  on_root(comm, [&] {
    text = params::read_plain_text(file);
    TUNICA_CHECK(text.size() <= std::numeric_limits<int>::max(),
                 file + ": is larger than 2 GB, more than can be sent to all ranks.");
  });
  broadcast(comm, text);
  return text;
}

/// The numbers of a line; none where it holds something else.
std::vector<double> numbers_of(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream words(line);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    std::size_t used = 0;
    double number = std::nan("");
    try {
      number = std::stod(word, &used);
    } catch (const std::exception&) {
    }
    if (used != word.size() || !std::isfinite(number)) return {};
    numbers.push_back(number);
  }
  return numbers;
}

/// A row is x, y, z and the vector, or a time before them.
class Reader {
public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  PointData read(const std::string& text) {
    std::istringstream in(text);
    bool may_be_heading = true;
    for (std::string line; std::getline(in, line);) {
      ++number_;
      if (line.empty() || line[0] == '#') continue;
      const bool is_heading =
          may_be_heading && std::isalpha(static_cast<unsigned char>(line[0])) != 0;
      may_be_heading = false;
      if (!is_heading) add(numbers_of(line), line);
    }
    expect(!data_.values.empty(), "no point.");
    end_time();
    return data_;
  }

private:
  void expect(bool holds, const std::string& otherwise) const {
    TUNICA_CHECK(holds, file_ + ":" + std::to_string(number_) + ": " + otherwise);
  }

  void add(const std::vector<double>& row, const std::string& line) {
    if (columns_ == 0 && (row.size() == 6 || row.size() == 7)) columns_ = row.size();
    expect(columns_ > 0 && row.size() == columns_,
           "expected " + (columns_ > 0 ? std::to_string(columns_) : "6 or 7") +
               " numbers, a position and a vector" + (columns_ == 6 ? "" : ", a time first") +
               ", found \"" + line + "\".");
    const double* x = row.data() + (columns_ - 6);
    if (data_.times.empty() || (columns_ == 7 && row[0] != data_.times.back())) begin_time(row[0]);
    const Vec3 point{x[0], x[1], x[2]};
    if (data_.times.size() == 1) {
      data_.points.push_back(point);
    } else {
      const std::size_t k = data_.values.size() - (data_.times.size() - 1) * data_.points.size();
      expect(k < data_.points.size() && data_.points[k] == point,
             "each time must have the points of the first one, in its order.");
    }
    data_.values.push_back({x[3], x[4], x[5]});
  }

  void begin_time(double time) {
    if (!data_.times.empty()) {
      end_time();
      expect(time > data_.times.back(), "the times must increase.");
    }
    data_.times.push_back(time);
  }

  void end_time() const {
    expect(data_.values.size() == data_.times.size() * data_.points.size(),
           "a time ends that has fewer points than the first one.");
  }

  std::string file_;
  PointData data_;
  std::size_t columns_ = 0;
  int number_ = 0;
};

/// N_k, one for each time.
std::vector<stepping::TimeFunction> cardinal_splines(std::vector<double> times, double period) {
  std::vector<stepping::TimeFunction> all;
  // A last time that lies a period behind the first one is the first one.
  const bool is_closed = period > 0.0 && stepping::closes_period(period, times);
  for (std::size_t k = 0; k < times.size(); ++k) {
    Teuchos::ParameterList list;
    list.set("kind", "table").set("interpolation", "spline").set("period", period);
    std::vector<double> one(times.size(), 0.0);
    one[k] = 1.0;
    if (is_closed && k == 0) one.back() = 1.0;
    if (is_closed && k + 1 == times.size()) one.assign(times.size(), 0.0);
    list.set("times", Teuchos::Array<double>(times)).set("values", Teuchos::Array<double>(one));
    all.emplace_back(list);
  }
  return all;
}

using Shares = std::vector<std::pair<int, double>>;

/// w_i: what the linear function a + b·(x_i − x) that fits best is at x, where near points count
/// more,
///
///   min Σ_i (a + b·(x_i − x) − v_i)² / |x_i − x|²
///
/// with the smallest b where the points lie in a plane or on a line.
Shares shares_of(const Vec3& x, const std::vector<int>& near, const std::vector<Vec3>& points) {
  const int n = static_cast<int>(near.size());
  const int rows = std::max(n, 4);
  std::vector<double> A(static_cast<std::size_t>(n) * 4), B(static_cast<std::size_t>(rows) * n),
      singular(4), work(static_cast<std::size_t>(64) * rows);
  for (int i = 0; i < n; ++i) {
    const Vec3 way = points[near[i]] - x;
    const double weight = 1.0 / norm(way);
    const double scale = 1.0 / norm(points[near[n - 1]] - x);
    A[i] = weight;
    for (int j = 0; j < 3; ++j) A[(j + 1) * n + i] = weight * scale * way[j];
    B[i * rows + i] = weight;
  }
  int rank = 0, info = 0;
  Teuchos::LAPACK<int, double>().GELSS(n, 4, n, A.data(), n, B.data(), rows, singular.data(), 1e-3,
                                       &rank, work.data(), static_cast<int>(work.size()), nullptr,
                                       &info);
  TUNICA_CHECK(info == 0, "the singular values of the points around a node cannot be found.");
  Shares shares;
  for (int i = 0; i < n; ++i) shares.emplace_back(near[i], B[i * rows]);
  return shares;
}

class Finder {
public:
  Finder(const std::vector<Vec3>& points, double extent) : points_(points), extent_(extent) {}

  /// Shares of the points around x; farthest() is then how far the nearest one was, at most.
  Shares operator()(const Vec3& x) {
    constexpr std::size_t n_near = 10;
    std::vector<int> near(points_.size());
    std::iota(near.begin(), near.end(), 0);
    const std::size_t n = std::min(n_near, near.size());
    std::partial_sort(near.begin(), near.begin() + n, near.end(),
                      [&](int a, int b) { return norm(points_[a] - x) < norm(points_[b] - x); });
    near.resize(n);
    const double distance = norm(points_[near.front()] - x);
    farthest_ = std::max(farthest_, distance);
    if (distance <= 1e-6 * extent_) return {{near.front(), 1.0}};
    return shares_of(x, near, points_);
  }

  double farthest() const { return farthest_; }

private:
  const std::vector<Vec3>& points_;
  double extent_, farthest_ = 0.0;
};

/// Of the box around the surface.
double extent_of(const fields::FieldMesh& mesh, int surface) {
  double squared = 0.0;
  for (int i = 0; i < 3; ++i) {
    double low = 1e300, high = -1e300;
    for (int a = 0; a < mesh.n_owned; ++a)
      if (mesh.is_on(a, surface)) {
        low = std::min(low, mesh.x[a][i]);
        high = std::max(high, mesh.x[a][i]);
      }
    const double length = global_max(*mesh.comm, high) - global_min(*mesh.comm, low);
    squared += length * length;
  }
  return std::sqrt(squared);
}

void add_surface_data_keys(params::Table& table, const std::string& what) {
  table
      .file("file", std::nullopt,
            "rows of position (mm, undeformed) and " + what +
                ", three numbers each, as CSV; or with a time (ms) first, ascending, each with the "
                "same points. In space linear between the points, in time a spline")
      .number("period", 0.0, params::non_negative(), "ms",
              "period with which the times are repeated; 0: the first and last values hold before "
              "and after")
      .sublist("Amplitude", stepping::time_function_table());
}

}  // namespace

SurfaceData::SurfaceData(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh,
                         int surface)
    : amplitude_(list.sublist("Amplitude")), place_(mesh.n_nodes(), -1) {
  const auto& file = list.get<std::string>("file");
  const PointData data = Reader(file).read(text_of(file, *mesh.comm));
  const double period = list.get<double>("period");
  const std::size_t n_times = data.times.size();
  TUNICA_CHECK(period == 0.0 || n_times >= 3, file + ": a period needs three times at least.");
  if (period > 0.0) stepping::check_span(period, data.times, file);
  if (n_times > 1) shares_ = cardinal_splines(data.times, period);
  const double extent = extent_of(mesh, surface);
  Finder find(data.points, extent);
  for (int a = 0; a < mesh.n_nodes(); ++a) {
    if (!mesh.is_on(a, surface)) continue;
    place_[a] = static_cast<int>(values_.size() / n_times);
    const Shares shares = find(mesh.x[a]);
    for (std::size_t k = 0; k < n_times; ++k) {
      Vec3 sum{};
      for (const auto& [i, w] : shares) sum += w * data.values[k * data.points.size() + i];
      values_.push_back(sum);
    }
  }
  const double farthest = global_max(*mesh.comm, find.farthest());
  std::ostringstream message;
  message << file << ": its points lie up to " << farthest << " mm from nodes of the surface \""
          << mesh.surfaces[surface] << "\", which extends over " << extent
          << " mm. Expected positions in mm, as in the mesh.";
  TUNICA_CHECK(farthest <= 0.1 * extent, message.str());
  set_time(0.0);
}

void SurfaceData::set_time(double time) {
  factors_.assign(1, amplitude_(time));
  if (shares_.empty()) return;
  factors_.clear();
  for (const auto& share : shares_) factors_.push_back(amplitude_(time) * share(time));
}

Vec3 SurfaceData::operator()(int node) const {
  Vec3 sum{};
  const std::size_t first = static_cast<std::size_t>(place_[node]) * factors_.size();
  for (std::size_t k = 0; k < factors_.size(); ++k) sum += factors_[k] * values_[first + k];
  return sum;
}

ConditionEntry velocity_from_file() {
  params::Table table("a velocity given at points in a file, such as a measured one");
  add_surface_data_keys(table, "velocity (mm/ms)");
  return {Field::fluid, "velocity from file", table,
          [](const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int surface) {
            return terms(std::make_unique<VelocityData>(SurfaceData(list, mesh, surface)));
          },
          [](const Teuchos::ParameterList&) { return Drive{Drive::Kind::file}; }};
}

ConditionEntry displacement_from_file() {
  params::Table table("a displacement given at points in a file, such as one from images");
  table
      .names("components", std::vector<std::string>{"x", "y", "z"},
             "prescribed components of the displacement, of x, y and z; the others are free")
      .check(check_components);
  add_surface_data_keys(table, "displacement (mm)");
  return {Field::wall, "displacement from file", table,
          [](const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int surface) {
            return terms(std::make_unique<DisplacementData>(SurfaceData(list, mesh, surface),
                                                            components_of(list)));
          },
          [](const Teuchos::ParameterList&) { return Drive{Drive::Kind::file}; }};
}

}  // namespace tunica::boundary
