// SPDX-License-Identifier: BSD-3-Clause
// Bodies of voxels: one image in every format and coding, volumes of labels, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <numbers>

#include "src/case/shapes/image.hpp"
#include "src/case/shapes/source_file.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/random_bits.hpp"
#include "tests/unit/folder_test.hpp"
#include "tests/unit/shape_support.hpp"

namespace whipple::cases {
namespace image_test {

constexpr int nx = 20, ny = 24, nz = 28;
const Vector3 spacing(0.5, 0.4, 0.3), first(-2.0, 1.0, 3.0);  // mm

/// A ball of label 3 in a shell of label 7 in air of label 0.
int label_at(int i, int j, int k) {
  const Vector3 x = spacing.cwiseProduct(Vector3(i - 9.5, j - 11.5, k - 13.5));
  return x.norm() < 2.0 ? 3 : x.norm() < 3.5 ? 7 : 0;
}

template <class Number>
std::string values(bool is_big) {
  std::string bytes;
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const auto value = static_cast<Number>(label_at(i, j, k));
        std::string raw(sizeof value, '\0');
        std::memcpy(raw.data(), &value, sizeof value);
        if (is_big) std::reverse(raw.begin(), raw.end());
        bytes += raw;
      }
    }
  }
  return bytes;
}

std::string text_values() {
  std::string text;
  for (const char value : values<char>(false)) text += fmt::format("{} ", static_cast<int>(value));
  return text + "\n";
}

