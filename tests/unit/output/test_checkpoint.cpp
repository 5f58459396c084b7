#include <Teuchos_DefaultSerialComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/output/checkpoint.hpp"
#include "tunica/output/checkpoint_series.hpp"
#include "tunica/output/run_folder.hpp"
#include "unit/io/full_disk.hpp"
#include "unit/io/scratch.hpp"

namespace tunica::output::test {

namespace {

double value(GlobalOrdinal vertex, int column) {
  return static_cast<double>(vertex) + 1.0 / (column + 3.0);
}

/// Vertices 0, 3, 6, … of some twenty, dealt out in turn, with arrays of one and of five columns.
fields::State some_state(int count = 20) {
  fields::State state;
  for (int k = world()->getRank(); k < count; k += world()->getSize())
    state.places.push_back(3 * k);
  for (const auto& [name, columns] : {std::pair("one", 1), std::pair("five", 5)}) {
    fields::State::Array& rows = state.arrays[name];
    rows.columns = columns;
    for (const GlobalOrdinal vertex : state.places)
      for (int c = 0; c < columns; ++c) rows.values.push_back(value(vertex, c));
  }
  state.arrays["none"];
  state.texts["kind"] = "a word";
  state.numbers["counts"] = {3.0, 1.0 / 3.0};
  state.numbers["nothing"] = {};
  return state;
}

const CheckpointHead head{
    "0123456789abcdef", 16, 2.0, 0.125, 7.5, {}, std::string(4500, '<') + "case/>\n"};

std::string written(const std::string& folder) {
  const std::string path = checkpoint_path(RunFolder(scratch(folder), world()).path(), 16);
  write_checkpoint(
      path, head,
      {{"part", [] { return some_state(); }}, {"part two", [] { return some_state(1); }}}, world());
  return path;
}

std::string complaint(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// The file with one byte changed, counted from the end of the first place where `number` stands.
void damage(const std::string& path, double number) {
  std::string bytes = content(path);
  const std::string image(reinterpret_cast<const char*>(&number), sizeof number);
  const std::size_t place = bytes.find(image);
  bytes.at(place) = static_cast<char>(bytes.at(place) ^ 1);
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

TEUCHOS_UNIT_TEST(checkpoint, comes_back_on_other_ranks_in_another_order) {
  const std::string path = written("checkpoint");
  const CheckpointFile file(path);
  file.verify();
  TEST_EQUALITY(file.head().mesh, head.mesh);
  TEST_EQUALITY(file.head().step, 16);
  TEST_EQUALITY(file.head().time, 2.0);
  TEST_EQUALITY(file.head().step_size, 0.125);
  TEST_EQUALITY(file.head().seconds, 7.5);
  TEST_EQUALITY(file.head().parameters, head.parameters);
  TEST_ASSERT(file.has("part") && file.has("part two") && !file.has("par"));

  const std::vector<GlobalOrdinal> wanted{57, 0, 30};
  const fields::State state = file.read("part", wanted, world());
  TEST_EQUALITY(state.text("kind"), "a word");
  TEST_ASSERT(state.number_list("counts") == std::vector<double>({3.0, 1.0 / 3.0}));
  TEST_ASSERT(state.number_list("nothing").empty());
  TEST_ASSERT(state.array("none", 0).values.empty());
  for (const auto& [name, columns] : {std::pair("one", 1), std::pair("five", 5)}) {
    const std::vector<double>& values = state.array(name, columns).values;
    for (std::size_t i = 0; i < values.size(); ++i)
      TEST_EQUALITY(values[i], value(wanted[i / columns], static_cast<int>(i) % columns));
  }
  TEST_ASSERT(!std::filesystem::exists(path + ".tmp"));
}

TEUCHOS_UNIT_TEST(checkpoint, names_what_it_lacks) {
  const CheckpointFile file(written("lacking"));
  TEST_ASSERT(complaint([&] { file.read("part", {1}, world()); }).find("at number 1") !=
              std::string::npos);
  const fields::State state = file.read("part", {0}, world());
  TEST_EQUALITY(complaint([&] { state.array("six", 6); }), "the state lacks \"six\"");
  TEST_EQUALITY(complaint([&] { state.array("five", 6); }),
                "\"five\" of the state has 5 numbers per node, expected 6");
}

TEUCHOS_UNIT_TEST(checkpoint, a_changed_byte_or_a_missing_end_is_noticed) {
  const std::string path = written("damaged");
  if (world()->getRank() != 0) return;
  const std::string bytes = content(path);
  damage(path, value(30, 4));
  TEST_ASSERT(complaint([&] { CheckpointFile(path).verify(); }).find("checksum") !=
              std::string::npos);
  for (const double part : {0.0, 0.1, 0.5, 0.9}) {
    const auto length = static_cast<std::size_t>(part * static_cast<double>(bytes.size()));
    std::ofstream(path, std::ios::binary) << bytes.substr(0, length);
    TEST_ASSERT(complaint([&] { CheckpointFile(path).verify(); }).find(path) == 0);
  }
}

TEUCHOS_UNIT_TEST(checkpoint, a_changed_byte_anywhere_is_an_error_or_does_not_matter) {
  const std::string path = written("flipped");
  if (world()->getRank() != 0) return;
  const std::string bytes = content(path);
  const CommPtr alone = Teuchos::rcp(new Teuchos::SerialComm<int>);
  int errors = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 300) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 4);
    std::ofstream(path, std::ios::binary) << changed;
    try {
      const CheckpointFile file(path);
      file.verify();
      TEST_EQUALITY(file.head().step, head.step);
      TEST_EQUALITY(file.head().seconds, head.seconds);
      TEST_EQUALITY(file.read("part", {30}, alone).array("five", 5).values[4], value(30, 4));
    } catch (const Error&) {
      ++errors;
    }
  }
  TEST_COMPARE(errors, >, 30);
}

TEUCHOS_UNIT_TEST(checkpoint, a_full_disk_leaves_the_one_before) {
  const std::string path = written("full");
  const std::string before = content(path);
  world()->barrier();
  {
    const FullDisk full;
    TEST_THROW(write_checkpoint(path, head, {{"part", [] { return some_state(4000); }}}, world()),
               MachineFault);
  }
  world()->barrier();
  TEST_ASSERT(content(path) == before);
  TEST_ASSERT(!std::filesystem::exists(path + ".tmp"));
}

TEUCHOS_UNIT_TEST(checkpoint_series, lists_the_newest_first_and_keeps_so_many) {
  const std::string folder = RunFolder(scratch("series"), world()).path();
  if (world()->getRank() != 0) return;
  for (const int step : {2, 999999, 1000000, 16, 3})
    std::ofstream(checkpoint_path(folder, step)) << "something";
  for (const char* name : {"checkpoint-000004.h5.tmp", "own.h5"})
    std::ofstream(folder + "/" + name) << "something";
  const auto steps = [&] {
    std::vector<int> found;
    for (const NamedCheckpoint& checkpoint : checkpoints_in(folder))
      found.push_back(checkpoint.step);
    return found;
  };
  TEST_ASSERT(steps() == std::vector<int>({1000000, 999999, 16, 3, 2}));
  prune_checkpoints(folder, 16, 2);
  TEST_ASSERT(steps() == std::vector<int>({16, 3}));
  prune_checkpoints(folder, 0, 0);
  TEST_ASSERT(steps().empty());
  TEST_ASSERT(std::filesystem::exists(folder + "/own.h5"));
  TEST_ASSERT(!std::filesystem::exists(folder + "/checkpoint-000004.h5.tmp"));
}

}  // namespace tunica::output::test
