// SPDX-License-Identifier: BSD-3-Clause
#include "src/editor/editor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/text.hpp"
#include "src/core/input/text_edit.hpp"
#include "src/core/input/text_tree.hpp"

namespace whipple::editor {
namespace {

namespace fs = std::filesystem;
using monitor::data_response;
using monitor::Response;
using monitor::text_response;
using nlohmann::json;

constexpr std::size_t most_bytes_of_text = 500'000, most_bytes_of_request = 2'000'000, most_acts = 100;

std::string text_of(const json& body, const char* key) { return body.at(key).get<std::string>(); }

/// Returns the text of a case in a request.
std::string case_of(const json& body) {
  std::string text = text_of(body, "text");
  if (text.size() > most_bytes_of_text) {
    throw InputError(
        fmt::format("a text of more than {} kB: change it in an editor of texts", most_bytes_of_text / 1000));
  }
  return text;
}

json fault_json(const InputFault& fault) {
  return {{"line", fault.line}, {"column", fault.column}, {"key", fault.key}, {"text", fault.text}};
}

/// Returns the place and the words of a message "file:line:column: error: words".
InputFault fault_of(const InputError& error, const fs::path& file) {
  InputFault fault;
  fault.text = error.what();
  const std::string start = file.string() + ":";
  if (!fault.text.starts_with(start)) return fault;
  const char* at = fault.text.data() + start.size();
  const char* const end = fault.text.data() + fault.text.size();
  unsigned line = 0, column = 0;
  const auto [after_line, no_line] = std::from_chars(at, end, line);
  if (no_line != std::errc() || after_line == end) return fault;
  const auto [after_column, no_column] = std::from_chars(after_line + 1, end, column);
  if (no_column != std::errc()) return fault;
  std::string_view words(after_column, static_cast<std::size_t>(end - after_column));
  constexpr std::string_view mark = ": error: ";
  if (words.starts_with(mark)) words.remove_prefix(mark.size());
  return {.line = line, .column = column, .text = std::string(words)};
}

/// Sets the file names of a case that are relative to its folder to absolute ones: the text goes into another folder.
void make_absolute(std::string& text, const json& tree, const std::string& path, const fs::path& folder) {
  const auto below = [&](const std::string& part, const json& next) {
    make_absolute(text, next, path.empty() ? part : path + "." + part, folder);
  };
  if (tree.contains("keys")) {
    for (const auto& [key, next] : tree["keys"].items()) below(key, next);
  } else if (tree.contains("list")) {
    for (std::size_t i = 0; i < tree["list"].size(); ++i) below(std::to_string(i), tree["list"][i]);
  } else if (tree["value"].is_string()) {
    const auto name = tree["value"].get<std::string>();
    if (name.find('.') == std::string::npos || name.size() > 200) return;
    const fs::path file = folder / name;
    std::error_code none;
    if (!fs::is_regular_file(file, none)) return;
    text = input::set_in_text(text, "case.toml", path,
                              toml_string(fs::absolute(file).lexically_normal().string()))
               .text;
  }
}

}  // namespace

Editor::Editor(CaseFile file, monitor::Access access, Offers offers)
    : Site(std::move(access),
           {{"/viewer/", offers.viewer}, {"/monitor/", offers.monitor}, {"/", offers.page}},
           most_bytes_of_request),
      file_(std::move(file)),
      offers_(std::move(offers)) {}

Response Editor::read(const std::string& path, const std::string& /*query*/) {
  using Answer = Response (Editor::*)() const;
  static const std::map<std::string_view, Answer> answers = {
      {"/case", &Editor::content}, {"/library", &Editor::library}, {"/schema", &Editor::schema}};
  const auto found = answers.find(path);
  return found == answers.end() ? text_response(monitor::not_found, "there is nothing at " + path)
                                : (this->*found->second)();
}

Response Editor::change(const std::string& path, const json& body) {
  using Act = std::function<Response(const json&)>;
  const std::map<std::string_view, Act> acts = {
      {"/start", [this](const json& wish) { return start_from(wish); }},
      {"/parse", [this](const json& wish) { return parse(wish); }},
      {"/edit", [this](const json& wish) { return edit(wish); }},
      {"/check", [this](const json& wish) { return check(wish); }},
      {"/result", [this](const json& wish) { return result(wish); }},
      {"/cloud", [this](const json& wish) { return cloud(wish); }},
      {"/save", [this](const json& wish) { return save(wish); }}};
  const auto found = acts.find(path);
  return found == acts.end() ? text_response(monitor::not_found, "there is nothing at " + path)
                             : found->second(body);
}

Response Editor::content() const {
  const CaseFile::Content now = file_.read();
  return data_response({{"file", file_.path().string()},
                        {"exists", !now.digest.empty()},
                        {"text", now.text},
                        {"digest", now.digest},
                        {"suggestions", offers_.suggestions}});
}

/// The keys keep the order of the tables, which is that of the form.
Response Editor::schema() const { return {monitor::ok, "application/json", offers_.schema}; }

Response Editor::library() const {
  std::map<std::string, json> titles;  // of the cases, by their names
  std::error_code missing;
  for (fs::directory_iterator entry(offers_.cases, missing), last; entry != last; entry.increment(missing)) {
    const fs::path file = entry->path() / "case.toml";
    if (!fs::is_regular_file(file)) continue;
    json title = "";
    try {
      const json tree = input::tree_of_text(read_text(file), file);
      if (tree["keys"].contains("title")) title = tree["keys"]["title"].value("value", title);
    } catch (const InputError&) {
      continue;  // nothing to start from
    }
    titles[entry->path().filename().string()] = std::move(title);
  }
  json cases = json::array();
  for (const auto& [name, title] : titles) cases.push_back({{"name", name}, {"title", title}});
  return data_response({{"cases", cases}});
}

/// Returns the text of a case of the library, whose name is looked up in the list of those that there are.
Response Editor::start_from(const json& body) const {
  const std::string name = text_of(body, "case");
  std::error_code missing;
  for (fs::directory_iterator entry(offers_.cases, missing), last; entry != last; entry.increment(missing)) {
    const fs::path file = entry->path() / "case.toml";
    if (entry->path().filename().string() != name || !fs::is_regular_file(file)) continue;
    std::string text = read_text(file);
    make_absolute(text, input::tree_of_text(text, file), "", entry->path());
    return data_response({{"text", text}});
  }
  throw InputError(fmt::format("there is no case {} in the library", toml_string(name)));
}

/// Returns the content of a text with its places, or why it has none.
Response Editor::parse(const json& body) const {
  const std::string text = case_of(body);
  try {
    return data_response({{"tree", input::tree_of_text(text, file_.path())}});
  } catch (const InputError& error) {
    return data_response({{"fault", fault_json(fault_of(error, file_.path()))}});
  }
}

/// Changes a text, all or nothing.
Response Editor::edit(const json& body) const {
  std::string text = case_of(body);
  const json& acts = body.at("acts");
  if (!acts.is_array() || acts.size() > most_acts)
    throw InputError(fmt::format("\"acts\" is a list of at most {} entries", most_acts));
  using Act = std::function<input::TextEdit(const json&)>;
  const fs::path& file = file_.path();
  const std::map<std::string, Act> known = {
      {"set",
       [&](const json& act) {
         return input::set_in_text(text, file, text_of(act, "key"), text_of(act, "value"));
       }},
      {"remove", [&](const json& act) { return input::remove_from_text(text, file, text_of(act, "key")); }},
      {"table",
       [&](const json& act) { return input::add_table_to_text(text, file, text_of(act, "key"), false); }},
      {"entry",
       [&](const json& act) { return input::add_table_to_text(text, file, text_of(act, "key"), true); }}};
  std::size_t line = 1;
  for (const json& act : acts) {
    const auto found = known.find(text_of(act, "act"));
    if (found == known.end()) throw InputError("\"act\" is set, remove, table or entry");
    input::TextEdit done = found->second(act);
    text = std::move(done.text);
    line = done.line;
    if (text.size() > most_bytes_of_text) throw InputError("the text would be too long");
  }
  return data_response({{"text", text}, {"line", line}, {"tree", input::tree_of_text(text, file)}});
}

Response Editor::check(const json& body) {
  job_.reset();  // of an older text
  job_ = std::make_unique<CheckJob>(offers_.program, file_.path(), case_of(body));
  return data_response({{"job", ++number_}}, monitor::accepted);
}

CheckJob& Editor::job_of(const json& body) {
  if (job_ == nullptr || body.at("job").get<std::uint64_t>() != number_)
    throw InputError("this check was given up for a later one");
  return *job_;
}

Response Editor::result(const json& body) {
  std::optional<json> found = job_of(body).result();
  if (!found) return data_response({{"done", false}});
  (*found)["done"] = true;
  return data_response(*found);
}

Response Editor::cloud(const json& body) {
  return {monitor::ok, "application/octet-stream", job_of(body).cloud()};
}

Response Editor::save(const json& body) const {
  const std::string text = case_of(body);
  const std::string digest = file_.write(text, text_of(body, "digest"));
  if (digest.empty()) {
    return text_response(monitor::conflict,
                         fmt::format("{} was changed by another program meanwhile: nothing was written",
                                     file_.path().string()));
  }
  return data_response({{"digest", digest}});
}

}  // namespace whipple::editor
