// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

/// Defines the layout of SESAME files (docs/manual/output.md), for reading and writing.
namespace whipple::eos::sesame_layout {

// Units of the files (Lyon and Johnson, LA-UR-92-3407).
inline constexpr double Mg_m3 = 1e3, GPa = 1e9, MJ_kg = 1e6, g_mol = 1e-3, K = 1;

inline constexpr std::size_t words_per_line = 5, comment_width = 80;
/// Columns of a word in files written by this program: E15.8. When reading, the width is that of the first word of
/// a table (E16.8, E22.15).
inline constexpr std::size_t word_width = 15;
inline constexpr std::size_t least_word_width = 8;  ///< a smaller width is not a column of numbers
inline constexpr std::size_t most_words = 999999;   ///< limited by six columns of the header

}  // namespace whipple::eos::sesame_layout
