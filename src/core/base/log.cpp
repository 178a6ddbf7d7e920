// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "src/core/base/last_message.hpp"

namespace whipple::log {
namespace {

Level present_level = Level::normal;
std::string latest;

spdlog::logger& logger() {
  static const std::shared_ptr<spdlog::logger> instance = [] {
    auto sink = std::make_shared<spdlog::sinks::stderr_sink_st>();
    sink->set_pattern("%v");
    auto created = std::make_shared<spdlog::logger>("whipple", sink);
    created->set_level(spdlog::level::debug);
    sink->set_level(spdlog::level::info);
    created->flush_on(spdlog::level::debug);
    return created;
  }();
  return *instance;
}

}  // namespace

void set_level(Level level) {
  present_level = level;
  logger().sinks().front()->set_level(level == Level::quiet     ? spdlog::level::warn
                                      : level == Level::verbose ? spdlog::level::debug
                                                                : spdlog::level::info);
}

Level level() { return present_level; }

void add_file(const std::filesystem::path& path) {
  auto sink = std::make_shared<spdlog::sinks::basic_file_sink_st>(path.string(), false);
  sink->set_pattern("%Y-%m-%d %H:%M:%S %l: %v");
  logger().sinks().push_back(std::move(sink));
}

void record_error(const std::string& message) {
  latest = message;
  const auto& sinks = logger().sinks();
  for (std::size_t i = 1; i < sinks.size(); ++i) {
    sinks[i]->log({"whipple", spdlog::level::err, message});
    sinks[i]->flush();
  }
}

void write_info(const std::string& message) {
  latest = message;
  logger().info(message);
}
void write_warning(const std::string& message) {
  latest = message;
  logger().warn("warning: {}", message);
}
void write_detail(const std::string& message) { logger().debug(message); }

const std::string& last_message() { return latest; }

}  // namespace whipple::log
