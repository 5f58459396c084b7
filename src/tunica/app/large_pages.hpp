#pragma once

namespace tunica::app {

/// Loads the program anew with its memory on large pages, on systems that have them for who asks.
/// Matrices that are read from end to end come from memory up to twice as fast so, for addresses
/// take less looking up. The first call of a program, before MPI begins. Where GLIBC_TUNABLES or
/// LD_PRELOAD is set it does nothing: the user or a tool has other wishes.
void use_large_pages(char** argv);

}  // namespace tunica::app
