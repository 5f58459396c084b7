#include "tunica/discretisation/prestretch.hpp"

#include <algorithm>

namespace tunica::discretisation {

namespace {

constexpr const char* name = "gradient";
constexpr int width = 9;  // row by row

}  // namespace

// Before it is found it is the identity, so that states have their array at all times.

fields::State Prestretch::save() const {
  std::vector<double> rows;
  rows.reserve(width * places_.count());
  for (int e = 0; e < places_.count(); ++e)
    for (const Vec3& row : values_.empty() ? identity() : values_[e])
      rows.insert(rows.end(), row.begin(), row.end());
  fields::State state = places_.state();
  state.arrays[name] = places_.owned_rows(rows, width);
  return state;
}

std::string Prestretch::restore(const fields::State& state) {
  const std::vector<double> rows = places_.local_rows(state, name, width);
  values_.resize(places_.count());
  auto next = rows.begin();
  for (Mat3& G : values_)
    for (Vec3& row : G) {
      std::copy_n(next, 3, row.begin());
      next += 3;
    }
  followed_();
  return "";
}

}  // namespace tunica::discretisation
