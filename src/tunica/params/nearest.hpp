#pragma once
#include <string>
#include <vector>

namespace tunica::params {

/// Number of insertions, deletions, replacements and swaps of neighbours that lead from one
/// text to the other (Damerau–Levenshtein, each letter touched once).
int edit_distance(const std::string& from, const std::string& to);

/// The valid name that was probably meant: equal but for capitals, otherwise the nearest within
/// distance 2 (capitals ignored; the first of several); "" if there is none.
/// A name is never turned into one that shares nothing with it ("dt" is not "h").
std::string nearest(const std::string& name, const std::vector<std::string>& valid);

/// `Did you mean "x"?`, or `Valid: "a", "b".` if nothing is near.
std::string did_you_mean(const std::string& name, const std::vector<std::string>& valid);

/// `"a", "b", "c"`
std::string quoted(const std::vector<std::string>& names);

}  // namespace tunica::params
