// SPDX-License-Identifier: BSD-3-Clause
#include "src/monitor/handler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/io/run_directory.hpp"
#include "src/run/directory_control.hpp"
#include "src/run/status.hpp"

namespace whipple::monitor {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

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

constexpr std::size_t most_body_of_request = 64 * 1024;

std::string text_of(const json& body, const char* key) { return body.at(key).get<std::string>(); }

}  // namespace

Handler::Handler(Folder folder, Access access, const fs::path& page, const fs::path& view, fs::path cases,
                 Start start)
    : Site(std::move(access), {{"/viewer/", view}, {"/", page}}, most_body_of_request),
      folder_(std::move(folder)),
      cases_(std::move(cases)),
      start_(std::move(start)) {}

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

Response Handler::read(const std::string& path, const std::string& query) {
  const Query keys(query);
  using Routes = std::map<std::string_view, std::function<Response()>>;
  const Routes routes = {
      {"/runs",
       [&] {
         return data_response({{"folder", fs::absolute(folder_.path()).string()},
                               {"runs", folder_.runs()},
                               {"cases", access().read_only ? std::vector<std::string>() : cases()},
                               {"read_only", access().read_only},
                               {"started", folder_.started()}});
       }},
      {"/run", [&] { return data_response(folder_.describe(keys.one("run"))); }},
      {"/curves",
       [&] {
         const std::optional<Table> table = value_of<Table>(keys.one("table"));
         if (!table) throw InputError("\"table\" of the query is history or gauges");
         return data_response(
             folder_.curves(keys.one("run"), *table, keys.one("x"), keys.all("y"), keys.number("points")));
       }},
      {"/cloud", [&] {
         return Response{ok, "application/octet-stream",
                         folder_.cloud(keys.one("run"), keys.number("index"), keys.number("particles"))};
       }}};
  const auto found = routes.find(path);
  return found == routes.end() ? text_response(not_found, "there is nothing at " + path) : found->second();
}

/// Passes a request to a run. The outcome is written to steering.csv at the end of the current step.
Response Handler::steer(const json& body) {
  (void)run::steer(folder_.run(text_of(body, "run")), text_of(body, "request"), text_of(body, "value"));
  return data_response(json::object(), accepted);
}

Response Handler::resume(const json& body) {
  const fs::path run = folder_.run(text_of(body, "run"));
  if (io::is_running(run)) throw InputError("the run goes on already");
  start_({"--restart", run.string()});
  return data_response(json::object(), accepted);
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
  return data_response(json::object(), accepted);
}

Response Handler::change(const std::string& path, const json& body) {
  using Act = Response (Handler::*)(const json&);
  static const std::map<std::string_view, Act> acts = {
      {"/steer", &Handler::steer}, {"/resume", &Handler::resume}, {"/start", &Handler::begin}};
  const auto found = acts.find(path);
  return found == acts.end() ? text_response(not_found, "there is nothing at " + path)
                             : (this->*found->second)(body);
}

}  // namespace whipple::monitor
