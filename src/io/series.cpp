// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/series.hpp"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
#include "src/io/run_directory.hpp"

namespace whipple::io {
namespace {

namespace fs = std::filesystem;

/// Returns NNNNNN of RUN.KIND.NNNNNN.hdf, if the file belongs to this run.
std::optional<std::size_t> snapshot_number(std::string_view file, std::string_view run,
                                           std::string_view kind) {
  const std::string prefix = fmt::format("{}.{}.", run, kind);
  constexpr std::string_view suffix = ".hdf";
  if (file.size() < prefix.size() + 6 + suffix.size() || !file.starts_with(prefix) ||
      !file.ends_with(suffix)) {
    return std::nullopt;
  }
  const std::string_view digits = file.substr(prefix.size(), file.size() - prefix.size() - suffix.size());
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

}  // namespace

fs::path Series::index_path() const { return folder_ / (run_ + "." + kind_ + ".hdf.series"); }

std::string Series::index_text() const {
  nlohmann::ordered_json index;
  index["file-series-version"] = "1.0";
  index["files"] = nlohmann::ordered_json::array();
  for (const Entry& entry : entries_) index["files"].push_back({{"name", entry.file}, {"time", entry.time}});
  return json_text(index, 1) + "\n";
}

void Series::restart(double time) {
  std::string text;
  ranks_.on_root([&] {
    if (fs::exists(index_path())) text = read_text(index_path());
  });
  text = ranks_.broadcast(text);

  entries_.clear();
  if (!text.empty()) {
    try {
      const nlohmann::json index = parse_json(text);
      for (const nlohmann::json& entry : index.at("files")) {
        entries_.push_back({entry.at("name").get<std::string>(), entry.at("time").get<double>()});
        if (snapshot_number(entries_.back().file, run_, kind_) != entries_.size() - 1) {
          throw InputError(fmt::format("{}: entry {} is \"{}\", which is not snapshot {} of the run \"{}\"",
                                       index_path().string(), entries_.size() - 1, entries_.back().file,
                                       entries_.size() - 1, run_));
        }
      }
    } catch (const nlohmann::json::exception& error) {
      throw InputError(
          fmt::format("{}: is not the index of a series: {}", index_path().string(), error.what()));
    }
  }
  std::erase_if(entries_, [&](const Entry& entry) { return entry.time > time; });

  ranks_.on_root([&] {
    if (!text.empty()) write_text_atomically(index_path(), index_text());
    // Files that are not in the index: later than the restart, or written just before the run was killed.
    std::vector<fs::path> beyond;
    for (const fs::directory_entry& file : fs::directory_iterator(folder_)) {
      const auto number = snapshot_number(file.path().filename().string(), run_, kind_);
      if (number && *number >= entries_.size()) beyond.push_back(file.path());
    }
    for (const fs::path& file : beyond) fs::remove(file);
  });
}

fs::path Series::write(double time, const std::function<void(const fs::path&)>& write_file) {
  if (!entries_.empty() && time < entries_.back().time) {
    throw InternalError(fmt::format("snapshot at {} s after one at {} s", time, entries_.back().time));
  }
  const bool replaces = !entries_.empty() && time == entries_.back().time;
  const std::size_t number = replaces ? entries_.size() - 1 : entries_.size();
  const std::string file = fmt::format("{}.{}.{:06}.hdf", run_, kind_, number);
  const fs::path path = folder_ / file;
  SharedPartialFile partial(path, ranks_);

  write_file(partial.path());
  if (!replaces) entries_.push_back({file, time});
  ranks_.on_root([&] {
    partial.publish();
    write_text_atomically(index_path(), index_text());
  });
  return path;
}

}  // namespace whipple::io
