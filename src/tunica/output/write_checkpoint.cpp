#include <fcntl.h>
#include <unistd.h>

#include <Teuchos_CommHelpers.hpp>
#include <cerrno>
#include <cstdio>
#include <filesystem>

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
  return run;
}

/// Everything but the values of the arrays.
struct Contents {
  std::vector<std::string> text_names, texts, number_names, array_names, array_checksums;
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
    return head_checksum({&text_names, &texts, &number_names, &array_names, &array_checksums},
                         {&number_counts, &array_columns}, numbers);
  }
  /// Composed on one rank.
  void save(const std::string& path) const {
    io::Hdf5Writer out(path);
    out.attribute("format", "tunica-checkpoint 1");
    out.strings("text_names", text_names);
    out.strings("texts", texts);
    out.strings("number_names", number_names);
    out.integers("number_counts", number_counts.data(), number_counts.size());
    out.reals("numbers", numbers.data(), numbers.size(), 1);
    out.strings("array_names", array_names);
    out.integers("array_columns", array_columns.data(), array_columns.size());
    out.strings("array_checksums", array_checksums);
    out.strings("head_checksum", {checksum()});
    out.save();
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

Outcome synced(const std::string& path, int flags) {
  errno = 0;
  const int file = ::open(path.c_str(), flags);
  const bool is_synced = file >= 0 && ::fsync(file) == 0;
  const std::string reason = io::system_reason();
  if (file >= 0) ::close(file);
  return is_synced ? Outcome::success() : Outcome::failure("cannot flush " + path + reason);
}

/// Gives the draft its name when it is on the disk; the folder follows, or a failing power could
/// take the name back.
Outcome publish(const std::string& draft, const std::string& path) {
  if (const Outcome flushed = synced(draft, O_WRONLY); flushed.is_failure()) return flushed;
  if (std::rename(draft.c_str(), path.c_str()) != 0)
    return Outcome::failure("cannot rename " + draft + " to " + path + io::system_reason());
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const Outcome flushed = synced(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
  // Some network file systems cannot flush folders; the file has its name all the same.
  return errno == EINVAL || errno == ENOTSUP ? Outcome::success() : flushed;
}

}  // namespace

void write_checkpoint(const std::string& path, const CheckpointHead& head, const States& states,
                      const CommPtr& comm) {
  const std::string draft = path + ".tmp";
  const Sums sums = checksums(states, *comm);
  try {
    on_root_or_fault(*comm, [&] {
      Contents contents;
      for (const auto& [part, state] : states) contents.add(part, state, sums);
      contents.add("run", state_of(head), {});
      contents.save(draft);
      return Outcome::success();
    });
    write_arrays(draft, states, comm);
    on_root_or_fault(*comm, [&] { return publish(draft, path); });
  } catch (const MachineFault& failure) {
    if (comm->getRank() == 0) std::remove(draft.c_str());
    throw MachineFault(std::string("no checkpoint could be written: ") + failure.what());
  }
}

}  // namespace tunica::output
