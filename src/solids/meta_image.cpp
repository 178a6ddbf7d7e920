// SPDX-License-Identifier: BSD-3-Clause
// Header of MetaImage: lines "Key = value" up to ElementDataFile (MetaIO of ITK).
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "src/solids/fields.hpp"
#include "src/solids/image.hpp"

namespace whipple::solids {
namespace {

struct TypeName {
  std::string_view name;
  VoxelType type;
};
constexpr std::array<TypeName, 10> type_names = {{{"MET_CHAR", VoxelType::int8},
                                                  {"MET_UCHAR", VoxelType::uint8},
                                                  {"MET_SHORT", VoxelType::int16},
                                                  {"MET_USHORT", VoxelType::uint16},
                                                  {"MET_INT", VoxelType::int32},
                                                  {"MET_UINT", VoxelType::uint32},
                                                  {"MET_LONG", VoxelType::int32},
                                                  {"MET_ULONG", VoxelType::uint32},
                                                  {"MET_FLOAT", VoxelType::float32},
                                                  {"MET_DOUBLE", VoxelType::float64}}};

}  // namespace

ImageHeader read_meta_image_header(std::string_view bytes, const std::string& file) {
  Fields lines(bytes, file);
  ImageHeader header;
  Vector3 spacing = Vector3::Ones();
  Matrix3 directions = Matrix3::Identity();
  bool has_type = false, has_size = false, is_binary = true;
  while (true) {
    if (!lines.next_line()) lines.fail("the header ends before ElementDataFile");
    const std::string_view key = lines.word();
    if (key.empty()) continue;
    if (lines.word() != "=") lines.fail(fmt::format("\"{}\" is no \"Key = value\"", shown(key)));
    const auto truth = [&] {
      const std::string_view word = lines.word();
      if (word != "True" && word != "true" && word != "1" && word != "False" && word != "false" &&
          word != "0") {
        lines.fail(fmt::format("'{}' is \"{}\": expected True or False", shown(key), shown(word)));
      }
      return word == "True" || word == "true" || word == "1";
    };
    if (key == "NDims") {
      if (lines.number<int>() != 3) lines.fail("expected 3 dimensions");
    } else if (key == "DimSize") {
      for (auto& n : header.size) n = lines.number<std::uint64_t>();
      if (!lines.is_blank()) lines.fail("'DimSize' has more than three numbers");
      has_size = true;
    } else if (key == "ElementType") {
      const std::string_view word = lines.word();
      const auto* found = std::ranges::find(type_names, word, &TypeName::name);
      if (found == type_names.end()) lines.fail(fmt::format("ElementType \"{}\" is not known", shown(word)));
      header.type = found->type;
      has_type = true;
    } else if (key == "ElementSpacing") {
      for (double& x : spacing) x = lines.number<double>();
    } else if (key == "Offset" || key == "Position" || key == "Origin") {
      for (double& x : header.origin) x = lines.number<double>();
    } else if (key == "TransformMatrix" || key == "Rotation" || key == "Orientation") {
      for (Eigen::Index a = 0; a < 3; ++a) {
        for (Eigen::Index b = 0; b < 3; ++b) directions(b, a) = lines.number<double>();
      }
    } else if (key == "BinaryDataByteOrderMSB" || key == "ElementByteOrderMSB") {
      header.order = truth() ? std::endian::big : std::endian::little;
    } else if (key == "BinaryData") {
      is_binary = truth();
    } else if (key == "CompressedData") {
      if (truth()) header.packing = Packing::gzip;
    } else if (key == "ElementNumberOfChannels") {
      if (lines.number<int>() != 1) lines.fail("expected one channel");
    } else if (key == "HeaderSize") {
      if (lines.number<int>() != 0) lines.fail("'HeaderSize' is not known");
    } else if (key == "ElementDataFile") {
      const std::string_view name = lines.word();
      if (!lines.word().empty()) lines.fail("expected one file of values, with a name without blanks");
      if (name != "LOCAL") header.data = beside(name, file);
      break;
    }
  }
  if (!has_type || !has_size) lines.fail("the header states no ElementType or no DimSize");
  if (!is_binary) header.packing = Packing::text;
  for (Eigen::Index a = 0; a < 3; ++a) header.steps.col(a) = spacing[a] * directions.col(a);
  if (header.data.empty()) header.begin = lines.bytes_read();
  return header;
}

}  // namespace whipple::solids
