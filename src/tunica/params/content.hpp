#pragma once
#include <Teuchos_ParameterEntry.hpp>
#include <string>
#include <vector>

#include "tunica/params/table.hpp"

namespace tunica::params {

enum class Kind {
  number,
  integer,
  flag,
  text,
  choice,
  file,
  numbers,
  names,  // one value each
  sublist,
  entries,
  variant,
  foreign,
  removed
};

/// One declared key. Members that a kind does not need stay empty.
struct Key {
  Kind kind;
  std::string name;
  std::string sentence;
  bool is_required = false;
  Teuchos::ParameterEntry fallback{};
  Range range{};
  std::string unit{};
  std::size_t size = 0;                ///< of an array; 0 permits any
  std::vector<std::string> options{};  ///< of a choice or variant
  std::vector<Table> tables{};         ///< sublist and entries: one; variant: one per option
  Teuchos::ParameterList foreign{};    ///< fallback of a foreign list
  Teuchos::ParameterList valid{};      ///< its keys, if the package tells
  std::string successor{};             ///< of a removed key
};

struct Table::Content {
  std::string sentence;
  std::vector<Key> keys;
  std::vector<Check> checks;
};

/// A key and the choices that bring it in, outermost first.
struct Owned {
  const Key* key;
  struct Condition {
    const Key* variant;
    std::string value;
  };
  std::vector<Condition> conditions;
};

/// Keys that are valid for one list: the table's own and those of the chosen cases.
struct Active {
  std::vector<const Key*> keys;
  std::vector<const Table::Check*> checks;
  bool is_certain = true;  ///< every variant has a valid value
};
Active active(const Table& table, const Teuchos::ParameterList& list);

/// The table's own keys and those of all cases.
std::vector<Owned> all_keys(const Table& table);

/// The text value of a choice: from the list, otherwise the default; "" if there is neither.
std::string chosen(const Key& key, const Teuchos::ParameterList& list);

std::string xml_type(Kind kind);             ///< "double"; "" for lists
std::string expected(const Key& key);        ///< "a number (double)"
std::string range_text(const Range& range);  ///< "> 0", "0..90", "" if anything is permitted

std::string joined(const std::string& path, const std::string& name);  ///< "Wall / Layers"
std::string prefix(const std::string& path);                           ///< "Wall / Layers: "

}  // namespace tunica::params
