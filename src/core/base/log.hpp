// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

/// Messages to the user: to standard error or a sink of the caller, and to log.txt of a run directory.
namespace whipple::log {

enum class Level { quiet, normal, verbose };

void set_level(Level level);
/// Returns the current level; programs that start others pass it on.
[[nodiscard]] Level level();
/// Distinguishes messages: information, warnings, and details shown with --verbose.
enum class Kind { information, warning, detail };
using Sink = std::function<void(Kind, const std::string& message)>;
/// Redirects the messages shown at the current level to a function; an empty function restores standard error.
void set_sink(Sink sink);
/// Collects the warnings issued during its lifetime instead of showing them.
class WarningsAside {
 public:
  WarningsAside();
  ~WarningsAside();
  WarningsAside(const WarningsAside&) = delete;
  WarningsAside& operator=(const WarningsAside&) = delete;
  [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
  std::vector<std::string>* outer_;
};

/// Appends every message with a time stamp to a file as well, replacing the previously set file.
void set_file(const std::filesystem::path& path);

/// Writes an error to the file only: the program shows it on exit.
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
/// Writes a message that is shown with --verbose only.
template <class... Args>
void detail(fmt::format_string<Args...> format, Args&&... args) {
  write_detail(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace whipple::log
