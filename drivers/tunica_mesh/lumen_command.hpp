#pragma once
#include <string>
#include <vector>

/// "lumen": its words go to the program tunica-lumen beside this one, which takes the place of this
/// process. A program of its own, in Python, since what fills volumes has another licence.
/// Call it before MPI begins. Returns only by Error or MachineFault.
[[noreturn]] void become_lumen(const std::vector<std::string>& words);

/// Of the list of commands.
inline constexpr const char* lumen_name = "lumen";
inline constexpr const char* lumen_sentence =
    "Makes a mesh of the inside of a vessel's surface (STL, VTP, PLY, OBJ).";
