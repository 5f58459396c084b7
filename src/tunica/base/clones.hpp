#pragma once

/// Before the definition of a function: the compiler makes it twice, once for processors that
/// multiply and add four doubles in one step ("fma" includes AVX) and once for any other; the
/// program picks at its start. Nothing on other architectures, nor where the sanitizers would run
/// before the pick.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TUNICA_CLONES __attribute__((target_clones("fma", "default")))
#else
#define TUNICA_CLONES
#endif
