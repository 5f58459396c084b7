#include <Teuchos_CommHelpers.hpp>
#include <optional>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/io/atomic_file.hpp"
#include "tunica/io/hdf5_arrays.hpp"
#include "tunica/io/parallel_hdf5.hpp"
#include "tunica/output/checkpoint.hpp"
#include "tunica/output/checkpoint_sum.hpp"

namespace tunica::output {

namespace {

using Sums = std::vector<unsigned long long>;

/// Checksums of all arrays over all ranks, in their order.
Sums checksums(const States& states, const Comm& comm) {
  Sums mine;
  for (const auto& [part, state] : states)
    for (const auto& [name, rows] : state.arrays) mine.push_back(checksum(state.vertices, rows));
  Sums total(mine.size());
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(),
                     total.data());
  return total;
}

fields::State state_of(const CheckpointHead& head) {
  fields::State run;
  run.texts["mesh"] = head.mesh;
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
    for (const auto& [name, rows] : state.arrays) {
      array_checksums.push_back(hash_digits(sums[array_names.size()]));
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
  const auto mine = static_cast<long long>(state.vertices.size());
  long long total = 0, up_to_here = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 1, &mine, &total);
  Teuchos::scan(comm, Teuchos::REDUCE_SUM, 1, &mine, &up_to_here);
  return {total, up_to_here - mine, mine, 1};
}

/// Adds the arrays. Room for them is taken first, see Hdf5File.
void write_arrays(const std::string& path, const States& states, const CommPtr& comm) {
  long long bytes = 65536;
  std::vector<io::Hdf5File::Rows> rows;
  for (const auto& [part, state] : states) {
    rows.push_back(rows_of_rank(state, *comm));
    bytes += 4 * rows.back().total + 8192;
    for (const auto& [name, array] : state.arrays)
      bytes += 8 * rows.back().total * array.columns + 4096;
  }
  io::Hdf5File file(path, io::Hdf5File::Mode::extend, bytes, comm);
  for (std::size_t p = 0; p < states.size(); ++p) {
    const auto& [part, state] = states[p];
    file.write(part + "/vertices", rows[p], state.vertices.data());
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

void write_checkpoint(const std::string& path, const CheckpointHead& head, const States& states,
                      const CommPtr& comm) {
  const Sums sums = checksums(states, *comm);
  try {
    std::optional<io::AtomicFile> file;  // on rank 0
    on_root_or_fault(*comm, [&] {
      Contents contents;
      for (const auto& [part, state] : states) contents.add(part, state, sums);
      contents.add("run", state_of(head), {});
      contents.parameters = pieces(head.parameters);
      file.emplace(path);
      file->add(contents.image(path));
      return file->close();
    });
    write_arrays(io::AtomicFile::draft_of(path), states, comm);
    on_root_or_fault(*comm, [&] { return file->commit_to_disk(); });
  } catch (const MachineFault& failure) {
    throw MachineFault(std::string("no checkpoint could be written: ") + failure.what());
  }
}

}  // namespace tunica::output
