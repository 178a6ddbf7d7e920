// SPDX-License-Identifier: BSD-3-Clause
#include "src/monitor/handler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
#include "src/io/run_directory.hpp"
#include "src/run/directory_control.hpp"
#include "src/run/status.hpp"

namespace whipple::monitor {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

enum Status {
  ok = 200,
  accepted = 202,
  bad_request = 400,
  unauthorized = 401,
  forbidden = 403,
  not_found = 404,
  unsupported = 415
};

Response text(int status, std::string body) {
  return {status, "text/plain; charset=utf-8", std::move(body) + "\n"};
}
Response data(const json& body, int status = ok) { return {status, "application/json", json_text(body, -1)}; }

/// Compares two texts in constant time, independent of the position of a difference.
bool equal_texts(std::string_view a, std::string_view b) {
  unsigned char different = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    different |=
        static_cast<unsigned char>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  }
  return different == 0;
}

/// Decodes %20 and + in a query.
std::string decoded(std::string_view coded) {
  std::string plain;
  for (std::size_t i = 0; i < coded.size(); ++i) {
    if (coded[i] == '%' && i + 2 < coded.size()) {
      const std::string digits(coded.substr(i + 1, 2));
      char* end = nullptr;
      const long code = std::strtol(digits.c_str(), &end, 16);
      if (*end == '\0') {
        plain += static_cast<char>(code);
        i += 2;
        continue;
      }
    }
    plain += coded[i] == '+' ? ' ' : coded[i];
  }
  return plain;
}

/// Holds the keys of a query; a repeated key has several values.
class Query {
 public:
  explicit Query(std::string_view query) {
    while (!query.empty()) {
      const std::string_view part = query.substr(0, query.find('&'));
      query.remove_prefix(std::min(part.size() + 1, query.size()));
      const std::size_t equals = part.find('=');
      const std::string_view value =
          equals == std::string_view::npos ? std::string_view() : part.substr(equals + 1);
      values_[decoded(part.substr(0, equals))].push_back(decoded(value));
    }
  }
  [[nodiscard]] std::string one(const std::string& key) const {
    const auto found = values_.find(key);
    if (found == values_.end()) throw InputError(fmt::format("the query needs \"{}\"", key));
    return found->second.front();
  }
  [[nodiscard]] std::vector<std::string> all(const std::string& key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? std::vector<std::string>() : found->second;
  }
  [[nodiscard]] std::size_t number(const std::string& key) const {
    const std::string digits = one(key);
    if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos) {
      throw InputError(fmt::format("\"{}\" of the query is no whole number", key));
    }
    return std::stoul(digits);
  }

 private:
  std::map<std::string, std::vector<std::string>> values_;
};

std::string text_of(const json& body, const char* key) { return body.at(key).get<std::string>(); }

constexpr std::array<std::pair<std::string_view, std::string_view>, 3> types = {
    {{".html", "text/html; charset=utf-8"}, {".js", "text/javascript"}, {".css", "text/css"}}};

}  // namespace

Handler::Handler(Folder folder, Access access, fs::path page, fs::path view, fs::path cases, Start start)
    : folder_(std::move(folder)),
      access_(std::move(access)),
      page_(std::move(page)),
      view_(std::move(view)),
      cases_(std::move(cases)),
      start_(std::move(start)) {}

/// Checks the origin of a request. Other pages in the same browser can reach this address, also under another host
/// name; browsers send the origin of the page.
bool Handler::is_from_here(const Request& request) const {
  if (request.host != access_.host) return false;
  if (!request.origin.empty() && request.origin != "http://" + access_.host) return false;
  return request.site.empty() || request.site == "same-origin" || request.site == "none";
}

std::string Handler::file_of(const std::string& path, std::string& type) const {
  if (!path.starts_with('/')) return {};
  const std::string name = path.size() == 1 ? "/index.html" : path;
  const bool of_view = name.starts_with("/viewer/");
  const std::string own = name.substr(of_view ? 8 : 1);
  const auto is_plain = [](char letter) {
    return std::islower(static_cast<unsigned char>(letter)) != 0 || letter == '_';
  };
  const std::size_t dot = own.find('.');
  if (dot == std::string::npos || dot == 0 || !std::ranges::all_of(own.substr(0, dot), is_plain)) return {};
  const std::string_view ending = std::string_view(own).substr(dot);
  const auto found = std::ranges::find(types, ending, [](const auto& entry) { return entry.first; });
  const fs::path file = (of_view ? view_ : page_) / own;
  if (found == types.end() || !fs::is_regular_file(file)) return {};
  type = found->second;
  return read_text(file);
}

