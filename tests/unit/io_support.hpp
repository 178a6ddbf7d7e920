// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <random>
#include <string>

#include "src/material/constitutive_catalogue.hpp"
#include "src/particles/particles.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple::io {

/// Particles whose every field holds random bits, NaN and denormal numbers included: nothing may change on
/// the way through a file. Optional fields are in use for odd seeds. Bodies stay small so that tables by body
/// can be given.
inline Particles random_bits(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  Particles particles;
  resize(particles, n);
  for (const HistoryField& field : material::history_fields()) particles.history.add(field);
  for_each_field(particles, [&](const auto& field) {
    auto& values = field.of(particles);
    if (field.optional && seed % 2 == 1) values.resize(n);
    auto* bytes = reinterpret_cast<unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(values[0]); ++i)
      bytes[i] = static_cast<unsigned char>(random());
  });
  for (std::uint32_t& body : particles.body) body %= 3;
  return particles;
}

/// Names of the fields that differ in any bit.
inline std::string differing_fields(const Particles& a, const Particles& b) {
  std::string names;
  for_each_field(a, [&](const auto& field) {
    const auto& x = field.of(a);
    const auto& y = field.of(b);
    if (x.size() != y.size() ||
        (!x.empty() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) != 0)) {
      names += std::string(field.name) + " ";
    }
  });
  return names;
}

}  // namespace whipple::io
