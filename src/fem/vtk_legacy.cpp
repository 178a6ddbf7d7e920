// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "src/core/base/error.hpp"
#include "src/fem/vtk_arrays.hpp"

namespace whipple::fem {
namespace {

/// Splits a text into words and tracks the line number.
class LegacyReader {
 public:
  LegacyReader(std::string_view text, const std::string& file) : rest_(text), file_(file) {}

  VtkGrid read() {
    line_of_text();
    line_of_text();  // a title
    if (const std::string_view form = word(); form != "ASCII") {
      fail(fmt::format(
          "is in the form \"{}\": only ASCII files of the legacy format are read; write a .vtu instead",
          form));
    }
    if (word() != "DATASET") fail("expected DATASET");
    if (const std::string_view kind = word(); kind != "UNSTRUCTURED_GRID")
      fail(fmt::format("the data set is {}, expected UNSTRUCTURED_GRID", kind));
    for (std::string_view section = word(); !section.empty(); section = word()) read_section(section);
    return std::move(grid_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: error: {}", file_, line_, what));
  }
  void line_of_text() {
    const std::size_t end = rest_.find('\n');
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
  }
  /// Returns the next word, empty at the end.
  std::string_view word() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t' || rest_.front() == '\r' ||
                              rest_.front() == '\n')) {
      if (rest_.front() == '\n') ++line_;
      rest_.remove_prefix(1);
    }
    const std::size_t length = std::min(rest_.find_first_of(" \t\r\n"), rest_.size());
    const std::string_view result = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return result;
  }
  template <class Number>
  Number number() {
    const std::string_view text = word();
    Number value{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || code != std::errc{} || end != text.data() + text.size())
      fail(fmt::format("\"{}\" is not a number", text));
    return value;
  }
  /// Reads the number of items that follow; memory is allocated item by item.
  std::size_t count() { return number<std::size_t>(); }

  /// Skips the metadata of an array, up to a blank line.
  void skip_metadata() {
    line_of_text();
    while (!rest_.empty() && rest_.front() != '\n' && rest_.front() != '\r') line_of_text();
  }

  /// Skips an array with the given number of components per point or cell, after its name and type.
  void skip_array(std::size_t components) {
    word();
    word();
    for (std::size_t i = 0; i < components * of_cells_; ++i) number<double>();
  }

  void read_section(std::string_view section) {
    if (section == "POINTS") {
      const std::size_t points = count();
      word();  // type
      for (std::size_t i = 0; i < 3 * points; ++i) grid_.points.push_back(number<double>());
    } else if (section == "CELLS") {
      read_cells();
    } else if (section == "CELL_TYPES") {
      for (std::size_t left = count(); left > 0; --left) grid_.types.push_back(number<long>());
    } else if (section == "CELL_DATA") {
      of_cells_ = count();
      in_cells_ = true;
    } else if (section == "POINT_DATA") {
      of_cells_ = count();
      in_cells_ = false;
    } else if (section == "SCALARS") {
      read_scalars();
    } else if (section == "FIELD") {
      word();
      for (std::size_t left = count(); left > 0; --left) {
        std::string name(word());
        for (; name == "METADATA"; name = word()) skip_metadata();  // of the preceding array
        const std::size_t components = count(), tuples = count();
        take(name, word(), components, tuples);
      }
    } else if (section == "METADATA") {
      skip_metadata();
    } else if (section == "VECTORS" || section == "NORMALS") {
      skip_array(3);
    } else if (section == "TENSORS") {
      skip_array(9);
    } else if (section == "TENSORS6") {
      skip_array(6);
    } else if (section == "GLOBAL_IDS" || section == "PEDIGREE_IDS") {
      skip_array(1);
    } else if (section == "TEXTURE_COORDINATES") {
      word();
      const std::size_t components = count();
      word();
      for (std::size_t i = 0; i < components * of_cells_; ++i) number<double>();
    } else {
      fail(
          fmt::format("\"{}\" is not read here; known are POINTS, CELLS, CELL_TYPES, CELL_DATA and "
                      "POINT_DATA with SCALARS, VECTORS, NORMALS, TENSORS, GLOBAL_IDS, FIELD",
                      section));
    }
  }

  /// Reads lists with their lengths (versions 2 to 4), or offsets and connectivity (version 5).
  void read_cells() {
    grid_.line = line_;
    const std::size_t first = count(), second = count();
    const std::string_view before = rest_;
    const std::size_t line = line_;
    if (word() == "OFFSETS") {
      word();
      for (std::size_t i = 0; i < first; ++i) {
        const long offset = number<long>();
        if (i > 0) grid_.offsets.push_back(offset);
      }
      if (word() != "CONNECTIVITY") fail("expected CONNECTIVITY");
      word();
      for (std::size_t i = 0; i < second; ++i) grid_.connectivity.push_back(number<long>());
      return;
    }
    rest_ = before;
    line_ = line;
    for (std::size_t cell = 0; cell < first; ++cell) {
      for (std::size_t left = count(); left > 0; --left) grid_.connectivity.push_back(number<long>());
      grid_.offsets.push_back(static_cast<long>(grid_.connectivity.size()));
    }
  }

  void read_scalars() {
    const std::string name(word());
    const std::string type(word());
    std::size_t components = 1;
    std::string_view next = word();
    if (next != "LOOKUP_TABLE") {
      const auto [end, code] = std::from_chars(next.data(), next.data() + next.size(), components);
      if (code != std::errc{} || end != next.data() + next.size() || word() != "LOOKUP_TABLE")
        fail("expected LOOKUP_TABLE");
    }
    word();
    take(name, type, components, of_cells_);
  }

  /// Reads an array; keeps integers of cells only.
  void take(const std::string& name, std::string_view type, std::size_t components, std::size_t tuples) {
    const bool kept = in_cells_ && components == 1 && type != "float" && type != "double";
    VtkGrid::CellArray array{name, {}};
    for (std::size_t i = 0; i < tuples; ++i) {
      for (std::size_t k = 0; k < components; ++k) {
        if (kept) {
          array.values.push_back(number<long>());
        } else {
          number<double>();
        }
      }
    }
    if (kept) grid_.cell_data.push_back(std::move(array));
  }

  std::string_view rest_;
  const std::string& file_;
  std::size_t line_ = 1, of_cells_ = 0;
  bool in_cells_ = false;
  VtkGrid grid_;
};

}  // namespace

VtkGrid read_legacy_vtk(const std::string& text, const std::string& file) {
  return LegacyReader(text, file).read();
}

}  // namespace whipple::fem
