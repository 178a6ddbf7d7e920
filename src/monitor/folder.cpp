// SPDX-License-Identifier: BSD-3-Clause
#include "src/monitor/folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <system_error>

#include "src/core/base/csv.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/run/requests.hpp"
#include "src/run/status.hpp"
#include "src/view/cloud.hpp"
#include "src/view/page.hpp"

namespace whipple::monitor {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json acts_json() {
  json list = json::array();
  for (const run::ActEntry& act : run::acts()) {
    list.push_back({{"word", act.word},
                    {"meaning", act.meaning},
                    {"value", act.changes != nullptr},
                    {"optional", act.act == run::Act::end},
                    {"key", act.key}});
  }
  return list;
}

/// Returns the last lines of a text file, reading a limited number of bytes.
json last_lines(const fs::path& file, std::size_t lines) {
  constexpr std::streamoff most = 16 * 1024;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  json list = json::array();
  if (!in) return list;
  const std::streamoff size = in.tellg();
  in.seekg(std::max<std::streamoff>(size - most, 0));
  std::vector<std::string> all;
  for (std::string line; std::getline(in, line);) all.push_back(line);
  if (size > most && !all.empty()) all.erase(all.begin());  // an incomplete line
  std::erase_if(all, [](const std::string& line) { return line.find(" debug: ") != std::string::npos; });
  for (std::size_t i = all.size() > lines ? all.size() - lines : 0; i < all.size(); ++i)
    list.push_back(all[i]);
  return list;
}

json answers_json(const fs::path& file) {
  json list = json::array();
  std::ifstream in(file, std::ios::binary);
  std::string line;
  std::getline(in, line);  // header
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = csv_cells(line);
    if (cells.size() != 7) continue;
    list.push_back({{"time", cells[0]},
                    {"step", cells[1]},
                    {"request", cells[3]},
                    {"value", cells[4]},
                    {"answer", cells[5]},
                    {"detail", cells[6]}});
  }
  return list;
}

/// Checks that a file of a run is inside the folder of the run. Anyone who may write to a folder could create links in
/// it to files that only the user of the monitor may read. Each file is checked before it is read, because a run has
/// many files.
/// @throws InputError if the file of a run, which need not exist, is outside the folder
void require_no_link_out(const fs::path& run, const fs::path& file) {
  if (lies_in(file, run)) return;
  throw InputError(
      fmt::format("{}: is a link out of the folder of the run, of which nothing is shown", file.string()));
}

/// Lists the files of a run that are read or written, except its snapshots.
constexpr std::array files_of_run = {"status.json", "run.toml",     "history.csv", "gauges.csv",
                                     "log.txt",     "steering.csv", "control"};

/// Returns the run directories below a folder, without those that links place outside it.
std::vector<fs::path> own_runs(const fs::path& folder) {
  std::vector<fs::path> runs = run::find_runs(folder);
  std::erase_if(runs, [&](const fs::path& run) { return !lies_in(run, folder); });
  return runs;
}

}  // namespace

fs::path Folder::run(const std::string& name) const {
  for (const fs::path& path : own_runs(path_)) {
    if (path.lexically_relative(path_).generic_string() != name) continue;
    for (const char* file : files_of_run) require_no_link_out(path, path / file);
    return path;
  }
  throw InputError(fmt::format("no run \"{}\" in {}", name, path_.string()));
}

Folder::Known& Folder::known(const std::string& name) {
  const fs::path path = run(name);
  return known_.try_emplace(name, path).first->second;
}

json Folder::runs() const {
  json list = json::array();
  for (const fs::path& path : own_runs(path_)) {
    json entry = {{"name", path.lexically_relative(path_).generic_string()}};
    try {
      require_no_link_out(path, path / "status.json");
      entry.update(run::status_json(run::read_status(path)));
    } catch (const InputError& error) {  // incomplete or damaged: the other runs are still shown
      entry.update({{"state", "unknown"}, {"goes_on", false}, {"message", error.what()}});
    }
    list.push_back(std::move(entry));
  }
  return list;
}

