// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>

#include <cstdio>
#include <memory>
#include <utility>

#include "src/core/base/last_message.hpp"

namespace whipple::log {
namespace {

void write_to_standard_error(Kind kind, const std::string& message) {
  std::fprintf(stderr, "%s%s\n", kind == Kind::warning ? "warning: " : "", message.c_str());
}

Level present_level = Level::normal;
Sink shown = write_to_standard_error;
std::shared_ptr<spdlog::sinks::sink> file;
std::string latest;
std::vector<std::string>* aside = nullptr;

void write_to_file(spdlog::level::level_enum level, const std::string& message) {
  if (!file) return;
  file->log({"whipple", level, message});
  file->flush();
}

bool is_shown(Kind kind) {
  return kind == Kind::warning || present_level == Level::verbose ||
         (kind == Kind::information && present_level == Level::normal);
}

void show(Kind kind, const std::string& message) {
  if (is_shown(kind)) shown(kind, message);
}

}  // namespace

void set_level(Level level) { present_level = level; }

Level level() { return present_level; }

void set_sink(Sink sink) { shown = sink ? std::move(sink) : write_to_standard_error; }

WarningsAside::WarningsAside() : outer_(std::exchange(aside, &messages_)) {}
WarningsAside::~WarningsAside() { aside = outer_; }

void set_file(const std::filesystem::path& path) {
  file = std::make_shared<spdlog::sinks::basic_file_sink_st>(path.string(), false);
  file->set_pattern("%Y-%m-%d %H:%M:%S %l: %v");
}

void record_error(const std::string& message) {
  latest = message;
  write_to_file(spdlog::level::err, message);
}

void write_info(const std::string& message) {
  latest = message;
  show(Kind::information, message);
  write_to_file(spdlog::level::info, message);
}
void write_warning(const std::string& message) {
  if (aside) {
    aside->push_back(message);
    return;
  }
  latest = message;
  show(Kind::warning, message);
  write_to_file(spdlog::level::warn, message);  // the pattern of the file names the level
}
void write_detail(const std::string& message) {
  show(Kind::detail, message);
  write_to_file(spdlog::level::debug, message);
}

const std::string& last_message() { return latest; }

}  // namespace whipple::log
