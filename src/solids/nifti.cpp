// SPDX-License-Identifier: BSD-3-Clause
// Header of NIfTI-1: 348 bytes (nifti.nimh.nih.gov/nifti-1, nifti1.h).
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "src/core/base/error.hpp"
#include "src/solids/bytes.hpp"
#include "src/solids/image.hpp"

namespace whipple::solids {
namespace {

constexpr std::int32_t header_bytes = 348;

VoxelType type_of(std::int16_t code, const std::string& file) {
  switch (code) {
    case 2:
      return VoxelType::uint8;
    case 4:
      return VoxelType::int16;
    case 8:
      return VoxelType::int32;
    case 16:
      return VoxelType::float32;
    case 64:
      return VoxelType::float64;
    case 256:
      return VoxelType::int8;
    case 512:
      return VoxelType::uint16;
    case 768:
      return VoxelType::uint32;
    default:
      throw InputError(
          fmt::format("{}: data type {} is not known; known: 2, 4, 8, 16, 64, 256, 512, 768", file, code));
  }
}

}  // namespace

ImageHeader read_nifti_header(std::string_view bytes, const std::string& file) {
  ImageHeader header;
  header.order = number_at<std::int32_t>(bytes, 0) == header_bytes ? std::endian::little : std::endian::big;
  const auto integer = [&](std::size_t at) { return number_at<std::int16_t>(bytes, at, header.order); };
  const auto real = [&](std::size_t at) { return double{number_at<float>(bytes, at, header.order)}; };
  if (number_at<std::int32_t>(bytes, 0, header.order) != header_bytes) {
    throw InputError(fmt::format("{}: the header does not begin with its size, {}", file, header_bytes));
  }
  if (bytes.substr(344, 3) != "n+1") {
    throw InputError(fmt::format("{}: header and values in two files; expected one file (.nii)", file));
  }
  const std::int16_t dimensions = integer(40);
  bool is_volume = dimensions >= 3 && dimensions <= 7;
  for (std::int16_t d = 4; is_volume && d <= dimensions; ++d) {
    is_volume = integer(40 + 2 * static_cast<std::size_t>(d)) == 1;
  }
  if (!is_volume) throw InputError(fmt::format("{}: expected an image of 3 dimensions, and one time", file));
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int16_t n = integer(42 + 2 * a);
    if (n < 1) throw InputError(fmt::format("{}: {} voxels along an axis", file, n));
    header.size[a] = static_cast<std::uint64_t>(n);
  }
  header.type = type_of(integer(70), file);
  const double begin = real(108);
  if (!(begin >= header_bytes && begin < 1e9)) {
    throw InputError(fmt::format("{}: the values begin at byte {}", file, begin));
  }
  header.begin = static_cast<std::size_t>(begin);
  if (real(112) != 0.0 && std::isfinite(real(112)) && std::isfinite(real(116))) {
    header.slope = real(112);
    header.intercept = real(116);
  }
  constexpr std::array<double, 4> units = {0.0, 1.0, 1e-3, 1e-6};  // m, by the code of space
  const auto code = static_cast<std::size_t>(number_at<std::uint8_t>(bytes, 123) & 7U);
  if (code >= units.size()) throw InputError(fmt::format("{}: unit {} of lengths is not known", file, code));
  if (code > 0) header.unit = units[code];
  if (integer(254) > 0) {  // sform
    for (Eigen::Index a = 0; a < 3; ++a) {
      const auto row = 280 + 16 * static_cast<std::size_t>(a);
      for (Eigen::Index b = 0; b < 3; ++b) header.steps(a, b) = real(row + 4 * static_cast<std::size_t>(b));
      header.origin[a] = real(row + 12);
    }
    return header;
  }
  Matrix3 turn = Matrix3::Identity();
  const double hand = real(76) < 0.0 ? -1.0 : 1.0;
  if (integer(252) > 0) {  // qform: a unit quaternion
    const double b = real(256), c = real(260), d = real(264);
    const double a = std::sqrt(std::max(0.0, 1.0 - b * b - c * c - d * d));
    turn << a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c),  //
        2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b),      //
        2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c;
    header.origin = Vector3(real(268), real(272), real(276));
    turn.col(2) *= hand;
  }
  for (Eigen::Index a = 0; a < 3; ++a) {
    header.steps.col(a) = std::abs(real(80 + 4 * static_cast<std::size_t>(a))) * turn.col(a);
  }
  return header;
}

}  // namespace whipple::solids
