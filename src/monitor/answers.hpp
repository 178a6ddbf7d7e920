// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "src/monitor/folder.hpp"

namespace whipple::monitor {

/// A request of a browser, as far as an answer depends on it. Empty texts: the head is missing.
struct Question {
  bool changes = false;  ///< POST; else GET
  std::string target;    ///< path and query
  std::string host, origin, site, token, content_type, body;
};

/// The answer to it.
struct Answer {
  int status = 200;  ///< of HTTP
  std::string type = "application/json";
  std::string body;
};

/// Who may ask, and what may be changed.
struct Access {
  std::string host;   ///< address and port of the server: what the head Host must be
  std::string token;  ///< what the head X-Whipple-Token must be, but for the files of the page
  bool read_only = false;
};

/// Starts a run in the background: the arguments of `whipple run`.
using Start = std::function<void(const std::vector<std::string>& arguments)>;

/// Answers the questions of the page (docs/manual/monitor.md). Without a network: the server hands questions over.
class Desk {
 public:
  /// @param page   folder of the page's files
  /// @param view   folder of the viewer's modules
  /// @param cases  folder whose sub-folders with a case.toml can be started; empty: none
  Desk(Folder folder, Access access, std::filesystem::path page, std::filesystem::path view,
       std::filesystem::path cases, Start start);

  /// Answers whatever is asked; errors are answers too.
  [[nodiscard]] Answer answer(const Question& question);
  /// Returns whether the page asks that has the key.
  [[nodiscard]] bool has_key(const Question& question) const;

 private:
  [[nodiscard]] bool is_from_here(const Question& question) const;
  [[nodiscard]] std::string file_of(const std::string& path, std::string& type) const;
  [[nodiscard]] Answer read(const std::string& path, const std::string& query);
  [[nodiscard]] Answer change(const std::string& path, const nlohmann::json& wish);
  [[nodiscard]] Answer steer(const nlohmann::json& wish);
  [[nodiscard]] Answer resume(const nlohmann::json& wish);
  [[nodiscard]] Answer begin(const nlohmann::json& wish);
  [[nodiscard]] std::vector<std::string> cases() const;

  Folder folder_;
  Access access_;
  std::filesystem::path page_, view_, cases_;
  Start start_;
};

}  // namespace whipple::monitor
