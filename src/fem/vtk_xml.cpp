// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string_view>

#include "src/core/base/error.hpp"
#include "src/fem/vtk_arrays.hpp"

namespace whipple::fem {
namespace {

using Tree = boost::property_tree::ptree;

constexpr std::size_t most_bytes = std::size_t{1}
                                   << 34;  // per array; a damaged length must not exhaust memory

class VtuReader {
 public:
  VtuReader(const std::string& text, const std::string& file) : file_(file) {
    const std::size_t at = text.find("<AppendedData");
    std::string head = text.substr(0, at);
    if (at != std::string::npos) {
      head += "</VTKFile>";
      const std::size_t mark = text.find('_', at), tag_end = text.find('>', at);
      if (mark == std::string::npos || tag_end == std::string::npos) fail("the appended data do not begin");
      is_raw_ = std::string_view(text).substr(at, tag_end - at).find("raw") != std::string_view::npos;
      appended_ = std::string_view(text).substr(mark + 1);
    }
    const std::size_t cells = text.find("<Cells");
    if (cells != std::string::npos)
      grid_.line =
          1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + std::ptrdiff_t(cells), '\n'));
    require_shallow(head);
    std::istringstream stream(head);
    try {
      boost::property_tree::read_xml(stream, tree_);
    } catch (const boost::property_tree::xml_parser_error& error) {
      throw InputError(fmt::format("{}:{}: error: is no XML: {}", file_, error.line(), error.message()));
    }
  }

  VtkPoints points(const std::function<bool(std::string_view)>& wanted) {
    const Tree& piece = only_piece();
    const std::size_t count = announced(piece, "NumberOfPoints");
    VtkPoints found;
    for (const auto& [name, array] : child(piece, "Points")) {
      if (name == "DataArray") found.points = values<double>(array, 3 * count);
    }
    if (found.points.size() != 3 * count)
      fail(fmt::format("announces {} points and has {} coordinates", count, found.points.size()));
    const auto data = piece.get_child_optional("PointData");
    if (!data) return found;
    for (const auto& [name, array] : *data) {
      const std::string called = attribute(array, "Name"), parts = attribute(array, "NumberOfComponents");
      if (name != "DataArray" || (!parts.empty() && parts != "1") || !wanted(called)) continue;
      found.data.push_back({called, values<double>(array, count)});
      if (found.data.back().values.size() != count) {
        fail(fmt::format("the array \"{}\" has {} values for {} points", called,
                         found.data.back().values.size(), count));
      }
    }
    return found;
  }

