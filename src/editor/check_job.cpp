// SPDX-License-Identifier: BSD-3-Clause
#include "src/editor/check_job.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"

namespace whipple::editor {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* most_memory = "2GB";  // of the particles of a preview: some four million

/// Writes the text into the folder of the job and returns what to start.
std::vector<std::string> prepared(const fs::path& folder, const fs::path& program, const fs::path& file,
                                  const std::string& text) {
  write_text_atomically(folder / "text.toml", text);
  return {program.string(),
          "check",
          file.string(),
          "--text",
          (folder / "text.toml").string(),
          "--json",
          "--brief",
          "--quiet",
          "--most-memory",
          most_memory,
          "--preview",
          (folder / "start.wpv").string()};
}

}  // namespace

CheckJob::CheckJob(const fs::path& program, const fs::path& file, const std::string& text)
    : job_(prepared(folder_.path(), program, file, text), folder_.path() / "output",
           folder_.path() / "errors", folder_.path()) {}

std::optional<json> CheckJob::result() {
  if (!job_.code()) return std::nullopt;
  const std::string output = read_text(folder_.path() / "output");
  json found = {{"faults", json::array()}, {"cloud", fs::exists(folder_.path() / "start.wpv")}};
  try {
    const json check = parse_json(output);
    found["faults"] = check.at("faults");
    if (found["faults"].empty()) found["check"] = check;
    if (*job_.code() == 0 || !found["faults"].empty()) return found;
  } catch (const json::exception&) {
    // The program ended before it wrote anything: its message says why.
  }
  constexpr std::size_t most_letters = 4000;
  const std::string errors = read_text(folder_.path() / "errors");
  found["message"] = errors.empty() ? "the check ended without a word: out of memory?"
                                    : errors.substr(0, std::min(errors.size(), most_letters));
  return found;
}

std::string CheckJob::cloud() const {
  const fs::path file = folder_.path() / "start.wpv";
  if (!fs::exists(file)) throw InputError("there is no preview of this text");
  return read_text(file);
}

}  // namespace whipple::editor
