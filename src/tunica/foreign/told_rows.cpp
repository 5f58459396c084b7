#include "tunica/foreign/told_rows.hpp"

#include <regex>

#include "tunica/algebra/dof_layout.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/systems/blocks.hpp"

namespace tunica::foreign {

namespace {

/// The rows of a field that the rank has of those wanted, as the files count them.
template <class IsWanted>
std::vector<long long> rows_of_files(const systems::System& system, int field,
                                     const IsWanted& is_wanted) {
  std::vector<long long> rows;
  const auto numbers = global_numbers(*(*system.K.space())[field].map);
  const auto in_files = global_numbers(*system.file_rows[field]);
  for (std::size_t k = 0; k < static_cast<std::size_t>(numbers.size()); ++k)
    if (is_wanted(numbers[k])) rows.push_back(in_files[k] - system.first_row[field]);
  return rows;
}

}  // namespace

std::string with_rows_of_files(const systems::System& system, const std::string& message) {
  std::smatch found;
  const std::regex place("(row|node) ([0-9]+) of ([0-9]+) unknowns");
  if (!std::regex_search(message, found, place) || std::stoll(found[3]) != system.K.n_unknowns())
    return message;
  const algebra::DofLayout layout(*system.K.space());
  const bool is_row = found[1] == "row";
  const long long number = std::stoll(found[2]);
  std::string rows;
  for (int field = 0; field < system.K.n_blocks(); ++field) {
    const std::string text = systems::text_of_rows(
        *system.K.comm(),
        rows_of_files(system, field,
                      [&](GlobalOrdinal in_block) {
                        const GlobalOrdinal merged = layout.merged(field, in_block);
                        return (is_row ? merged : merged / layout.dofs()) == number;
                      }),
        system.files[field]);
    rows += (rows.empty() || text.empty() ? "" : " and ") + text;
  }
  std::string told = rows.empty() ? message : found.prefix().str() + rows + found.suffix().str();
  broadcast(*system.K.comm(), told);
  return told;
}

}  // namespace tunica::foreign
