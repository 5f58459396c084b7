#pragma once
#include <string>

namespace tunica::io {

/// Replaces the file by the text in one step: a reader sees the old text or the new one, never
/// a part. The text goes to "<path>.tmp", which is then renamed.
/// Returns what went wrong, naming the file; empty on success. Not collective.
std::string replace_file(const std::string& path, const std::string& text);

/// Renames "fields.h5" to "fields.old.h5", or to "fields.old-2.h5" where that is taken, and so on:
/// nothing is overwritten. new_name receives the name. Returns as replace_file(). Not collective.
std::string set_aside(const std::string& path, std::string& new_name);

/// ": No space left on device" from errno, or empty if errno says nothing.
std::string system_reason();

}  // namespace tunica::io
