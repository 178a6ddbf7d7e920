// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "src/core/base/tensor.hpp"
#include "src/core/base/words.hpp"

namespace whipple::solids {

/// Selects the type of the values of voxels.
enum class VoxelType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
constexpr std::array<Word<VoxelType>, 8> words(VoxelType) {
  return {{{VoxelType::int8, "int8"},
           {VoxelType::uint8, "uint8"},
           {VoxelType::int16, "int16"},
           {VoxelType::uint16, "uint16"},
           {VoxelType::int32, "int32"},
           {VoxelType::uint32, "uint32"},
           {VoxelType::float32, "float32"},
           {VoxelType::float64, "float64"}}};
}
std::size_t bytes_of(VoxelType type);

/// Selects how the values are stored.
enum class Packing : std::uint8_t { raw, gzip, text };

/// Describes the voxels of an image, from its header.
struct ImageHeader {
  std::array<std::uint64_t, 3> size{};  ///< voxels along the axes of the image, the first one varies fastest
  VoxelType type = VoxelType::uint8;
  std::endian order = std::endian::little;
  Vector3 origin = Vector3::Zero();     ///< of the centre of the first voxel, in units of the file
  Matrix3 steps = Matrix3::Identity();  ///< columns: from one voxel to the next along each axis
  double slope = 1.0, intercept = 0.0;  ///< a value is intercept + slope stored number
  Packing packing = Packing::raw;
  std::size_t begin = 0;  ///< byte of the first value in its file, after unpacking of a packed whole file
  bool is_packed_whole = false;  ///< the header is packed together with the values
  std::optional<double> unit;    ///< m, that the file states for its places
  std::filesystem::path data;    ///< file of the values, beside the header; empty: the same file

  [[nodiscard]] std::uint64_t count() const { return size[0] * size[1] * size[2]; }
};

/// Holds an image of voxels in three dimensions.
class Image {
 public:
  /// Reads an image with a header of its own: NRRD, MetaImage or NIfTI-1, determined by its content.
  /// @throws InputError naming the file: another format, damaged, a size that the file cannot have
  static Image read(const std::filesystem::path& path);
  /// Reads the values of a file without header.
  static Image read_raw(const std::filesystem::path& path, const ImageHeader& header);

  /// Returns the file that the header of an image names for its values; empty if there is none.
  static std::filesystem::path companion(const std::filesystem::path& path);

  [[nodiscard]] const ImageHeader& header() const { return header_; }
  [[nodiscard]] double value(std::uint64_t voxel) const;

 private:
  Image(ImageHeader header, std::string values) : header_(std::move(header)), values_(std::move(values)) {}
  static Image with_values(const ImageHeader& header, std::string_view bytes, const std::string& file);

  ImageHeader header_;
  std::string values_;
};

/// Reads the header of an image. @param bytes  of the file @param file  its name for messages
ImageHeader read_nrrd_header(std::string_view bytes, const std::string& file);
ImageHeader read_meta_image_header(std::string_view bytes, const std::string& file);
ImageHeader read_nifti_header(std::string_view bytes, const std::string& file);

/// Unpacks exactly `size` bytes of a gzip or zlib stream, and ignores what follows.
/// @throws InputError naming the file if it is damaged, or holds less
std::string unpacked(std::string_view bytes, std::uint64_t size, const std::string& file);

/// Checks that a file of the values beside a header is named without folder: a header must not make the program read
/// other files. @throws InputError
std::filesystem::path beside(std::string_view name, const std::string& file);

}  // namespace whipple::solids
