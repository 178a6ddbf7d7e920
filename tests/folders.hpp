// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// Where the tests find files of the project and its programs. The folders are compiled into one file (tests/folders.cpp):
/// all others are the same in every clone, and the compiler's cache knows them there.
namespace whipple::tests {

/// Returns the root of the source tree.
[[nodiscard]] const std::string& source_folder();

/// Returns the path of a program of the project, e.g. "whipple-md".
[[nodiscard]] std::string program(const std::string& name);

/// Returns the path of a program that belongs to the tests.
[[nodiscard]] std::string test_program(const std::string& name);

}  // namespace whipple::tests
