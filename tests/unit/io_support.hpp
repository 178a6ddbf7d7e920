// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>

#include "src/particles/particles.hpp"

namespace whipple::io {

/// A folder of its own for every test, removed afterwards.
class FolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        std::filesystem::temp_directory_path() / (std::string("whipple_io_") + info->test_suite_name() + "_" +
                                                  info->name() + "_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

/// Particles whose every field holds random bits, NaN and denormal numbers included: nothing may change on
/// the way through a file. Bodies stay small so that tables by body can be given.
inline Particles random_bits(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  Particles particles;
  resize(particles, n);
  for_each_field<Particles>([&](const auto& field) {
    auto& values = particles.*(field.values);
    auto* bytes = reinterpret_cast<unsigned char*>(values.data());
    for (std::size_t i = 0; i < n * sizeof(values[0]); ++i) bytes[i] = static_cast<unsigned char>(random());
  });
  for (std::uint32_t& body : particles.body) body %= 3;
  return particles;
}

/// Names of the fields that differ in any bit.
inline std::string differing_fields(const Particles& a, const Particles& b) {
  std::string names;
  for_each_field<Particles>([&](const auto& field) {
    const auto& x = a.*(field.values);
    const auto& y = b.*(field.values);
    if (x.size() != y.size() ||
        (!x.empty() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) != 0)) {
      names += std::string(field.name) + " ";
    }
  });
  return names;
}

/// The message of the exception of type Error that `work` throws; a test failure if it throws none.
template <class Error, class Work>
std::string message_of(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no exception of the expected type";
  return "";
}

}  // namespace whipple::io
