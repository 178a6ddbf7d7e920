// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/shapes/image.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "src/case/shapes/combination.hpp"
#include "src/case/shapes/primitive.hpp"
#include "src/case/shapes/source_file.hpp"
#include "src/core/base/text.hpp"

namespace whipple::cases {
namespace {

bool is_whole(double value) { return value == std::floor(value); }

/// Describes a file without header by the keys of the case.
solids::ImageHeader raw_header(const ImageKeys& keys) {
  solids::ImageHeader header;
  if (keys.size.size() != 3) throw InputError("'size' has three numbers of voxels");
  for (std::size_t a = 0; a < 3; ++a) {
    constexpr double most = 1e6;
    if (!(keys.size[a] >= 1.0 && keys.size[a] <= most && is_whole(keys.size[a])))
      throw InputError("'size' has three whole numbers from 1 to 1e6");
    header.size[a] = static_cast<std::uint64_t>(keys.size[a]);
  }
  header.type = keys.type;
  header.order = keys.order == ByteOrder::big_endian ? std::endian::big : std::endian::little;
  header.begin = static_cast<std::size_t>(keys.skip);
  header.steps = keys.spacing.asDiagonal();
  return header;
}

/// @throws InputError if keys of raw files are given for a file whose header says the same
void refuse_raw_keys(const ImageKeys& keys) {
  const ImageKeys defaults;
  if (keys.size.empty() && keys.type == defaults.type && keys.order == defaults.order &&
      keys.skip == defaults.skip && keys.spacing == defaults.spacing)
    return;
  throw InputError(
      "'size', 'type', 'byte_order', 'skip' and 'spacing' describe a raw file: described_by = \"case\"");
}

}  // namespace

ParameterTable<ImageKeys> ImageKeys::parameters() {
  using K = ImageKeys;
  return {text("file", &K::file, "NRRD, MetaImage, NIfTI-1 or raw, relative to the case file"),
          real("unit", &K::unit, "m", range::positive(), "length of one unit of the file: \"1 mm\""),
          real_list("values", &K::values, "", range::any(),
                    "label of the body, [3], or the least and the greatest value of its voxels, [200, 3000]"),
          boolean("smooth", &K::smooth,
                  "the surface lies where half of the voxels around, weighted linearly, are of the body; "
                  "otherwise on "
                  "the faces of voxels")
              .optional(),
          vector("offset", &K::offset, "m", range::any(), "added to the places of the file").optional(),
          choice("described_by", &K::described_by,
                 "the header of the file, or, of a raw file, the case by the following keys")
              .optional(),
          real_list("size", &K::size, "", range::any(),
                    "of raw files: voxels along the axes, the fastest one first")
              .optional(),
          choice("type", &K::type, "of raw files: type of the values").optional(),
          choice("byte_order", &K::order, "of raw files: order of the bytes of a value").optional(),
          integer("skip", &K::skip, range::between(0, 1e15), "of raw files: bytes before the first value")
              .optional(),
          vector("spacing", &K::spacing, "", range::positive(),
                 "of raw files: edges of a voxel, in units of the file")
              .optional(),
          text("digest", &K::digest, "SHA-256 that the file must have; runs write it").optional()};
}

VoxelBody::VoxelBody(ImageKeys keys, const std::filesystem::path& folder) : keys_(std::move(keys)) {
  if (keys_.values.empty() || keys_.values.size() > 2)
    throw InputError("'values' is [LABEL] or [LEAST, GREATEST]");
  const bool is_raw = keys_.described_by == ImageDescription::keys;
  if (!is_raw) refuse_raw_keys(keys_);
  source_ = find_source(keys_.file, keys_.digest, folder, is_raw ? nullptr : &solids::Image::companion);
  keys_.file = named_file(keys_.file, folder).string();
  keys_.digest = source_.digest;
  const solids::Image image =
      is_raw ? solids::Image::read_raw(source_.path, raw_header(keys_)) : solids::Image::read(source_.path);
  if (const auto unit = image.header().unit; unit && std::abs(*unit / keys_.unit - 1.0) > 1e-6) {
    throw InputError(fmt::format("{}: the file states lengths in units of {} m, 'unit' is {} m",
                                 utf8(source_.path.string()), *unit, keys_.unit));
  }
  take(image);
  describe_labels(image);
  if (keys_.smooth) volume_ = counted_volume(*this);
  measure_thickness();
  account_.push_back(
      fmt::format("  of these {:.6g} mm^3; thinnest part {:.3g} mm", 1e9 * volume_, 1e3 * thickness_));
}

void VoxelBody::take(const solids::Image& image) {
  const solids::ImageHeader& header = image.header();
  const Eigen::Array3i size(static_cast<int>(header.size[0]), static_cast<int>(header.size[1]),
                            static_cast<int>(header.size[2]));
  const double least = keys_.values.front(), greatest = keys_.values.back();
  const auto for_each_voxel = [&](auto&& f) {
    std::uint64_t voxel = 0;
    for (int k = 0; k < size[2]; ++k) {
      for (int j = 0; j < size[1]; ++j) {
        for (int i = 0; i < size[0]; ++i, ++voxel) {
          const double value = image.value(voxel);
          if (value >= least && value <= greatest) f(Eigen::Array3i(i, j, k));
        }
      }
    }
  };
  Eigen::Array3i from = size, to = Eigen::Array3i::Constant(-1);
  std::size_t count = 0;
  for_each_voxel([&](const Eigen::Array3i& voxel) {
    from = from.min(voxel);
    to = to.max(voxel);
    ++count;
  });
  if (count == 0) {
    describe_labels(image);
    throw InputError(fmt::format("{}: no voxel has a value from {} to {}; {}", utf8(source_.path.string()),
                                 least, greatest, account_.back()));
  }
  first_ = from;
  size_ = to - from + 1;
  steps_ = keys_.unit * header.steps;
  to_voxels_ = steps_.inverse();
  origin_ = keys_.unit * header.origin + keys_.offset;
  std::vector<std::uint8_t> taken(static_cast<std::size_t>(size_.cast<std::int64_t>().prod()), 0);
  for_each_voxel([&](const Eigen::Array3i& voxel) { taken[index(voxel - from)] = 1; });
  taken_ = std::make_shared<const std::vector<std::uint8_t>>(std::move(taken));
  volume_ = static_cast<double>(count) * std::abs(steps_.determinant());
  const Vector3 middle = origin_ + steps_ * (0.5 * (from + to).cast<double>()).matrix();
  const Vector3 reach = steps_.cwiseAbs() * (0.5 * size_.cast<double>()).matrix();
  bounds_ = {middle - reach, middle + reach};
}

void VoxelBody::describe_labels(const solids::Image& image) {
  const solids::ImageHeader& header = image.header();
  constexpr std::size_t most_labels = 256, most_named = 40;
  std::map<double, std::uint64_t> labels;
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  bool are_labels = true;
  for (std::uint64_t voxel = 0; voxel < header.count(); ++voxel) {
    const double value = image.value(voxel);
    least = std::min(least, value);
    greatest = std::max(greatest, value);
    if (are_labels) ++labels[value];
    are_labels = are_labels && is_whole(value) && labels.size() <= most_labels;
  }
  account_ = {fmt::format("image {}: {} x {} x {} voxels, SHA-256 {}", source_.path.filename().string(),
                          header.size[0], header.size[1], header.size[2], source_.digest)};
  if (!are_labels) {
    account_.push_back(fmt::format("  values from {:.6g} to {:.6g}", least, greatest));
    return;
  }
  const double voxel_volume = std::abs(header.steps.determinant()) * std::pow(keys_.unit, 3);
  std::string text;
  for (const auto& [label, count] : labels) {
    if (text.size() > 20 * most_named) {
      text += ", ...";
      break;
    }
    text += fmt::format("{}{} ({:.6g} mm^3)", text.empty() ? "" : ", ", label,
                        1e9 * voxel_volume * static_cast<double>(count));
  }
  account_.push_back("  labels: " + text);
}

std::size_t VoxelBody::index(const Eigen::Array3i& voxel) const {
  const Eigen::Array<std::size_t, 3, 1> n = size_.cast<std::size_t>(), v = voxel.cast<std::size_t>();
  return v[0] + n[0] * (v[1] + n[1] * v[2]);
}

bool VoxelBody::is_taken(const Eigen::Array3i& voxel) const {
  const Eigen::Array3i at = voxel - first_;
  return (at >= 0).all() && (at < size_).all() && (*taken_)[index(at)] != 0;
}

bool VoxelBody::contains(const Vector3& point) const {
  if ((point.array() < bounds_.lower.array()).any() || (point.array() > bounds_.upper.array()).any())
    return false;
  const Eigen::Array3d place = (to_voxels_ * (point - origin_)).array();
  if (!keys_.smooth) return is_taken((place + 0.5).floor().cast<int>());
  const Eigen::Array3d floor = place.floor(), part = place - floor;
  const Eigen::Array3i corner = floor.cast<int>();
  double occupied = 0.0;
  for (int octant = 0; octant < 8; ++octant) {
    const Eigen::Array3i shift(octant & 1, (octant >> 1) & 1, octant >> 2);
    if (is_taken(corner + shift)) occupied += (shift == 1).select(part, 1.0 - part).prod();
  }
  constexpr double half = 0.5 + 1e-9;  // round-off gives no point to two labels
  return occupied > half;
}

void VoxelBody::measure_thickness() {
  // The length of the run of voxels along each axis, the shortest of the three.
  std::vector<double> shortest(taken_->size(), std::numeric_limits<double>::infinity());
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    const double step = steps_.col(a).norm();
    Eigen::Array3i at;
    for (at[b] = 0; at[b] < size_[b]; ++at[b]) {
      for (at[c] = 0; at[c] < size_[c]; ++at[c]) {
        for (int i = 0, end = 0; i < size_[a]; i = std::max(end, i + 1)) {
          at[a] = i;
          if (!is_taken(first_ + at)) continue;
          for (end = i; end < size_[a]; ++end) {
            at[a] = end;
            if (!is_taken(first_ + at)) break;
          }
          for (at[a] = i; at[a] < end; ++at[a]) {
            double& length = shortest[index(at)];
            length = std::min(length, step * (end - i));
          }
        }
      }
    }
  }
  std::erase_if(shortest, [](double length) { return !std::isfinite(length); });
  const auto rank = static_cast<std::ptrdiff_t>(shortest.size() / 100);
  std::ranges::nth_element(shortest, shortest.begin() + rank);
  thickness_ = shortest[static_cast<std::size_t>(rank)];
}

std::string VoxelBody::toml() const { return shape_as_toml(keys_); }

}  // namespace whipple::cases
