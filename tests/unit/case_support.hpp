// SPDX-License-Identifier: BSD-3-Clause
// Texts of cases that the tests of the set-up change and read.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "src/case/case.hpp"
#include "src/core/base/error.hpp"

namespace whipple::cases {

inline const std::string domain = R"(
[domain]
lower = ["0 mm", "0 mm", "-10 mm"]
upper = ["12 mm", "12 mm", "20 mm"]
cell_size = "1 mm"
boundary = { x_lower = "symmetry", y_lower = "symmetry" }
[time]
end = "4 us"
)";
inline const std::string sphere = R"(
[[body]]
name = "sphere"
material = "copper.toml"
velocity = ["0 m/s", "0 m/s", "5.55 km/s"]
shape = { sphere = { center = ["0 mm", "0 mm", "-4 mm"], radius = "3 mm" } }
)";

inline std::string error_of(const std::string& text) {
  try {
    read_case_text(text, "case.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline void expect_error(const std::string& text, const std::vector<std::string>& parts) {
  const std::string error = error_of(text);
  for (const std::string& part : parts)
    EXPECT_NE(error.find(part), std::string::npos) << "missing: " << part << "\nin: " << error;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

}  // namespace whipple::cases
