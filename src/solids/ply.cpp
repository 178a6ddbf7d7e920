// SPDX-License-Identifier: BSD-3-Clause
// Grammar of PLY: a header of text that declares elements and their properties, then their values as text or binary.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "src/core/base/error.hpp"
#include "src/solids/bytes.hpp"
#include "src/solids/fields.hpp"
#include "src/solids/surface_file.hpp"

namespace whipple::solids {
namespace {

enum class Coding : std::uint8_t { text, little_endian, big_endian };

struct Type {
  std::array<std::string_view, 2> names;
  std::size_t bytes;
  double (*read)(std::string_view bytes, std::size_t at, std::endian order);
};
template <class Number>
constexpr Type type(std::string_view name, std::string_view other) {
  return {{name, other}, sizeof(Number), [](std::string_view bytes, std::size_t at, std::endian order) {
            return static_cast<double>(number_at<Number>(bytes, at, order));
          }};
}
constexpr std::array<Type, 8> types = {
    type<std::int8_t>("char", "int8"),    type<std::uint8_t>("uchar", "uint8"),
    type<std::int16_t>("short", "int16"), type<std::uint16_t>("ushort", "uint16"),
    type<std::int32_t>("int", "int32"),   type<std::uint32_t>("uint", "uint32"),
    type<float>("float", "float32"),      type<double>("double", "float64")};

struct Property {
  std::string name;
  const Type* count;  ///< of a list; null for a single number
  const Type* value;
};
struct Element {
  std::string name;
  std::size_t count;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& file)
      : bytes_(bytes), file_(file), fields_(bytes, file) {}

  std::vector<Triangle> read() {
    read_header();
    at_ = fields_.bytes_read();
    for (const Element& element : elements_) read_element(element);
    return std::move(triangles_);
  }

 private:
  void read_header() {
    fields_.next_line();  // ply
    while (true) {
      if (!fields_.next_line()) fields_.fail("the header ends before \"end_header\"");
      const std::string_view key = fields_.word();
      if (key == "end_header") break;
      if (key == "format") {
        const std::string_view word = fields_.word();
        if (word == "ascii") {
          coding_ = Coding::text;
        } else if (word == "binary_little_endian") {
          coding_ = Coding::little_endian;
        } else if (word == "binary_big_endian") {
          coding_ = Coding::big_endian;
        } else {
          fields_.fail(fmt::format("format \"{}\"; known: ascii, binary_little_endian, binary_big_endian",
                                   shown(word)));
        }
      } else if (key == "element") {
        const std::string name(fields_.word());
        const auto count = fields_.number<std::uint64_t>();
        if (count > bytes_.size()) {
          fields_.fail(
              fmt::format("{} elements \"{}\" in a file of {} bytes", count, shown(name), bytes_.size()));
        }
        elements_.push_back({name, count, {}});
      } else if (key == "property") {
        if (elements_.empty()) fields_.fail("a property before the first element");
        read_property(elements_.back());
      } else if (key != "comment" && key != "obj_info" && !key.empty()) {
        fields_.fail(fmt::format("\"{}\" is no word of a PLY header", shown(key)));
      }
    }
    if (!coding_) fields_.fail("the header states no format");
  }

  void read_property(Element& element) {
    std::string_view word = fields_.word();
    const Type* count = nullptr;
    if (word == "list") {
      count = &type_named(fields_.word());
      word = fields_.word();
    }
    const Type& value = type_named(word);
    element.properties.push_back({std::string(fields_.word()), count, &value});
  }

  const Type& type_named(std::string_view word) const {
    for (const Type& type : types) {
      if (word == type.names[0] || word == type.names[1]) return type;
    }
    fields_.fail(fmt::format("\"{}\" is no type of a property", shown(word)));
  }

  double take(const Type& type) {
    if (coding_ == Coding::text) {
      const auto value = Fields::parsed<double>(fields_.word());
      if (!value) fields_.fail("expected a finite number for every property");
      return *value;
    }
    if (bytes_.size() - at_ < type.bytes) {
      throw InputError(fmt::format("{}: the file ends before its last element", file_));
    }
    const double value =
        type.read(bytes_, at_, coding_ == Coding::little_endian ? std::endian::little : std::endian::big);
    at_ += type.bytes;
    return value;
  }

  void next_row() {
    if (coding_ != Coding::text) return;
    do {
      if (!fields_.next_line()) fields_.fail("the file ends before its last element");
    } while (fields_.is_blank());
  }

  void read_element(const Element& element) {
    if (element.properties.empty()) return;
    const bool are_corners = element.name == "vertex", are_faces = element.name == "face";
    std::vector<double> list;
    for (std::size_t row = 0; row < element.count; ++row) {
      next_row();
      Vector3 x = Vector3::Constant(std::nan(""));
      for (const Property& property : element.properties) {
        if (property.count == nullptr) {
          const double value = take(*property.value);
          for (Eigen::Index a = 0; a < 3; ++a) {
            if (property.name == std::string_view("xyz").substr(static_cast<std::size_t>(a), 1)) x[a] = value;
          }
          continue;
        }
        list.clear();
        const double length = take(*property.count);
        if (!(length >= 0.0 && length <= static_cast<double>(bytes_.size()))) {
          throw InputError(
              fmt::format("{}: {} {} has a list of {} numbers", file_, shown(element.name), row, length));
        }
        for (double i = 0; i < length; ++i) list.push_back(take(*property.value));
        if (are_faces && (property.name == "vertex_indices" || property.name == "vertex_index"))
          add(list, row);
      }
      if (!are_corners) continue;
      if (!x.allFinite()) {
        throw InputError(fmt::format("{}: vertex {} has no finite x, y and z", file_, row));
      }
      corners_.push_back(x);
    }
  }

  void add(const std::vector<double>& face, std::size_t row) {
    for (const double corner : face) {
      if (corner >= 0.0 && corner < static_cast<double>(corners_.size())) continue;
      throw InputError(
          fmt::format("{}: face {} has corner {}; there are {}", file_, row, corner, corners_.size()));
    }
    const auto at = [&](std::size_t i) { return corners_[static_cast<std::size_t>(face[i])]; };
    for (std::size_t i = 2; i < face.size(); ++i) triangles_.push_back({at(0), at(i - 1), at(i)});
  }

  std::string_view bytes_;
  const std::string& file_;
  Fields fields_;
  std::optional<Coding> coding_;
  std::vector<Element> elements_;
  std::size_t at_ = 0;  // byte
  std::vector<Vector3> corners_;
  std::vector<Triangle> triangles_;
};

}  // namespace

std::vector<Triangle> read_ply(std::string_view bytes, const std::string& file) {
  return PlyReader(bytes, file).read();
}

}  // namespace whipple::solids
