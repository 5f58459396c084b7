#pragma once
#include <Teuchos_ParameterList.hpp>
#include <functional>
#include <iosfwd>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tunica::params {

/// Interval of permitted numbers.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;
};
Range any();
Range positive();                        ///< (0, ∞)
Range non_negative();                    ///< [0, ∞)
Range between(double low, double high);  ///< [low, high]

/// The declaration of one parameter list: its keys with type, default, range, unit and a
/// sentence each. Classes declare a Table next to their options; setup/ assembles the whole.
///
/// A key without a default (std::nullopt) is required.
class Table {
public:
  using Check = std::function<void(const Teuchos::ParameterList&, const std::string& path)>;

  explicit Table(std::string sentence = "");
  Table(const Table&);
  Table& operator=(const Table&);
  ~Table();

  Table& number(const std::string& name, std::optional<double> fallback, const Range& range,
                const std::string& unit, const std::string& sentence);
  Table& integer(const std::string& name, std::optional<int> fallback, const Range& range,
                 const std::string& sentence);
  Table& flag(const std::string& name, std::optional<bool> fallback, const std::string& sentence);
  Table& text(const std::string& name, std::optional<std::string> fallback,
              const std::string& sentence);
  Table& choice(const std::string& name, std::optional<std::string> fallback,
                const std::vector<std::string>& options, const std::string& sentence);
  /// Path of a readable file, relative to the XML file; "" as fallback means none.
  Table& file(const std::string& name, std::optional<std::string> fallback,
              const std::string& sentence);
  /// Array(double); size 0 permits any length.
  Table& numbers(const std::string& name, std::optional<std::vector<double>> fallback,
                 const Range& range, std::size_t size, const std::string& unit,
                 const std::string& sentence);
  /// Array(string).
  Table& names(const std::string& name, std::optional<std::vector<std::string>> fallback,
               const std::string& sentence);

  /// A sublist that is always there after resolve(), with its own keys.
  Table& sublist(const std::string& name, const Table& table);
  /// A sublist whose entries are sublists with free names (regions, surfaces), each of which
  /// follows the table.
  Table& entries(const std::string& name, const Table& each, const std::string& sentence);
  /// A choice whose value adds the keys of the chosen table to this list.
  struct Case;
  Table& variant(const std::string& name, std::optional<std::string> fallback,
                 const std::vector<Case>& cases, const std::string& sentence);
  /// A sublist of another package, kept verbatim. If valid is not empty, its keys and types
  /// are checked against it (at all depths).
  Table& foreign(const std::string& name, const Teuchos::ParameterList& fallback,
                 const Teuchos::ParameterList& valid, const std::string& sentence);
  /// A key that is no more; its use is an error that names the successor.
  Table& removed(const std::string& name, const std::string& successor);
  /// A condition between keys; throws tunica::Error. Called on the resolved list.
  Table& check(Check condition);

  /// Validates the list at all depths and fills in the defaults. Throws tunica::Error that
  /// names the list ("Wall / Layers / media"), the key, what was found and what was expected;
  /// an unknown key names the nearest valid one (distance up to 2) or lists all.
  /// directory: base of relative file names; they become absolute.
  void resolve(Teuchos::ParameterList& list, const std::string& path,
               const std::string& directory) const;

  /// A complete, commented XML list with every default.
  void print_xml(std::ostream& out, const std::string& name) const;
  /// One Markdown section per list.
  void print_markdown(std::ostream& out, const std::string& name) const;

  /// The declared keys; defined in content.hpp, for the sources of this folder.
  struct Content;
  const Content& content() const { return *content_; }

private:
  std::unique_ptr<Content> content_;
};

/// The sections of several tables. A section that occurs at several places is printed once;
/// elsewhere there is a reference to it, with the defaults that differ there.
void print_reference(std::ostream& out,
                     const std::vector<std::pair<std::string, const Table*>>& tables);

struct Table::Case {
  std::string value;
  Table table;
};

}  // namespace tunica::params