std::string packed(const std::string& bytes, bool is_gzip) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, is_gzip ? 31 : 15, 8, Z_DEFAULT_STRATEGY);
  std::string result(deflateBound(&stream, bytes.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

std::string nrrd(const std::string& type, const std::string& rest) {
  return fmt::format(
      "NRRD0004\n# for a test\ntype: {}\ndimension: 3\nspace: left-posterior-superior\nsizes: {} {} {}\n"
      "space directions: (0.5,0,0) (0,0.4,0) (0,0,0.3)\nkinds: domain domain domain\nspace origin: "
      "(-2,1,3)\n{}\n",
      type, nx, ny, nz, rest);
}

std::string meta(const std::string& rest) {
  return fmt::format(
      "ObjectType = Image\nNDims = 3\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = -2 1 3\nElementSpacing = "
      "0.5 0.4 "
      "0.3\nDimSize = {} {} {}\n{}",
      nx, ny, nz, rest);
}

std::string nifti(bool is_big, bool with_sform) {
  std::string bytes(352, '\0');
  const auto put = [&](std::size_t at, auto value) {
    std::string raw(sizeof value, '\0');
    std::memcpy(raw.data(), &value, sizeof value);
    if (is_big) std::reverse(raw.begin(), raw.end());
    bytes.replace(at, raw.size(), raw);
  };
  put(0, std::int32_t{348});
  const std::array<std::int16_t, 5> dimensions = {4, nx, ny, nz, 1};
  for (std::size_t d = 0; d < dimensions.size(); ++d) put(40 + 2 * d, dimensions[d]);
  put(70, std::int16_t{4});
  put(72, std::int16_t{16});
  put(76, 1.0F);
  for (std::size_t a = 0; a < 3; ++a) put(80 + 4 * a, static_cast<float>(spacing[static_cast<int>(a)]));
  put(108, 352.0F);
  put(112, 1.0F);
  put(with_sform ? 254 : 252, std::int16_t{1});
  for (std::size_t a = 0; a < 3; ++a) {
    const auto at = static_cast<int>(a);
    put(268 + 4 * a, static_cast<float>(first[at]));
    put(280 + 16 * a + 4 * a, static_cast<float>(spacing[at]));
    put(280 + 16 * a + 12, static_cast<float>(first[at]));
  }
  bytes.replace(344, 4, std::string("n+1\0", 4));
  return bytes + values<std::int16_t>(is_big);
}

class Images : public FolderTest {
 protected:
  void write(const std::string& bytes, const char* name = "head") const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  std::unique_ptr<VoxelBody> body(const std::string& bytes, std::vector<double> labels = {3}) const {
    write(bytes);
    ImageKeys keys;
    keys.file = "head";
    keys.unit = 1e-3;
    keys.values = std::move(labels);
    return std::make_unique<VoxelBody>(keys, folder_);
  }
  std::string refusal(const std::string& bytes, const std::vector<double>& labels = {3}) const {
    return message_of<InputError>([&] { body(bytes, labels); });
  }
};

void expect_ball(const VoxelBody& body, const std::string& what) {
  SCOPED_TRACE(what);
  const Vector3 middle = 1e-3 * (first + spacing.cwiseProduct(Vector3(9.5, 11.5, 13.5)));
  EXPECT_NEAR(body.volume(), 4.0 / 3.0 * std::numbers::pi * 8e-9, 0.05 * 3.35e-8);
  long inside = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Vector3 part(uniform(1, 3 * i), uniform(1, 3 * i + 1), uniform(1, 3 * i + 2));
    const Vector3 x = middle + 5e-3 * (part - Vector3::Constant(0.5));
    const bool is_in = body.contains(x);
    inside += is_in ? 1 : 0;
    const Vector3 voxel = (1e3 * x - first).cwiseQuotient(spacing);
    ASSERT_EQ(is_in, label_at(static_cast<int>(std::floor(voxel[0] + 0.5)),
                              static_cast<int>(std::floor(voxel[1] + 0.5)),
                              static_cast<int>(std::floor(voxel[2] + 0.5))) == 3);
  }
  EXPECT_GT(inside, 500);
}

TEST_F(Images, OneBodyFromEveryFormatAndCoding) {
  const std::string little = values<std::int16_t>(false), big = values<std::int16_t>(true);
  expect_ball(*body(nrrd("short", "encoding: raw\nendian: little\n") + little), "NRRD");
  expect_ball(*body(nrrd("short", "encoding: raw\nendian: big\n") + big), "NRRD, big-endian");
  expect_ball(*body(nrrd("uint16", "encoding: gzip\nendian: big\n") + packed(big, true)), "NRRD, gzip");
  expect_ball(*body(nrrd("uchar", "encoding: raw\n") + values<std::uint8_t>(false)), "NRRD, bytes");
  expect_ball(*body(nrrd("int", "encoding: ascii\n") + text_values()), "NRRD, text");
  expect_ball(*body(meta("ElementType = MET_USHORT\nElementDataFile = LOCAL\n") + little), "MetaImage");
  expect_ball(
      *body(meta("BinaryDataByteOrderMSB = True\nElementType = MET_DOUBLE\nElementDataFile = LOCAL\n") +
            values<double>(true)),
      "MetaImage, big-endian");
  expect_ball(*body(meta("CompressedData = True\nElementType = MET_USHORT\nElementDataFile = LOCAL\n") +
                    packed(little, false)),
              "MetaImage, packed");
  for (const bool with_sform : {false, true}) {
    expect_ball(*body(nifti(false, with_sform)), "NIfTI");
    expect_ball(*body(nifti(true, with_sform)), "NIfTI, big-endian");
    expect_ball(*body(packed(nifti(false, with_sform), true)), "NIfTI, gzip");
  }
  write(little, "values.raw");
  expect_ball(*body(meta("ElementType = MET_SHORT\nElementDataFile = values.raw\n")),
              "MetaImage in two files");
}

TEST_F(Images, RawFilesAreDescribedByTheCase) {
  write("12345" + values<float>(true));
  ImageKeys keys;
  keys.file = "head";
  keys.unit = 1e-3;
  keys.values = {3};
  keys.size = {nx, ny, nz};
  keys.described_by = ImageDescription::keys;
  keys.type = solids::VoxelType::float32;
  keys.order = ByteOrder::big_endian;
  keys.skip = 5;
  keys.spacing = spacing;
  keys.offset = 1e-3 * first;
  expect_ball(VoxelBody(keys, folder_), "raw");
  ImageKeys of_header = keys;
  of_header.described_by = ImageDescription::header;
  EXPECT_NE(message_of<InputError>([&] { VoxelBody(of_header, folder_); }).find("described_by"),
            std::string::npos);
  keys.size = {nx, ny, nz + 1};
  EXPECT_NE(message_of<InputError>([&] { VoxelBody(keys, folder_); }).find("the file has 53765"),
            std::string::npos);
}

TEST_F(Images, VolumesOfLabelsAreThoseOfTheirVoxels) {
  const std::string image = nrrd("uchar", "encoding: raw\n") + values<std::uint8_t>(false);
  const std::string bytes = values<std::uint8_t>(false);
  const double voxel = 1e-9 * spacing.prod();
  for (const int label : {3, 7}) {
    const auto count = static_cast<double>(std::ranges::count(bytes, static_cast<char>(label)));
    const auto one = body(image, {static_cast<double>(label)});
    EXPECT_NEAR(one->volume(), count * voxel, 1e-9 * one->volume());
    EXPECT_NEAR(shape_test::counted(*one, shape_test::widened(one->bounds())), one->volume(),
                0.01 * one->volume());
    EXPECT_NE(one->account()[1].find(fmt::format("{} ({:.6g} mm^3)", label, 1e9 * count * voxel)),
              std::string::npos)
        << one->account()[1];
  }
  const auto both = body(image, {1, 9});
  EXPECT_NEAR(both->volume(), body(image, {3})->volume() + body(image, {7})->volume(), 1e-15);
  EXPECT_NEAR(body(image, {7})->smallest_extent(Vector3::UnitX()), 1.3e-3, 0.3e-3);
}

// Points on the faces, edges and corners of voxels, where round-off of boxes of their own would give both labels or none.
TEST_F(Images, EveryPointIsInOneLabelAtMost) {
  write(nrrd("uchar", "encoding: raw\n") + values<std::uint8_t>(false));
  for (const bool smooth : {false, true}) {
    std::vector<VoxelBody> labels;
    for (const double label : {3.0, 7.0}) {
      ImageKeys keys;
      keys.file = "head";
      keys.unit = 1e-3;
      keys.values = {label};
      keys.smooth = smooth;
      labels.emplace_back(keys, folder_);
    }
    long inside = 0, both = 0;
    for (int k = 0; k < 2 * nz; ++k) {
      for (int j = 0; j < 2 * ny; ++j) {
        for (int i = 0; i < 2 * nx; ++i) {
          const Vector3 x = 1e-3 * (first + 0.5 * spacing.cwiseProduct(Vector3(i, j, k)));
          const bool in_ball = labels[0].contains(x), in_shell = labels[1].contains(x);
          inside += in_ball || in_shell ? 1 : 0;
          both += in_ball && in_shell ? 1 : 0;
        }
      }
    }
    EXPECT_EQ(both, 0) << smooth;
    EXPECT_GT(inside, 10000) << smooth;
  }
}

/// A smooth surface errs less than one along the faces of voxels: points of a ball.
TEST_F(Images, SmoothSurfacesLieBetweenVoxels) {
  write(nrrd("uchar", "encoding: raw\n") + values<std::uint8_t>(false));
  const Vector3 middle = 1e-3 * (first + spacing.cwiseProduct(Vector3(9.5, 11.5, 13.5)));
  std::array<long, 2> wrong{};
  for (const bool smooth : {false, true}) {
    ImageKeys keys;
    keys.file = "head";
    keys.unit = 1e-3;
    keys.values = {3};
    keys.smooth = smooth;
    const VoxelBody ball(keys, folder_);
    for (std::uint64_t i = 0; i < 100000; ++i) {
      const Vector3 part(uniform(1, 3 * i), uniform(1, 3 * i + 1), uniform(1, 3 * i + 2));
      const Vector3 x = middle + 5e-3 * (part - Vector3::Constant(0.5));
      wrong[smooth ? 1 : 0] += ball.contains(x) != ((x - middle).norm() < 2e-3) ? 1 : 0;
    }
  }
  std::printf("wrong of 100000: %ld at the faces of voxels, %ld smooth\n", wrong[0], wrong[1]);
  EXPECT_LT(static_cast<double>(wrong[1]), 0.8 * static_cast<double>(wrong[0]));
}

TEST_F(Images, WhatIsNoImageIsRefused) {
  const std::string bytes = values<std::uint8_t>(false);
  EXPECT_NE(refusal("").find("the file is empty"), std::string::npos);
  EXPECT_NE(refusal("GIF89a").find("neither NRRD"), std::string::npos);
  EXPECT_NE(refusal(nrrd("uchar", "encoding: raw\n") + bytes, {5})
                .find("no voxel has a value from 5 to 5;   labels: 0"),
            std::string::npos);
  EXPECT_NE(
      refusal(nrrd("uchar", "encoding: raw\n") + bytes.substr(1)).find("do not fit into its 13439 bytes"),
      std::string::npos);
  EXPECT_NE(refusal(nrrd("uchar", "encoding: bzip2\n") + bytes).find("head:10: encoding \"bzip2\""),
            std::string::npos);
  EXPECT_NE(refusal(nrrd("short", "encoding: raw\n") + bytes).find("no endian"), std::string::npos);
  EXPECT_NE(refusal(nrrd("block", "encoding: raw\n")).find("type \"block\" is not known"), std::string::npos);
  EXPECT_NE(refusal(nrrd("uchar", "encoding: gzip\n") + packed(bytes, true).substr(0, 100))
                .find("damaged or too few"),
            std::string::npos);
  const std::string huge =
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 99999 99999 99999\nencoding: gzip\n\n";
  EXPECT_NE(refusal(huge).find("are no image"), std::string::npos);
  // A header does not make the program read other files.
  EXPECT_NE(
      refusal(meta("ElementType = MET_UCHAR\nElementDataFile = /etc/passwd\n")).find("beside the header"),
      std::string::npos);
  EXPECT_NE(refusal(meta("ElementType = MET_UCHAR\nElementDataFile = ../values\n")).find("beside the header"),
            std::string::npos);
  EXPECT_NE(refusal(meta("ElementType = MET_UCHAR\n")).find("ends before ElementDataFile"),
            std::string::npos);
  std::string flat = nifti(false, true);
  flat.replace(280, 4, std::string(4, '\0'));
  EXPECT_NE(refusal(flat).find("do not span space"), std::string::npos);
}

/// Words of a header that move or scale the body are read, compared with the case, or refused.
TEST_F(Images, WordsOfHeadersCount) {
  const std::string bytes = values<std::uint8_t>(false);
  expect_ball(
      *body(nrrd("UChar", "Encoding: RAW\nspace units: \"mm\" \"mm\" \"mm\"\naxis mins: nan nan nan\n") +
            bytes),
      "capitals, unit of the case");
  EXPECT_NE(refusal(nrrd("uchar", "encoding: raw\naxis mins: 100 0 0\n") + bytes)
                .find("head:11: 'axis mins' is not read"),
            std::string::npos);
  EXPECT_NE(refusal(nrrd("uchar", "encoding: raw\nspace units: \"m\" \"m\" \"m\"\n") + bytes)
                .find("the file states lengths in units of 1 m, 'unit' is 0.001 m"),
            std::string::npos);
  EXPECT_NE(refusal(nrrd("uchar", "encoding: raw\nspace units: \"m\" \"mm\" \"m\"\n") + bytes)
                .find("different units"),
            std::string::npos);
  EXPECT_NE(refusal(nrrd("uchar", "encoding: raw\nspace units: \"ell\" \"ell\" \"ell\"\n") + bytes)
                .find("unit \"ell\" is not known"),
            std::string::npos);
  const std::string head = nrrd("uchar", "encoding: raw\n");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = head;
    text.replace(text.find(from), from.size(), to);
    return refusal(text + bytes);
  };
  EXPECT_NE(changed("sizes: 20 24 28", "sizes: 20 24 28 3").find("'sizes' has more than three"),
            std::string::npos);
  EXPECT_NE(changed("dimension: 3\n", "").find("states no dimension"), std::string::npos);
  EXPECT_NE(changed("(0.5,0,0) (0,0.4,0)", "(0.5,0,0) (0.5,1e-13,0)").find("do not span space"),
            std::string::npos);
  std::string micrometers = nifti(false, true);
  micrometers[123] = 3;
  EXPECT_NE(refusal(micrometers).find("units of 1e-06 m"), std::string::npos);
  micrometers[123] = 2 + 8;  // mm and s
  expect_ball(*body(micrometers), "NIfTI in millimetres");
}

/// A line of values is named as an editor counts it.
TEST_F(Images, LinesOfValuesCountFromTheStartOfTheFile) {
  EXPECT_NE(refusal(nrrd("int", "encoding: ascii\n") + "0 1\n0 x\n" + text_values())
                .find("head:13: expected a number"),
            std::string::npos);
}

TEST_F(Images, RunsKeepBothFiles) {
  write(values<std::int16_t>(false), "values.raw");
  const auto one = body(meta("ElementType = MET_SHORT\nElementDataFile = values.raw\n"));
  keep_sources(*one, folder_ / "run");
  EXPECT_EQ(shape_test::shape_of(one->toml())->toml(), one->toml());
  write(std::string(10, '\1'), "values.raw");
  EXPECT_NE(message_of<InputError>([&] { shape_test::shape_of(one->toml()); }).find("the file has changed"),
            std::string::npos);
  ImageKeys keys;
  keys.file = (folder_ / "head").string();
  keys.unit = 1e-3;
  keys.values = {3};
  keys.digest = one->source()->digest;
  expect_ball(VoxelBody(keys, folder_ / "run"), "kept");
}

}  // namespace image_test
}  // namespace whipple::cases
