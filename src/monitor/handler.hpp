// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "src/monitor/folder.hpp"

namespace whipple::monitor {

/// Holds the parts of an HTTP request that determine its response. Empty texts: the header field is missing.
struct Request {
  bool changes = false;  ///< POST; otherwise GET
  std::string target;    ///< path and query
  std::string host, origin, site, token, content_type, body;
};

/// Holds an HTTP response.
struct Response {
  int status = 200;
  std::string type = "application/json";
  std::string body;
};

/// Holds the access rights: which requests are served, and whether runs may be changed.
struct Access {
  std::string host;   ///< address and port of the server, required as the header field Host
  std::string token;  ///< required as X-Whipple-Token, except for the files of the page
  bool read_only = false;
};

/// Starts a run in the background with the arguments of `whipple run`.
using Start = std::function<void(const std::vector<std::string>& arguments)>;

/// Handles the requests of the page (docs/manual/monitor.md), independently of the network.
class Handler {
 public:
  /// @param page   folder of the page's files
  /// @param view   folder of the viewer's modules
  /// @param cases  folder of the cases that can be started: sub-folders with a case.toml; empty: none
  Handler(Folder folder, Access access, std::filesystem::path page, std::filesystem::path view,
          std::filesystem::path cases, Start start);

  /// Returns the response to any request, including invalid ones.
  [[nodiscard]] Response handle(const Request& request);
  /// Returns whether a request carries the access token.
  [[nodiscard]] bool has_key(const Request& request) const;

 private:
  [[nodiscard]] bool is_from_here(const Request& request) const;
  [[nodiscard]] std::string file_of(const std::string& path, std::string& type) const;
  [[nodiscard]] Response read(const std::string& path, const std::string& query);
  [[nodiscard]] Response change(const std::string& path, const nlohmann::json& body);
  [[nodiscard]] Response steer(const nlohmann::json& body);
  [[nodiscard]] Response resume(const nlohmann::json& body);
  [[nodiscard]] Response begin(const nlohmann::json& body);
  [[nodiscard]] std::vector<std::string> cases() const;

  Folder folder_;
  Access access_;
  std::filesystem::path page_, view_, cases_;
  Start start_;
};

}  // namespace whipple::monitor
