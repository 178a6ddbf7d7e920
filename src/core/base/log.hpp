// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <filesystem>
#include <string>
#include <utility>

/// Messages to the user on standard error and, once a run directory exists, in its log.txt. Thin over spdlog.
namespace whipple::log {

enum class Level { quiet, normal, verbose };

void set_level(Level level);
/// The level set last; programs that start others pass it on.
[[nodiscard]] Level level();
/// Additionally writes every message to a file, with a time stamp.
void add_file(const std::filesystem::path& path);

/// Writes an error to the files only: the program shows it itself when it ends.
void record_error(const std::string& message);

void write_info(const std::string& message);
void write_warning(const std::string& message);
void write_detail(const std::string& message);

template <class... Args>
void info(fmt::format_string<Args...> format, Args&&... args) {
  write_info(fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void warning(fmt::format_string<Args...> format, Args&&... args) {
  write_warning(fmt::format(format, std::forward<Args>(args)...));
}
/// Shown with --verbose only.
template <class... Args>
void detail(fmt::format_string<Args...> format, Args&&... args) {
  write_detail(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace whipple::log
