#include "tunica/run/restart_changes.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/hash.hpp"
#include "tunica/io/messages.hpp"
#include "tunica/params/read_xml.hpp"

namespace tunica::run {

namespace {

/// A list with all that is in it, or a key.
bool is_in(const std::string& path, const std::vector<std::string>& places) {
  return std::any_of(places.begin(), places.end(), [&](const std::string& place) {
    return path == place || path.compare(0, place.size() + 3, place + " / ") == 0;
  });
}

/// The same mesh may lie elsewhere: without it the older case would not even be complete.
void move_mesh(Teuchos::ParameterList& was, const Teuchos::ParameterList& list) {
  if (was.isSublist("Mesh"))
    was.sublist("Mesh").set("file", list.sublist("Mesh").get<std::string>("file"));
}

bool is_file(const std::string& path) {
  const std::string key = " / file";
  return path.size() > key.size() && path.compare(path.size() - key.size(), key.size(), key) == 0;
}

/// A file of the same name, elsewhere.
bool is_moved_file(const params::Difference& change) {
  return is_file(change.path) && std::filesystem::path(change.before).filename() ==
                                     std::filesystem::path(change.after).filename();
}

std::string hash_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::uint64_t hash = hash_start;
  std::vector<char> part(1 << 20);
  while (file.read(part.data(), static_cast<std::streamsize>(part.size())), file.gcount() > 0)
    hash = hash_bytes(part.data(), static_cast<std::size_t>(file.gcount()), hash);
  TUNICA_CHECK(file.eof(), path + ": cannot be read");
  return hash_digits(hash);
}

void add_hashes(const Teuchos::ParameterList& list, const std::string& path,
                std::map<std::string, std::string>& hashes) {
  for (auto it = list.begin(); it != list.end(); ++it) {
    const std::string& name = list.name(it);
    const std::string here = path.empty() ? name : path + " / " + name;
    if (list.isSublist(name))
      add_hashes(list.sublist(name), here, hashes);
    else if (is_file(here) && here != "Mesh / file")
      hashes[here] = hash_of(list.get<std::string>(name));
  }
}

/// Files of the same name that hold something else.
void add_edited_files(const output::CheckpointHead& head, const Teuchos::ParameterList& list,
                      Changes& changes) {
  for (const auto& [path, hash] : hashes_of_files(list)) {
    const auto before = head.files.find(path);
    const bool is_told = std::any_of(changes.begin(), changes.end(),
                                     [&, &key = path](const auto& c) { return c.path == key; });
    if (!is_told && before != head.files.end() && before->second != hash)
      changes.push_back({path, "contents " + before->second, "contents " + hash});
  }
}

std::string lines_of(const Changes& changes) {
  constexpr std::size_t shown = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, changes.size()); ++i)
    text += "\n  " + params::text_of(changes[i]);
  if (changes.size() > shown)
    text += "\n  ... and " + std::to_string(changes.size() - shown) + " more";
  return text;
}

/// Ways to the same solution; the extrapolated domain has another one.
bool is_of_jacobians(const params::Difference& change) {
  const auto is_exact = [](const std::string& value) {
    return value.find("extrapolated") == std::string::npos;
  };
  return change.path == "Coupling / geometry" && is_exact(change.before) && is_exact(change.after);
}

Changes tell_changes(const output::CheckpointHead& head, const std::string& file,
                     const Teuchos::ParameterList& list, const params::Table& table, bool allowed) {
  const std::string advice =
      "Use the case of the previous steps, or accept the changes with --allow-changes.";
  TUNICA_CHECK(allowed || !head.parameters.empty(),
               "--restart: " + file +
                   " does not contain the case it was made with, so that changes cannot be "
                   "detected. Continue all the same with --allow-changes.");
  if (head.parameters.empty()) return {{"case", "unknown", "as in this file"}};
  const Changes changes = changes_since(head, list, table);
  Changes bound;
  for (const params::Difference& change : changes)
    if (!may_change_freely(change.path) && !is_of_jacobians(change)) bound.push_back(change);
  TUNICA_CHECK(allowed || bound.empty(), "--restart: " + file + " was made with a different case:" +
                                             lines_of(bound) + "\n" + advice);
  if (!changes.empty())
    io::print_line("changed after step " + std::to_string(head.step) + ":" + lines_of(changes));
  return changes;
}

}  // namespace

bool may_change_freely(const std::string& path) {
  static const std::vector<std::string> free{"Coupling",
                                             "Fluid / Linear Solver",
                                             "Fluid / Newton",
                                             "Mesh / file",
                                             "Mesh / partitioner",
                                             "Mesh Motion / Linear Solver",
                                             "Output",
                                             "Probes",
                                             "Time / cuts",
                                             "Time / end time",
                                             "Time / newton increment",
                                             "Time / steps",
                                             "Time / wall limit",
                                             "Wall / Linear Solver",
                                             "Wall / Newton"};
  static const std::vector<std::string> bound{"Coupling / geometry", "Coupling / scheme"};
  return is_in(path, free) && !is_in(path, bound);
}

std::map<std::string, std::string> hashes_of_files(const Teuchos::ParameterList& list) {
  std::map<std::string, std::string> hashes;
  add_hashes(list, "", hashes);
  return hashes;
}

Changes changes_since(const output::CheckpointHead& head, const Teuchos::ParameterList& list,
                      const params::Table& table) {
  Teuchos::ParameterList was;
  try {
    was = params::from_xml(head.parameters, "the case in the checkpoint");
    move_mesh(was, list);
    table.resolve(was, "", "");
  } catch (const Error&) {  // of another version of this program: compared as it is
  }
  Changes changes = params::differences(was, list);
  const auto is_place = [](const params::Difference& change) {
    return change.path == "Output / folder" || is_moved_file(change);
  };
  changes.erase(std::remove_if(changes.begin(), changes.end(), is_place), changes.end());
  add_edited_files(head, list, changes);
  return changes;
}

Changes accepted_changes(const output::CheckpointHead& head, const std::string& file,
                         const Teuchos::ParameterList& list, const params::Table& table,
                         const setup::CommandLine& command, const Comm& comm) {
  Changes changes;
  on_root(comm, [&] { changes = tell_changes(head, file, list, table, command.allow_changes); });
  return changes;
}

}  // namespace tunica::run
