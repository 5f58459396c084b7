#include "tunica/params/table.hpp"

#include <Teuchos_Array.hpp>

#include "tunica/base/error.hpp"
#include "tunica/params/content.hpp"

namespace tunica::params {

namespace {

template <class T>
Key value_key(Kind kind, const std::string& name, const std::optional<T>& fallback,
              const std::string& sentence) {
  Key key{kind, name, sentence};
  key.is_required = !fallback.has_value();
  if (fallback) key.fallback = Teuchos::ParameterEntry(*fallback);
  return key;
}

template <class T>
std::optional<Teuchos::Array<T>> array(const std::optional<std::vector<T>>& values) {
  if (!values) return std::nullopt;
  return Teuchos::Array<T>(*values);
}

/// Appends the key; a name may be declared once.
void add(Table::Content& content, Key key) {
  for ([[maybe_unused]] const Key& other : content.keys)
    TUNICA_ASSERT(other.name != key.name, "key \"" + key.name + "\" is declared twice");
  content.keys.push_back(std::move(key));
}

}  // namespace

Range any() { return {}; }

Range positive() {
  Range range;
  range.low = 0.0;
  range.low_open = true;
  return range;
}

Range non_negative() {
  Range range;
  range.low = 0.0;
  return range;
}

Range between(double low, double high) {
  Range range;
  range.low = low;
  range.high = high;
  return range;
}

Table::Table(std::string sentence) : content_(new Content{std::move(sentence), {}, {}}) {}
Table::Table(const Table& other) : content_(new Content(*other.content_)) {}
Table& Table::operator=(const Table& other) {
  content_ = std::make_unique<Content>(*other.content_);
  return *this;
}
Table::~Table() = default;

Table& Table::number(const std::string& name, std::optional<double> fallback, const Range& range,
                     const std::string& unit, const std::string& sentence) {
  Key key = value_key(Kind::number, name, fallback, sentence);
  key.range = range;
  key.unit = unit;
  add(*content_, std::move(key));
  return *this;
}

Table& Table::integer(const std::string& name, std::optional<int> fallback, const Range& range,
                      const std::string& sentence) {
  Key key = value_key(Kind::integer, name, fallback, sentence);
  key.range = range;
  add(*content_, std::move(key));
  return *this;
}

Table& Table::flag(const std::string& name, std::optional<bool> fallback,
                   const std::string& sentence) {
  add(*content_, value_key(Kind::flag, name, fallback, sentence));
  return *this;
}

Table& Table::text(const std::string& name, std::optional<std::string> fallback,
                   const std::string& sentence) {
  add(*content_, value_key(Kind::text, name, fallback, sentence));
  return *this;
}

Table& Table::choice(const std::string& name, std::optional<std::string> fallback,
                     const std::vector<std::string>& options, const std::string& sentence) {
  Key key = value_key(Kind::choice, name, fallback, sentence);
  key.options = options;
  add(*content_, std::move(key));
  return *this;
}

Table& Table::file(const std::string& name, std::optional<std::string> fallback,
                   const std::string& sentence) {
  add(*content_, value_key(Kind::file, name, fallback, sentence));
  return *this;
}

Table& Table::numbers(const std::string& name, std::optional<std::vector<double>> fallback,
                      const Range& range, std::size_t size, const std::string& unit,
                      const std::string& sentence) {
  Key key = value_key(Kind::numbers, name, array(fallback), sentence);
  key.range = range;
  key.unit = unit;
  key.size = size;
  add(*content_, std::move(key));
  return *this;
}

Table& Table::names(const std::string& name, std::optional<std::vector<std::string>> fallback,
                    const std::string& sentence) {
  add(*content_, value_key(Kind::names, name, array(fallback), sentence));
  return *this;
}

Table& Table::sublist(const std::string& name, const Table& table) {
  Key key{Kind::sublist, name, table.content().sentence};
  key.tables = {table};
  add(*content_, std::move(key));
  return *this;
}

Table& Table::entries(const std::string& name, const Table& each, const std::string& sentence) {
  Key key{Kind::entries, name, sentence};
  key.tables = {each};
  add(*content_, std::move(key));
  return *this;
}

Table& Table::variant(const std::string& name, std::optional<std::string> fallback,
                      const std::vector<Case>& cases, const std::string& sentence) {
  Key key = value_key(Kind::variant, name, fallback, sentence);
  for (const Case& one : cases) {
    key.options.push_back(one.value);
    key.tables.push_back(one.table);
  }
  add(*content_, std::move(key));
  return *this;
}

Table& Table::foreign(const std::string& name, const Teuchos::ParameterList& fallback,
                      const Teuchos::ParameterList& valid, const std::string& sentence) {
  Key key{Kind::foreign, name, sentence};
  key.foreign = fallback;
  key.valid = valid;
  add(*content_, std::move(key));
  return *this;
}

Table& Table::removed(const std::string& name, const std::string& successor) {
  Key key{Kind::removed, name, ""};
  key.successor = successor;
  add(*content_, std::move(key));
  return *this;
}

Table& Table::check(Check condition) {
  content_->checks.push_back(std::move(condition));
  return *this;
}

}  // namespace tunica::params
