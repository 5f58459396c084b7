#include <Teuchos_CommHelpers.hpp>
#include <optional>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/io/atomic_file.hpp"
#include "tunica/io/hdf5_arrays.hpp"
#include "tunica/io/parallel_hdf5.hpp"
#include "tunica/output/checkpoint.hpp"
#include "tunica/output/checkpoint_sum.hpp"

namespace tunica::output {

namespace {

using Sums = std::vector<unsigned long long>;

/// Checksums of the arrays over all ranks, in their order.
Sums checksums(const fields::State& state, const Comm& comm) {
  Sums mine;
  for (const auto& [name, rows] : state.arrays) mine.push_back(checksum(state.places, rows));
  Sums total(mine.size());
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(),
                     total.data());
  return total;
}

fields::State state_of(const CheckpointHead& head) {
  fields::State run;
  run.texts["mesh"] = head.mesh;
  for (const auto& [key, hash] : head.files) run.texts[file_prefix + key] = hash;
  run.numbers["step"] = {static_cast<double>(head.step)};
  run.numbers["time"] = {head.time};
  run.numbers["step size"] = {head.step_size};
  run.numbers["seconds"] = {head.seconds};
  for (const auto& [name, values] : head.control) run.numbers[control_prefix + name] = values;
  return run;
}

/// Of a length that HDF5's strings can have.
std::vector<std::string> pieces(const std::string& text) {
  constexpr std::size_t length = 1000;
  std::vector<std::string> all;
  for (std::size_t at = 0; at < text.size(); at += length) all.push_back(text.substr(at, length));
  return all;
}

/// Everything but the values of the arrays.
struct Contents {
  std::vector<std::string> text_names, texts, number_names, array_names, array_checksums,
      parameters;
  std::vector<int> number_counts, array_columns;
  std::vector<double> numbers;

  void add(const std::string& part, const fields::State& state, const Sums& sums) {
    for (const auto& [name, text] : state.texts) {
      text_names.push_back(part + "/" + name);
      texts.push_back(text);
    }
    for (const auto& [name, values] : state.numbers) {
      number_names.push_back(part + "/" + name);
      number_counts.push_back(static_cast<int>(values.size()));
      numbers.insert(numbers.end(), values.begin(), values.end());
    }
    std::size_t k = 0;
    for (const auto& [name, rows] : state.arrays) {
      array_checksums.push_back(hash_digits(sums[k++]));
      array_names.push_back(part + "/" + name);
      array_columns.push_back(rows.columns);
    }
  }
  std::string checksum() const {
    return head_checksum(
        {&text_names, &texts, &number_names, &array_names, &array_checksums, &parameters},
        {&number_counts, &array_columns}, numbers);
  }
  /// Composed on one rank.
  std::string image(const std::string& path) const {
    io::Hdf5Writer out(path);
    out.attribute("format", checkpoint_format);
    out.write("text_names", text_names);
    out.write("texts", texts);
    out.write("number_names", number_names);
    out.write("number_counts", number_counts.data(), number_counts.size());
    out.write("numbers", numbers.data(), numbers.size());
    out.write("array_names", array_names);
    out.write("array_columns", array_columns.data(), array_columns.size());
    out.write("array_checksums", array_checksums);
    if (!parameters.empty()) out.write("parameters", parameters);
    out.write("head_checksum", std::vector<std::string>{checksum()});
    return out.image();
  }
};

io::Hdf5File::Rows rows_of_rank(const fields::State& state, const Comm& comm) {
  const auto mine = static_cast<long long>(state.places.size());
  return {global_sum(comm, mine), sum_before(comm, mine), mine, 1};
}

/// An upper bound of what the arrays of a part take in the file.
long long room_for(const fields::State& state, const io::Hdf5File::Rows& rows) {
  long long bytes = 8 * rows.total + 8192;
  for (const auto& [name, array] : state.arrays) bytes += 8 * rows.total * array.columns + 4096;
  return bytes;
}

/// Adds the arrays, with these rows of each part. Room for them, so many bytes, is taken first, see
/// Hdf5File.
void write_arrays(const std::string& path, long long bytes, const StateSources& parts,
                  const std::vector<io::Hdf5File::Rows>& rows, const CommPtr& comm) {
  io::Hdf5File file(path, io::Hdf5File::Mode::extend, bytes, comm);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto& [part, make] = parts[p];
    const fields::State state = make();
    file.write(part + "/places", rows[p], state.places.data());
    for (const auto& [name, array] : state.arrays) {
      if (array.columns == 0) continue;
      io::Hdf5File::Rows place = rows[p];
      place.columns = array.columns;
      file.write(part + "/" + name, place, array.values.data());
    }
  }
  file.close();
}

}  // namespace

void write_checkpoint(const std::string& path, const CheckpointHead& head,
                      const StateSources& parts, const CommPtr& comm) {
  Contents contents;
  std::vector<io::Hdf5File::Rows> rows;
  long long bytes = 65536;
  for (const auto& [part, make] : parts) {
    const fields::State state = make();
    contents.add(part, state, checksums(state, *comm));
    rows.push_back(rows_of_rank(state, *comm));
    bytes += room_for(state, rows.back());
  }
  contents.add("run", state_of(head), {});
  contents.parameters = pieces(head.parameters);
  try {
    std::optional<io::AtomicFile> file;  // on rank 0
    on_root_or_fault(*comm, [&] {
      file.emplace(path);
      file->add(contents.image(path));
      return file->close();
    });
    write_arrays(io::AtomicFile::draft_of(path), bytes, parts, rows, comm);
    on_root_or_fault(*comm, [&] { return file->commit_to_disk(); });
  } catch (const MachineFault& failure) {
    throw MachineFault(std::string("no checkpoint could be written: ") + failure.what());
  }
}

}  // namespace tunica::output