  VtkGrid read() {
    const Tree& piece = only_piece();
    // Nothing longer than announced by the piece is decompressed.
    constexpr std::size_t most_corners = 27;  // of a cell
    const std::size_t points = announced(piece, "NumberOfPoints"), cells = announced(piece, "NumberOfCells");
    for (const auto& [name, array] : child(piece, "Points")) {
      if (name == "DataArray") grid_.points = values<double>(array, 3 * points);
    }
    for (const auto& [name, array] : child(piece, "Cells")) {
      if (name != "DataArray") continue;
      const std::string called = attribute(array, "Name");
      if (called == "connectivity") grid_.connectivity = values<long>(array, most_corners * cells);
      if (called == "offsets") grid_.offsets = values<long>(array, cells);
      if (called == "types") grid_.types = values<long>(array, cells);
    }
    if (const auto data = piece.get_child_optional("CellData")) {
      for (const auto& [name, array] : *data) {
        const std::string parts = attribute(array, "NumberOfComponents");
        if (name != "DataArray" || (!parts.empty() && parts != "1") ||
            attribute(array, "type").find("Int") == std::string::npos)
          continue;
        grid_.cell_data.push_back({attribute(array, "Name"), values<long>(array, cells)});
      }
    }
    return std::move(grid_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: error: {}", file_, what));
  }
  /// Reads the head of the file. @returns its only piece
  const Tree& only_piece() {
    const Tree& root = child(tree_, "VTKFile");
    if (const std::string type = attribute(root, "type"); type != "UnstructuredGrid") {
      fail(fmt::format("holds \"{}\", expected an UnstructuredGrid (.vtu)", type));
    }
    if (attribute(root, "byte_order") == "BigEndian") fail("is big endian: write it as little endian");
    header_ = attribute(root, "header_type") == "UInt64" ? 8 : 4;
    const std::string compressor = attribute(root, "compressor");
    is_packed_ = !compressor.empty();
    if (is_packed_ && compressor != "vtkZLibDataCompressor")
      fail(fmt::format("is packed by {}: only vtkZLibDataCompressor is read", compressor));
    const Tree& grid = child(root, "UnstructuredGrid");
    if (grid.count("Piece") != 1) fail(fmt::format("has {} pieces, expected one", grid.count("Piece")));
    return child(grid, "Piece");
  }
  /// Rejects deeply nested files, as the parser is recursive.
  void require_shallow(std::string_view head) const {
    constexpr int deepest = 64;
    int depth = 0;
    for (std::size_t at = head.find('<'); at != std::string_view::npos; at = head.find('<', at + 1)) {
      const char next = at + 1 < head.size() ? head[at + 1] : '/';
      if (next != '/' && next != '?' && next != '!' && ++depth > deepest)
        fail("its elements are nested too deeply");
      const std::size_t end = head.find('>', at);
      const bool closes = next == '/' || (end != std::string_view::npos && head[end - 1] == '/');
      if (closes && next != '?' && next != '!') --depth;
    }
  }
  const Tree& child(const Tree& tree, const char* name) const {
    const auto found = tree.find(name);
    if (found == tree.not_found()) fail(fmt::format("has no <{}>", name));
    return found->second;
  }
  static std::string attribute(const Tree& tree, const char* name) {
    return tree.get<std::string>(Tree::path_type(std::string("<xmlattr>/") + name, '/'), "");
  }

  /// Returns the number given by an attribute of the piece.
  std::size_t announced(const Tree& piece, const char* name) const {
    const std::string word = attribute(piece, name);
    std::size_t number = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (code != std::errc{} || end != word.data() + word.size() || number > most_bytes)
      fail(fmt::format("{}=\"{}\" is no number of points or cells", name, word));
    return number;
  }

  /// Reads an array. @param most  maximum number of values
  template <class Number>
  std::vector<Number> values(const Tree& array, std::size_t most) const {
    constexpr std::size_t widest = 8;  // bytes of a value
    const std::string type = attribute(array, "type"), form = attribute(array, "format");
    if (form == "ascii" || form.empty()) return written<Number>(array.data());
    std::string bytes;
    if (form == "binary") {
      bytes = unpacked(array.data(), false, widest * most);
    } else if (form == "appended") {
      const std::string word = attribute(array, "offset");
      std::size_t offset = 0;
      const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), offset);
      if (code != std::errc{} || end != word.data() + word.size() || offset > appended_.size())
        fail(fmt::format("the offset \"{}\" is not in the appended data", word));
      bytes = unpacked(appended_.substr(offset), is_raw_, widest * most);
    } else {
      fail(fmt::format("an array has the format \"{}\", expected ascii, binary or appended", form));
    }
    if (type == "Float64") return as<double, Number>(bytes);
    if (type == "Float32") return as<float, Number>(bytes);
    if (type == "Int64") return as<std::int64_t, Number>(bytes);
    if (type == "UInt64") return as<std::uint64_t, Number>(bytes);
    if (type == "Int32") return as<std::int32_t, Number>(bytes);
    if (type == "UInt32") return as<std::uint32_t, Number>(bytes);
    if (type == "Int16") return as<std::int16_t, Number>(bytes);
    if (type == "UInt16") return as<std::uint16_t, Number>(bytes);
    if (type == "Int8") return as<std::int8_t, Number>(bytes);
    if (type == "UInt8") return as<std::uint8_t, Number>(bytes);
    fail(fmt::format("an array has the unknown type \"{}\"", type));
  }

  template <class Number>
  std::vector<Number> written(const std::string& text) const {
    std::vector<Number> result;
    const char* at = text.data();
    const char* const end = at + text.size();
    for (;;) {
      while (at != end && (*at == ' ' || *at == '\n' || *at == '\t' || *at == '\r')) ++at;
      if (at == end) return result;
      Number value{};
      const auto [next, code] = std::from_chars(at, end, value);
      if (code != std::errc{})
        fail(fmt::format("\"{}\" is not a number",
                         std::string_view(at, std::size_t(std::min<std::ptrdiff_t>(end - at, 12)))));
      result.push_back(value);
      at = next;
    }
  }

  template <class Stored, class Number>
  std::vector<Number> as(const std::string& bytes) const {
    if (std::is_floating_point_v<Stored> && std::is_integral_v<Number>)
      fail("an array of integers is one of reals");
    if (bytes.size() % sizeof(Stored) != 0) fail("an array is no whole number of values");
    std::vector<Number> result(bytes.size() / sizeof(Stored));
    for (std::size_t i = 0; i < result.size(); ++i) {
      Stored value;
      std::memcpy(&value, bytes.data() + i * sizeof(Stored), sizeof value);
      result[i] = static_cast<Number>(value);
    }
    return result;
  }

  /// Reads a stream of bytes, raw or base64-encoded.
  class Bytes {
   public:
    Bytes(std::string_view text, bool raw) : text_(text), raw_(raw) {}
    /// Returns the next bytes; fewer if the stream ends.
    std::string take(std::size_t count) {
      while (!raw_ && left_.size() < count && decode()) {
      }
      if (raw_) {
        const std::string_view taken = text_.substr(0, count);
        text_.remove_prefix(taken.size());
        return std::string(taken);
      }
      std::string taken = left_.substr(0, count);
      left_.erase(0, taken.size());
      return taken;
    }

   private:
    bool decode() {
      constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      std::string decoded;
      for (int group = 0; group < 1024; ++group) {
        std::uint32_t bits = 0;
        std::size_t signs = 0, padding = 0;
        while (signs < 4 && !text_.empty()) {
          const char letter = text_.front();
          const std::size_t digit = digits.find(letter);
          if (digit == std::string_view::npos && letter != '=' && letter != ' ' && letter != '\n' &&
              letter != '\r' && letter != '\t')
            return finish(decoded);
          text_.remove_prefix(1);
          if (letter == '=') ++padding;
          if (digit == std::string_view::npos && letter != '=') continue;
          bits = bits << 6U | static_cast<std::uint32_t>(letter == '=' ? 0 : digit);
          ++signs;
        }
        if (signs < 4) return finish(decoded);
        for (std::size_t k = 0; k + std::min<std::size_t>(padding, 2) < 3; ++k)
          decoded += static_cast<char>(bits >> (16U - 8U * k) & 255U);
        if (padding > 0) break;  // end of a part of the stream: the next one begins with a new group of four
      }
      return finish(decoded);
    }
    bool finish(const std::string& decoded) {
      left_ += decoded;
      return !decoded.empty();
    }
    std::string_view text_;
    bool raw_;
    std::string left_;
  };

  std::uint64_t length(Bytes& bytes) const {
    const std::string raw = bytes.take(header_);
    if (raw.size() < header_) fail("an array ends before its length");
    std::uint64_t value = 0;
    std::memcpy(&value, raw.data(), header_);
    if (value > most_bytes) fail(fmt::format("an array of {} bytes is none", value));
    return value;
  }

  void require_at_most(std::size_t most, double bytes) const {
    if (bytes > static_cast<double>(most))
      fail(fmt::format(
          "an array unpacks to {:.0f} bytes, but the points and cells that the piece announces take at "
          "most {}",
          bytes, most));
  }

  /// Returns the bytes of an array: preceded by their number, or in zlib blocks preceded by the number of blocks, the
  /// block size, the size of the last block (0: full), and the compressed sizes. @param most  maximum number of bytes
  std::string unpacked(std::string_view text, bool raw, std::size_t most) const {
    Bytes bytes(text, raw);
    if (!is_packed_) {
      const std::uint64_t size = length(bytes);
      require_at_most(most, static_cast<double>(size));
      std::string result = bytes.take(size);
      if (result.size() < size) fail("an array ends before its last value");
      return result;
    }
    const std::uint64_t blocks = length(bytes), whole = length(bytes), last = length(bytes);
    const auto all = static_cast<double>(blocks) * static_cast<double>(whole);
    require_at_most(
        most, last > 0 && blocks > 0 ? all - static_cast<double>(whole) + static_cast<double>(last) : all);
    std::vector<std::uint64_t> sizes;
    for (std::uint64_t i = 0; i < blocks; ++i) sizes.push_back(length(bytes));
    std::string result;
    for (std::uint64_t i = 0; i < blocks; ++i) {
      const std::string packed = bytes.take(sizes[i]);
      uLongf room = i + 1 == blocks && last > 0 ? last : whole;
      const std::uint64_t expected = room;
      if (packed.size() < sizes[i] || expected > 1100 * (sizes[i] + 64))
        fail("a packed array is damaged");  // the compression ratio of zlib is at most 1032
      std::string block(room, '\0');
      if (uncompress(reinterpret_cast<Bytef*>(block.data()), &room,
                     reinterpret_cast<const Bytef*>(packed.data()),  // NOLINT
                     packed.size()) != Z_OK ||
          room != expected) {
        fail("a packed array is damaged");
      }
      result += block;
    }
    return result;
  }

  const std::string& file_;
  Tree tree_;
  std::string_view appended_;
  bool is_raw_ = false, is_packed_ = false;
  std::size_t header_ = 4;
  VtkGrid grid_;
};

}  // namespace

VtkGrid read_vtu(const std::string& text, const std::string& file) { return VtuReader(text, file).read(); }

VtkPoints read_vtu_points(const std::string& text, const std::string& file,
                          const std::function<bool(std::string_view)>& wanted) {
  return VtuReader(text, file).points(wanted);
}

}  // namespace whipple::fem
