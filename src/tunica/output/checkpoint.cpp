#include "tunica/output/checkpoint.hpp"

#include <algorithm>
#include <optional>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/portion.hpp"
#include "tunica/io/hdf5_arrays.hpp"
#include "tunica/output/checkpoint_sum.hpp"
#include "tunica/output/row_order.hpp"

namespace tunica::output {

namespace {

bool is_of(const std::string& part, const std::string& name) {
  return name.compare(0, part.size() + 1, part + "/") == 0;
}

std::string part_of(const std::string& name) { return name.substr(0, name.find('/')); }

/// Some rows of an array, whose width the head has.
fields::State::Array read_rows(const io::Hdf5Reader& in, const std::string& name, int columns,
                               const Portion& rows) {
  fields::State::Array array{columns, {}};
  array.values.resize(rows.count * columns);
  if (columns > 0) in.read(name, columns, rows.first, rows.count, array.values.data());
  return array;
}

std::vector<GlobalOrdinal> read_places(const io::Hdf5Reader& in, const std::string& part,
                                       const Portion& rows) {
  std::vector<GlobalOrdinal> places(rows.count);
  in.read(part + "/places", 1, rows.first, rows.count, places.data());
  return places;
}

/// That some rank has a row for each of the places.
void check_presence(const std::vector<GlobalOrdinal>& in_file,
                    const std::vector<GlobalOrdinal>& places, const std::string& where,
                    const CommPtr& comm) {
  const auto there = map_of(in_file, comm);
  std::vector<int> ranks(places.size());
  there->getRemoteIndexList(Teuchos::arrayViewFromVector(places),
                            Teuchos::arrayViewFromVector(ranks));
  on_all(*comm, [&] {
    const auto lost = std::find(ranks.begin(), ranks.end(), -1) - ranks.begin();
    TUNICA_CHECK(lost == static_cast<std::ptrdiff_t>(ranks.size()),
                 where + ": has no values at number " + std::to_string(places[lost]));
  });
}

}  // namespace

CheckpointFile::CheckpointFile(const std::string& path) : path_(path) {
  const io::Hdf5Reader in(path);
  const std::string format = in.attribute("format");
  TUNICA_CHECK(format == checkpoint_format, path + ": attribute \"format\" is \"" + format +
                                                "\", expected \"" + checkpoint_format +
                                                "\": was it made by another version?");
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
  const std::string file = "run/" + std::string(file_prefix);
  for (const auto& [name, hash] : texts_)
    if (name.compare(0, file.size(), file) == 0) head_.files[name.substr(file.size())] = hash;
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
  const auto is_there = [&](const auto& entries) {
    return std::any_of(entries.begin(), entries.end(),
                       [&](const auto& entry) { return is_of(part, entry.first); });
  };
  return is_there(arrays_) || is_there(numbers_) || is_there(texts_);
}

void CheckpointFile::verify() const {
  constexpr long long rows_at_once = 1 << 18;
  const io::Hdf5Reader in(path_);
  for (const auto& [name, entry] : arrays_) {
    const auto total = static_cast<long long>(in.rows(part_of(name) + "/places"));
    TUNICA_CHECK(
        entry.columns == 0 || static_cast<long long>(in.rows(name, entry.columns)) == total,
        path_ + ": dataset /" + name + " is damaged: it has another number of rows");
    std::uint64_t sum = 0;
    for (long long first = 0; first < total; first += rows_at_once) {
      const Portion rows{first, std::min(rows_at_once, total - first)};
      sum +=
          checksum(read_places(in, part_of(name), rows), read_rows(in, name, entry.columns, rows));
    }
    TUNICA_CHECK(hash_digits(sum) == entry.checksum,
                 path_ + ": dataset /" + name + " is damaged: its checksum does not fit");
  }
}

fields::State CheckpointFile::read(const std::string& part,
                                   const std::vector<GlobalOrdinal>& places,
                                   const CommPtr& comm) const {
  fields::State state;
  state.places = places;
  const std::size_t prefix = part.size() + 1;
  for (const auto& [name, value] : texts_)
    if (is_of(part, name)) state.texts[name.substr(prefix)] = value;
  for (const auto& [name, values] : numbers_)
    if (is_of(part, name)) state.numbers[name.substr(prefix)] = values;
  const auto is_mine = [&](const auto& array) { return is_of(part, array.first); };
  if (std::none_of(arrays_.begin(), arrays_.end(), is_mine)) return state;  // nothing has a place

  // Each rank reads its portion, whoever wants the rows.
  std::optional<io::Hdf5Reader> in;
  Portion rows{};
  std::vector<GlobalOrdinal> in_file;
  on_all(*comm, [&] {
    in.emplace(path_);
    rows = portion_of(static_cast<long long>(in->rows(part + "/places")), *comm);
    in_file = read_places(*in, part, rows);
  });
  check_presence(in_file, places, path_ + ": /" + part, comm);
  const RowOrder order(in_file, places, comm);
  for (const auto& [name, entry] : arrays_) {
    if (!is_of(part, name)) continue;
    fields::State::Array mine;
    on_all(*comm, [&, &n = name, &e = entry] { mine = read_rows(*in, n, e.columns, rows); });
    if (mine.columns > 0) mine.values = order(mine.values, mine.columns);
    state.arrays[name.substr(prefix)] = std::move(mine);
  }
  return state;
}

}  // namespace tunica::output
