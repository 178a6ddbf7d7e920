// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "src/case/shapes/made.hpp"
#include "src/core/base/words.hpp"
#include "src/solids/image.hpp"

namespace whipple::cases {

/// Selects the order of the bytes of a number.
enum class ByteOrder : std::uint8_t { little_endian, big_endian };
constexpr std::array<Word<ByteOrder>, 2> words(ByteOrder) {
  return {{{ByteOrder::little_endian, "little_endian"}, {ByteOrder::big_endian, "big_endian"}}};
}

/// Selects what describes a file: its header, or the case.
enum class ImageDescription : std::uint8_t { header, keys };
constexpr std::array<Word<ImageDescription>, 2> words(ImageDescription) {
  return {{{ImageDescription::header, "header"}, {ImageDescription::keys, "case"}}};
}

/// Names the voxels of a body in an image.
struct ImageKeys {
  static constexpr const char* name = "image";
  std::string file;
  double unit = 0.0;
  std::vector<double> values;
  bool smooth = false;
  Vector3 offset = Vector3::Zero();
  ImageDescription described_by = ImageDescription::header;
  // Of files without header.
  std::vector<double> size;
  solids::VoxelType type = solids::VoxelType::uint8;
  ByteOrder order = ByteOrder::little_endian;
  std::int64_t skip = 0;
  Vector3 spacing = Vector3::Ones();
  std::string digest;

  static ParameterTable<ImageKeys> parameters();
};

/// Describes voxels of an image in three dimensions whose values lie between two limits: those of a label, or of a
/// range of grey values.
class VoxelBody final : public Shape, public Made<VoxelBody, ImageKeys> {
 public:
  static constexpr const char* name = ImageKeys::name;
  static constexpr const char* summary =
      "voxels with a label, or a range of values, in a NRRD, MetaImage, NIfTI-1 or raw file";

  /// Reads the file. @throws InputError naming it: not found, unreadable, or without such voxels; lists its labels
  VoxelBody(ImageKeys keys, const std::filesystem::path& folder);

  [[nodiscard]] bool contains(const Vector3& point) const override;
  [[nodiscard]] Bounds bounds() const override { return bounds_; }
  /// Returns the volume of the voxels.
  [[nodiscard]] double volume() const override { return volume_; }
  /// Returns the thickness that 1 % of the voxels fall below, the shortest way through them along the axes of the
  /// image.
  [[nodiscard]] double smallest_extent(const Vector3&) const override { return thickness_; }
  [[nodiscard]] std::optional<SourceFile> source() const override { return source_; }
  [[nodiscard]] std::vector<std::string> account() const override { return account_; }
  [[nodiscard]] std::string toml() const override;

 private:
  void take(const solids::Image& image);
  void describe_labels(const solids::Image& image);
  void measure_thickness();
  /// @param voxel  of the image
  [[nodiscard]] bool is_taken(const Eigen::Array3i& voxel) const;
  /// @param voxel  of the box
  [[nodiscard]] std::size_t index(const Eigen::Array3i& voxel) const;

  ImageKeys keys_;
  SourceFile source_;
  Matrix3 steps_, to_voxels_;  // m; 1/m
  Vector3 origin_;             // m, of the centre of the first voxel of the image
  // Box of voxels that is kept. Places are counted in the image and not in it: labels with boxes of their own must agree
  // on which voxel holds a point on a face.
  Eigen::Array3i first_, size_;
  std::shared_ptr<const std::vector<std::uint8_t>> taken_;
  Bounds bounds_;
  double volume_ = 0.0, thickness_ = 0.0;
  std::vector<std::string> account_;
};

}  // namespace whipple::cases
