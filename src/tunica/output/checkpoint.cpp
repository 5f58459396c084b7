#include "tunica/output/checkpoint.hpp"

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/io/hdf5_arrays.hpp"
#include "tunica/output/checkpoint_sum.hpp"

namespace tunica::output {

namespace {

bool is_of(const std::string& part, const std::string& name) {
  return name.compare(0, part.size() + 1, part + "/") == 0;
}

std::string part_of(const std::string& name) { return name.substr(0, name.find('/')); }

fields::State::Array read_rows(const io::Hdf5Reader& in, const std::string& name, int columns) {
  if (columns == 0) return {};
  return {columns, in.reals(name, columns)};
}

/// Row of the file for each of the vertices.
std::vector<std::size_t> places(const std::vector<int>& in_file, const std::vector<int>& vertices,
                                const std::string& where) {
  const int largest = in_file.empty() ? -1 : *std::max_element(in_file.begin(), in_file.end());
  std::vector<long long> row_of(largest + 1, -1);
  for (std::size_t r = 0; r < in_file.size(); ++r) row_of[in_file[r]] = static_cast<long long>(r);
  std::vector<std::size_t> found;
  for (const int vertex : vertices) {
    TUNICA_CHECK(vertex <= largest && row_of[vertex] >= 0,
                 where + ": has no values at vertex " + std::to_string(vertex + 1));
    found.push_back(row_of[vertex]);
  }
  return found;
}

}  // namespace

CheckpointFile::CheckpointFile(const std::string& path) : path_(path) {
  const io::Hdf5Reader in(path);
  const std::string format = in.attribute("format");
  TUNICA_CHECK(format == "tunica-checkpoint 1", path + ": attribute \"format\" is \"" + format +
                                                    "\", expected \"tunica-checkpoint 1\"");
  const auto text_names = in.strings("text_names"), texts = in.strings("texts");
  const auto number_names = in.strings("number_names"), array_names = in.strings("array_names");
  const auto sums = in.strings("array_checksums");
  const auto counts = in.integers("number_counts"), columns = in.integers("array_columns");
  const auto numbers = in.reals("numbers", 1);
  const auto parameters =
      in.has("parameters") ? in.strings("parameters") : std::vector<std::string>();
  TUNICA_CHECK(text_names.size() == texts.size() && number_names.size() == counts.size() &&
                   array_names.size() == columns.size() && array_names.size() == sums.size(),
               path + ": names and values are not of the same number");
  const auto promised = in.strings("head_checksum");
  TUNICA_CHECK(
      promised.size() == 1 && promised.front() == head_checksum({&text_names, &texts, &number_names,
                                                                 &array_names, &sums, &parameters},
                                                                {&counts, &columns}, numbers),
      path + ": its head is damaged: the checksum does not fit");
  for (std::size_t i = 0; i < texts.size(); ++i) texts_[text_names[i]] = texts[i];
  for (std::size_t i = 0, first = 0; i < counts.size(); first += counts[i++]) {
    TUNICA_CHECK(first + counts[i] <= numbers.size(), path + ": numbers are missing");
    const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(first);
    numbers_[number_names[i]] = {begin, begin + counts[i]};
  }
  for (std::size_t i = 0; i < sums.size(); ++i) arrays_[array_names[i]] = {columns[i], sums[i]};
  head_ = {text("run/mesh"), static_cast<int>(number("run/step")), number("run/time"),
           number("run/step size"), number("run/seconds")};
  for (const std::string& piece : parameters) head_.parameters += piece;
  const std::string control = "run/" + std::string(control_prefix);
  for (const auto& [name, values] : numbers_)
    if (name.compare(0, control.size(), control) == 0)
      head_.control[name.substr(control.size())] = values;
}

const std::string& CheckpointFile::text(const std::string& name) const {
  const auto found = texts_.find(name);
  TUNICA_CHECK(found != texts_.end(), path_ + ": lacks \"" + name + "\"");
  return found->second;
}

double CheckpointFile::number(const std::string& name) const {
  const auto found = numbers_.find(name);
  TUNICA_CHECK(found != numbers_.end() && found->second.size() == 1,
               path_ + ": lacks \"" + name + "\"");
  return found->second.front();
}

bool CheckpointFile::has(const std::string& part) const {
  return std::any_of(arrays_.begin(), arrays_.end(),
                     [&](const auto& entry) { return is_of(part, entry.first); });
}

void CheckpointFile::verify() const {
  const io::Hdf5Reader in(path_);
  for (const auto& [name, entry] : arrays_) {
    const std::vector<int> vertices = in.integers(part_of(name) + "/vertices");
    const fields::State::Array rows = read_rows(in, name, entry.columns);
    TUNICA_CHECK(rows.values.size() == vertices.size() * entry.columns &&
                     hash_digits(checksum(vertices, rows)) == entry.checksum,
                 path_ + ": dataset /" + name + " is damaged: its checksum does not fit");
  }
}

fields::State CheckpointFile::read(const std::string& part,
                                   const std::vector<int>& vertices) const {
  const io::Hdf5Reader in(path_);
  fields::State state;
  state.vertices = vertices;
  const std::size_t prefix = part.size() + 1;
  for (const auto& [name, value] : texts_)
    if (is_of(part, name)) state.texts[name.substr(prefix)] = value;
  for (const auto& [name, values] : numbers_)
    if (is_of(part, name)) state.numbers[name.substr(prefix)] = values;

  // As with the mesh, every rank holds an array whole while it takes its share.
  const auto from = places(in.integers(part + "/vertices"), vertices, path_ + ": /" + part);
  for (const auto& [name, entry] : arrays_) {
    if (!is_of(part, name)) continue;
    const fields::State::Array whole = read_rows(in, name, entry.columns);
    fields::State::Array& mine = state.arrays[name.substr(prefix)];
    mine.columns = entry.columns;
    for (const std::size_t row : from) {
      const auto begin = whole.values.begin() + static_cast<std::ptrdiff_t>(row * entry.columns);
      mine.values.insert(mine.values.end(), begin, begin + entry.columns);
    }
  }
  return state;
}

}  // namespace tunica::output
