// SPDX-License-Identifier: BSD-3-Clause
#include "src/solids/image.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fstream>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/text.hpp"
#include "src/solids/bytes.hpp"
#include "src/solids/fields.hpp"

namespace whipple::solids {
namespace {

/// The most that zlib packs into a byte, with margin for short streams.
constexpr std::uint64_t most_ratio = 1100, margin = 65536;

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

bool is_nifti(std::string_view bytes) {
  return bytes.size() >= 348 && (bytes.substr(344, 3) == "n+1" || bytes.substr(344, 3) == "ni1");
}

/// Checks sizes before memory is taken. @param available  bytes of the values as stored
void require_size(const ImageHeader& header, std::size_t available, const std::string& file) {
  constexpr double most = 1e11;
  double count = 1.0;
  for (const std::uint64_t n : header.size) count *= static_cast<double>(n);
  const auto described = fmt::format("{}: {} x {} x {} voxels of {} bytes", file, header.size[0],
                                     header.size[1], header.size[2], bytes_of(header.type));
  if (!(count > 0.0) || count > most || std::ranges::max(header.size) > 1000000)
    throw InputError(described + " are no image");
  const double needed =
      count * (header.packing == Packing::text ? 2.0 : static_cast<double>(bytes_of(header.type)));
  const bool is_packed = header.packing == Packing::gzip || header.is_packed_whole;
  const double possible =
      is_packed ? static_cast<double>(most_ratio * (available + margin))
                : static_cast<double>(available) + (header.packing == Packing::text ? 1.0 : 0.0);
  if (needed > possible)
    throw InputError(fmt::format("{} do not fit into its {} bytes", described, available));
  constexpr double flat = 1e-6;  // volume of a voxel in parts of the product of its edges
  if (!header.origin.allFinite() || !header.steps.allFinite() ||
      !(std::abs(header.steps.determinant()) > flat * header.steps.colwise().norm().prod())) {
    throw InputError(fmt::format("{}: the steps between voxels do not span space", file));
  }
}

ImageHeader read_header(std::string_view bytes, const std::string& file) {
  if (bytes.empty()) throw InputError(fmt::format("{}: the file is empty", file));
  if (bytes.starts_with("NRRD")) return read_nrrd_header(bytes, file);
  if (is_nifti(bytes)) return read_nifti_header(bytes, file);
  if (bytes.substr(0, 4000).find("ElementDataFile") != std::string_view::npos ||
      bytes.substr(0, 4000).find("ObjectType") != std::string_view::npos) {
    return read_meta_image_header(bytes, file);
  }
  if (is_gzip(bytes)) {
    constexpr std::uint64_t nifti_bytes = 352;
    const std::string head = unpacked(bytes, nifti_bytes, file);
    if (is_nifti(head)) {
      ImageHeader header = read_nifti_header(head, file);
      header.is_packed_whole = true;
      return header;
    }
  }
  throw InputError(
      fmt::format("{}: neither NRRD, MetaImage nor NIfTI-1; give 'size' and 'type' of a raw file", file));
}

}  // namespace

std::size_t bytes_of(VoxelType type) {
  switch (type) {
    case VoxelType::int8:
    case VoxelType::uint8:
      return 1;
    case VoxelType::int16:
    case VoxelType::uint16:
      return 2;
    case VoxelType::int32:
    case VoxelType::uint32:
    case VoxelType::float32:
      return 4;
    case VoxelType::float64:
      return 8;
  }
  return 8;
}

double Image::value(std::uint64_t voxel) const {
  const std::size_t at = voxel * bytes_of(header_.type);
  const auto stored = [&] {
    switch (header_.type) {
      case VoxelType::int8:
        return static_cast<double>(number_at<std::int8_t>(values_, at));
      case VoxelType::uint8:
        return static_cast<double>(number_at<std::uint8_t>(values_, at));
      case VoxelType::int16:
        return static_cast<double>(number_at<std::int16_t>(values_, at, header_.order));
      case VoxelType::uint16:
        return static_cast<double>(number_at<std::uint16_t>(values_, at, header_.order));
      case VoxelType::int32:
        return static_cast<double>(number_at<std::int32_t>(values_, at, header_.order));
      case VoxelType::uint32:
        return static_cast<double>(number_at<std::uint32_t>(values_, at, header_.order));
      case VoxelType::float32:
        return static_cast<double>(number_at<float>(values_, at, header_.order));
      case VoxelType::float64:
        return number_at<double>(values_, at, header_.order);
    }
    return 0.0;
  };
  return header_.intercept + header_.slope * stored();
}

Image Image::with_values(const ImageHeader& header, std::string_view bytes, const std::string& file) {
  if (header.begin > bytes.size() && !header.is_packed_whole) {
    throw InputError(fmt::format("{}: the file ends before its values", file));
  }
  const std::size_t begin = header.is_packed_whole ? 0 : header.begin;
  const std::string_view stored = bytes.substr(begin);
  require_size(header, stored.size(), file);
  const std::uint64_t needed = header.count() * bytes_of(header.type);
  if (header.is_packed_whole) {
    const std::string whole = unpacked(stored, header.begin + needed, file);
    return {header, whole.substr(header.begin)};
  }
  if (header.packing == Packing::gzip) return {header, unpacked(stored, needed, file)};
  if (header.packing == Packing::raw) return {header, std::string(stored.substr(0, needed))};
  ImageHeader as_numbers = header;
  as_numbers.type = VoxelType::float64;
  as_numbers.order = std::endian::native;
  std::string values;
  Fields fields(stored, file, static_cast<std::size_t>(std::ranges::count(bytes.substr(0, begin), '\n')));
  for (std::uint64_t voxel = 0; voxel < header.count();) {
    if (!fields.next_line())
      throw InputError(fmt::format("{}: {} values, expected {}", file, voxel, header.count()));
    for (std::string_view word = fields.word(); !word.empty() && voxel < header.count();
         word = fields.word()) {
      const auto value = Fields::parsed<double>(word);
      if (!value) fields.fail(fmt::format("expected a number instead of \"{}\"", shown(word)));
      const auto raw = std::bit_cast<std::array<char, 8>>(*value);
      values.append(raw.data(), raw.size());
      ++voxel;
    }
  }
  return {as_numbers, std::move(values)};
}

Image Image::read(const std::filesystem::path& path) {
  const std::string bytes = read_text(path), file = utf8(path.string());
  const ImageHeader header = read_header(bytes, file);
  if (header.data.empty()) return with_values(header, bytes, file);
  const std::filesystem::path data = path.parent_path() / header.data;
  return with_values(header, read_text(data), utf8(data.string()));
}

Image Image::read_raw(const std::filesystem::path& path, const ImageHeader& header) {
  const std::string bytes = read_text(path), file = utf8(path.string());
  ImageHeader packed = header;
  packed.is_packed_whole = is_gzip(bytes);
  if (!packed.is_packed_whole && bytes.size() >= header.begin &&
      bytes.size() - header.begin != header.count() * bytes_of(header.type)) {
    throw InputError(
        fmt::format("{}: {} x {} x {} voxels of {} bytes after {} bytes take {} bytes; the file has {}", file,
                    header.size[0], header.size[1], header.size[2], bytes_of(header.type), header.begin,
                    header.begin + header.count() * bytes_of(header.type), bytes.size()));
  }
  return with_values(packed, bytes, file);
}

std::filesystem::path Image::companion(const std::filesystem::path& path) {
  return read_header(read_text(path), utf8(path.string())).data;
}

std::string unpacked(std::string_view bytes, std::uint64_t size, const std::string& file) {
  const auto damaged = [&] {
    throw InputError(fmt::format("{}: the packed values are damaged or too few", file));
  };
  if (size > most_ratio * (bytes.size() + margin)) damaged();
  std::string result;
  z_stream stream{};
  constexpr int either = 32 + MAX_WBITS;  // gzip or zlib by its header
  if (inflateInit2(&stream, either) != Z_OK) throw InputError(fmt::format("{}: zlib does not start", file));
  std::size_t taken = 0, made = 0;
  int state = Z_OK;
  constexpr std::size_t portion = std::size_t{1} << 30U;  // zlib counts in 32 bits
  constexpr std::size_t step = std::size_t{1} << 20U;
  while (state == Z_OK && made < size && taken < bytes.size()) {
    // Memory is taken as it is filled: a damaged file of 1 MB may claim to hold 1 GB.
    if (made == result.size()) result.resize(std::min<std::uint64_t>(size, made + std::max(made, step)));
    const std::size_t in = std::min(portion, bytes.size() - taken),
                      out = std::min(portion, result.size() - made);
    // zlib does not write to its input, but its interface is not const.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + taken));  // NOLINT
    stream.avail_in = static_cast<uInt>(in);
    stream.next_out = reinterpret_cast<Bytef*>(result.data() + made);  // NOLINT
    stream.avail_out = static_cast<uInt>(out);
    state = inflate(&stream, Z_NO_FLUSH);
    taken += in - stream.avail_in;
    made += out - stream.avail_out;
  }
  inflateEnd(&stream);
  if (made < size) damaged();
  return result;
}

std::filesystem::path beside(std::string_view name, const std::string& file) {
  const std::filesystem::path path{std::string(name)};
  if (path.empty() || path != path.filename() || name == "." || name == "..") {
    throw InputError(
        fmt::format("{}: the values are in \"{}\"; expected a file beside the header", file, shown(name)));
  }
  return path;
}

}  // namespace whipple::solids
