// SPDX-License-Identifier: BSD-3-Clause
#include "src/monitor/site.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"

namespace whipple::monitor {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Compares two texts in constant time, independent of the position of a difference.
bool equal_texts(std::string_view a, std::string_view b) {
  unsigned char different = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    different |=
        static_cast<unsigned char>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  }
  return different == 0;
}

constexpr std::array<std::pair<std::string_view, std::string_view>, 3> types = {
    {{".html", "text/html; charset=utf-8"}, {".js", "text/javascript"}, {".css", "text/css"}}};

}  // namespace

Response text_response(int status, std::string body) {
  return {status, "text/plain; charset=utf-8", std::move(body) + "\n"};
}

Response data_response(const json& body, int status) {
  return {status, "application/json", json_text(body, -1)};
}

Site::Site(Access access, std::vector<PageFiles> files, std::size_t most_body)
    : access_(std::move(access)), files_(std::move(files)), most_body_(most_body) {}

/// Checks the origin of a request. Other pages in the same browser can reach this address, also under another host
/// name; browsers send the origin of the page.
bool Site::is_from_here(const Request& request) const {
  if (request.host != access_.host) return false;
  if (!request.origin.empty() && request.origin != "http://" + access_.host) return false;
  return request.site.empty() || request.site == "same-origin" || request.site == "none";
}

std::string Site::file_of(const std::string& path, std::string& type) const {
  const std::string address = path.size() == 1 ? path + "index.html" : path;
  const auto from =
      std::ranges::find_if(files_, [&](const PageFiles& files) { return address.starts_with(files.prefix); });
  if (from == files_.end()) return {};
  const std::string name = address.substr(from->prefix.size());
  const auto is_plain = [](char letter) {
    return std::islower(static_cast<unsigned char>(letter)) != 0 || letter == '_';
  };
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos || dot == 0 || !std::ranges::all_of(name.substr(0, dot), is_plain)) return {};
  const std::string_view ending = std::string_view(name).substr(dot);
  const auto found = std::ranges::find(types, ending, [](const auto& entry) { return entry.first; });
  const fs::path file = from->folder / name;
  if (found == types.end() || !fs::is_regular_file(file)) return {};
  type = found->second;
  return read_text(file);
}

bool Site::has_key(const Request& request) const { return equal_texts(request.token, access_.token); }

Response Site::handle(const Request& request) {
  if (!is_from_here(request)) return text_response(forbidden, "only the page of this address may ask");
  const std::size_t mark = request.target.find('?');
  const std::string path = request.target.substr(0, mark);
  const std::string query = mark == std::string::npos ? "" : request.target.substr(mark + 1);
  if (!request.changes) {
    std::string type;
    if (std::string file = file_of(path, type); !type.empty()) return {ok, type, std::move(file)};
  }
  if (!has_key(request)) {
    return text_response(unauthorized, "open the address that the program printed: it holds the key");
  }
  try {
    if (!request.changes) return read(path, query);
    if (access_.read_only) return text_response(forbidden, "this page only shows (--read-only)");
    if (request.content_type != "application/json")
      return text_response(unsupported, "expected application/json");
    return change(path, parse_json(request.body));
  } catch (const json::exception& error) {
    return text_response(bad_request, error.what());
  } catch (const InputError& error) {
    return text_response(bad_request, error.what());
  }
}

}  // namespace whipple::monitor