json Folder::started() const { return last_lines(output_of_started(), 12); }

const analysis::Run& Folder::snapshots_of(const std::string& name) {
  Known& entry = known(name);
  const fs::path folder = run(name);
  std::error_code missing;
  fs::file_time_type written = fs::file_time_type::min();
  for (fs::directory_iterator file(folder, missing), last; file != last; file.increment(missing)) {
    if (file->path().extension() != ".series") continue;
    require_no_link_out(folder, file->path());
    written = std::max(written, file->last_write_time(missing));
  }
  if (!entry.run || written != entry.index_written) {
    entry.run = std::make_unique<analysis::Run>(analysis::read_run(folder));
    entry.index_written = written;
  }
  return *entry.run;
}

json Folder::describe(const std::string& name) {
  const fs::path path = run(name);
  Known& entry = known(name);
  entry.history.look();
  entry.gauges.look();
  json answer = {{"name", name},
                 {"folder", fs::absolute(path).string()},
                 {"title", ""},
                 {"status", run::status_json(run::read_status(path))},
                 {"acts", acts_json()},
                 {"tables", {{"history", entry.history.heads()}, {"gauges", entry.gauges.heads()}}},
                 {"rows", entry.history.rows()},
                 {"snapshots", json::array()},
                 {"answers", answers_json(path / "steering.csv")},
                 {"log", last_lines(path / "log.txt", 40)}};
  try {
    const analysis::Run& run = snapshots_of(name);
    answer["title"] = run.title;
    for (const analysis::SnapshotEntry& snapshot : run.snapshots)
      answer["snapshots"].push_back(number(snapshot.time));
  } catch (const InputError& error) {
    answer["no_snapshots"] = error.what();
  }
  return answer;
}

json Folder::curves(const std::string& name, Table table, const std::string& x,
                    const std::vector<std::string>& columns, std::size_t points) {
  Known& entry = known(name);
  GrowingTable& rows = table == Table::gauges ? entry.gauges : entry.history;
  rows.look();
  const auto place = [&](const std::string& head) {
    const auto found = std::ranges::find(rows.heads(), head);
    if (found == rows.heads().end()) {
      throw InputError(fmt::format("no column \"{}\" in the {} of {}", head, word_of(table), name));
    }
    return static_cast<std::size_t>(found - rows.heads().begin());
  };
  json answer = json::object();
  const std::size_t abscissa = place(x);
  for (const std::string& head : columns) {
    const std::size_t ordinate = place(head);
    json of_x = json::array(), of_y = json::array();
    for (const std::size_t row : rows.rows_to_draw(ordinate, points)) {
      of_x.push_back(number(rows.column(abscissa)[row]));
      of_y.push_back(number(rows.column(ordinate)[row]));
    }
    answer[head] = {{"x", std::move(of_x)}, {"y", std::move(of_y)}};
  }
  return answer;
}

std::string Folder::cloud(const std::string& name, std::size_t index, std::size_t most) {
  const analysis::Run& run = snapshots_of(name);
  if (index >= run.snapshots.size())
    throw InputError(fmt::format("{} has {} snapshots", name, run.snapshots.size()));
  const analysis::SnapshotEntry& entry = run.snapshots[index];
  require_no_link_out(run.folder, entry.file);
  if (const fs::path elements = analysis::elements_file(entry); !elements.empty())
    require_no_link_out(run.folder, elements);
  const analysis::Snapshot snapshot = analysis::read_snapshot(entry);
  const std::size_t one_of =
      std::max<std::size_t>((snapshot.size() + most - 1) / std::max<std::size_t>(most, 1), 1);
  return view::gzipped(view::pack_cloud(run, snapshot, {.fields = {}, .one_of = one_of}));
}

}  // namespace whipple::monitor
