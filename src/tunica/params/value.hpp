#pragma once
#include <Teuchos_ParameterEntry.hpp>
#include <optional>
#include <string>
#include <vector>

namespace tunica::params {

/// The value of an XML type (int, long long, double, bool, string, Array(int), Array(double),
/// Array(string)) that the text spells; nothing if the text is not wholly such a value.
/// Arrays are written `{1, 2}` or `1, 2`.
std::optional<Teuchos::ParameterEntry> parse_value(const std::string& type,
                                                   const std::string& text);
/// The types parse_value knows.
const std::vector<std::string>& known_types();

/// XML type of the entry; "" if parse_value does not know it.
std::string type_name(const Teuchos::ParameterEntry& entry);
/// The text that parse_value turns into the same entry, to the last bit.
std::string value_text(const Teuchos::ParameterEntry& entry);
/// For messages: `the text "heavy"`, `the integer 3`, `a parameter list`.
std::string describe(const Teuchos::ParameterEntry& entry);

/// Shortest text that reads back as the same number.
std::string number_text(double value);
std::string trimmed(const std::string& text);

}  // namespace tunica::params
