// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

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

enum Status {
  ok = 200,
  accepted = 202,
  bad_request = 400,
  unauthorized = 401,
  forbidden = 403,
  not_found = 404,
  conflict = 409,
  unsupported = 415
};

/// Returns a response that is a text for people.
Response text_response(int status, std::string body);
/// Returns a response that is JSON.
Response data_response(const nlohmann::json& body, int status = ok);

/// Holds the access rights: which requests are served, and whether anything may be changed.
struct Access {
  std::string host;   ///< address and port of the server, required as the header field Host
  std::string token;  ///< required as X-Whipple-Token, except for the files of the page
  bool read_only = false;
};

/// Holds a folder with files of the page, and the start of their addresses: "/viewer/".
struct PageFiles {
  std::string prefix;
  std::filesystem::path folder;
};

/// Decides who may ask and serves the files of a page, independently of the network. What is answered beyond that,
/// derived classes decide.
class Site {
 public:
  /// @param files      the folders of the page; of several prefixes that fit, the first one decides
  /// @param most_body  bytes of a request
  Site(Access access, std::vector<PageFiles> files, std::size_t most_body);
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;
  virtual ~Site() = default;

  /// Returns the response to any request, including invalid ones.
  [[nodiscard]] Response handle(const Request& request);
  /// Returns whether a request carries the access token.
  [[nodiscard]] bool has_key(const Request& request) const;
  [[nodiscard]] std::size_t most_body() const { return most_body_; }

 protected:
  /// Answers a request that changes nothing. @throws InputError, json::exception: answered as a bad request
  virtual Response read(const std::string& path, const std::string& query) = 0;
  /// Answers a request with a body.
  virtual Response change(const std::string& path, const nlohmann::json& body) = 0;
  [[nodiscard]] const Access& access() const { return access_; }

 private:
  [[nodiscard]] bool is_from_here(const Request& request) const;
  [[nodiscard]] std::string file_of(const std::string& path, std::string& type) const;

  Access access_;
  std::vector<PageFiles> files_;
  std::size_t most_body_;
};

}  // namespace whipple::monitor
