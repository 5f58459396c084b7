#pragma once
#include <string>

#include "tunica/base/outcome.hpp"

namespace tunica::io {

/// Replaces the file by the text in one step: a reader sees the old text or the new one, never
/// a part. The text goes to "<path>.tmp", which is then renamed. The reason of a failure names the
/// file. Not collective.
Outcome replace_file(const std::string& path, const std::string& text);

/// Renames "fields.h5" to "fields.old.h5", or to "fields.old-2.h5" where that is taken, and so on:
/// nothing is overwritten. The new path, or what went wrong. Not collective.
Result<std::string> set_aside(const std::string& path);

/// ": No space left on device" from errno, or empty if errno says nothing.
std::string system_reason();

}  // namespace tunica::io