std::vector<std::string> Handler::cases() const {
  std::vector<std::string> names;
  if (cases_.empty() || folder_.is_run()) return names;
  std::error_code missing;
  for (fs::directory_iterator entry(cases_, missing), last; entry != last; entry.increment(missing)) {
    if (fs::is_regular_file(entry->path() / "case.toml")) names.push_back(entry->path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

bool Handler::has_key(const Request& request) const { return equal_texts(request.token, access_.token); }

Response Handler::handle(const Request& request) {
  if (!is_from_here(request)) return text(forbidden, "only the page of this address may ask");
  const std::size_t mark = request.target.find('?');
  const std::string path = request.target.substr(0, mark);
  const std::string query = mark == std::string::npos ? "" : request.target.substr(mark + 1);
  if (!request.changes) {
    std::string type;
    if (std::string file = file_of(path, type); !type.empty()) return {ok, type, std::move(file)};
  }
  if (!has_key(request)) {
    return text(unauthorized, "open the address that whipple monitor printed: it holds the key");
  }
  try {
    if (!request.changes) return read(path, query);
    if (access_.read_only) return text(forbidden, "this monitor only shows (--read-only)");
    if (request.content_type != "application/json") return text(unsupported, "expected application/json");
    return change(path, parse_json(request.body));
  } catch (const json::exception& error) {
    return text(bad_request, error.what());
  } catch (const InputError& error) {
    return text(bad_request, error.what());
  }
}

Response Handler::read(const std::string& path, const std::string& query) {
  const Query keys(query);
  using Routes = std::map<std::string_view, std::function<Response()>>;
  const Routes routes = {
      {"/runs",
       [&] {
         return data({{"folder", fs::absolute(folder_.path()).string()},
                      {"runs", folder_.runs()},
                      {"cases", access_.read_only ? std::vector<std::string>() : cases()},
                      {"read_only", access_.read_only},
                      {"started", folder_.started()}});
       }},
      {"/run", [&] { return data(folder_.describe(keys.one("run"))); }},
      {"/curves",
       [&] {
         const std::optional<Table> table = value_of<Table>(keys.one("table"));
         if (!table) throw InputError("\"table\" of the query is history or gauges");
         return data(
             folder_.curves(keys.one("run"), *table, keys.one("x"), keys.all("y"), keys.number("points")));
       }},
      {"/cloud", [&] {
         return Response{ok, "application/octet-stream",
                         folder_.cloud(keys.one("run"), keys.number("index"), keys.number("particles"))};
       }}};
  const auto found = routes.find(path);
  return found == routes.end() ? text(not_found, "there is nothing at " + path) : found->second();
}

/// Passes a request to a run. The outcome is written to steering.csv at the end of the current step.
Response Handler::steer(const json& body) {
  (void)run::steer(folder_.run(text_of(body, "run")), text_of(body, "request"), text_of(body, "value"));
  return data(json::object(), accepted);
}

Response Handler::resume(const json& body) {
  const fs::path run = folder_.run(text_of(body, "run"));
  if (io::is_running(run)) throw InputError("the run goes on already");
  start_({"--restart", run.string()});
  return data(json::object(), accepted);
}

Response Handler::begin(const json& body) {
  const std::string name = text_of(body, "case"), run = text_of(body, "run");
  const std::vector<std::string> known = cases();
  if (std::ranges::find(known, name) == known.end())
    throw InputError(fmt::format("there is no case \"{}\"", name));
  const auto is_plain = [](char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '-';
  };
  if (run.empty() || run.size() > 100 || run.front() == '-' || !std::ranges::all_of(run, is_plain)) {
    throw InputError(
        "the name of a run has letters, digits, _ and - only, at most 100, and does not begin with -");
  }
  if (folder_.is_run())
    throw InputError(fmt::format("{} is a run: a monitor of the folder above it can start others",
                                 folder_.path().string()));
  const fs::path folder = folder_.path() / run;
  if (fs::exists(folder)) throw InputError(fmt::format("{} exists already", folder.string()));
  std::vector<std::string> arguments = {(cases_ / name / "case.toml").string(), "-o", folder.string()};
  if (!body.at("set").is_array()) throw InputError("\"set\" is a list of texts key=value");
  for (const json& entry : body.at("set")) {
    const auto set = entry.get<std::string>();
    const bool is_key = !set.empty() && std::islower(static_cast<unsigned char>(set.front())) != 0;
    if (!is_key || set.find('=') == std::string::npos) {
      throw InputError(fmt::format("{}: expected key=value, for example time.end='5 us'", set));
    }
    arguments.insert(arguments.end(), {"--set", set});
  }
  start_(arguments);
  return data(json::object(), accepted);
}

Response Handler::change(const std::string& path, const json& body) {
  using Act = Response (Handler::*)(const json&);
  static const std::map<std::string_view, Act> acts = {
      {"/steer", &Handler::steer}, {"/resume", &Handler::resume}, {"/start", &Handler::begin}};
  const auto found = acts.find(path);
  return found == acts.end() ? text(not_found, "there is nothing at " + path) : (this->*found->second)(body);
}

}  // namespace whipple::monitor
