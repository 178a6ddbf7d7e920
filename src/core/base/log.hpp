// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

/// Messages to the user: on standard error or where the caller wants them, and in the log.txt of a run directory.
namespace whipple::log {

enum class Level { quiet, normal, verbose };

void set_level(Level level);
/// The level set last; programs that start others pass it on.
[[nodiscard]] Level level();
/// Distinguishes messages: what is done, what the user should know of, and what --verbose adds.
enum class Kind { information, warning, detail };
using Sink = std::function<void(Kind, const std::string& message)>;
/// Passes the messages that the level admits to a function, from then on; an empty one: to standard error.
void set_sink(Sink sink);
/// Keeps the warnings that are written while it lives, instead of showing them.
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

/// Also appends every message with a time stamp to a file, instead of the file set before.
void set_file(const std::filesystem::path& path);

/// Writes an error to the file only: the program shows it itself when it ends.
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
