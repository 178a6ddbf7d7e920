// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/analysis/run.hpp"
#include "src/core/base/words.hpp"
#include "src/monitor/table.hpp"

namespace whipple::monitor {

/// Lists the tables of a run directory.
enum class Table : std::uint8_t { history, gauges };
constexpr std::array<Word<Table>, 2> words(Table) {
  return {{{Table::history, "history"}, {Table::gauges, "gauges"}}};
}

/// Describes the runs in the run directories below a folder as JSON for the page. All data are read from the files,
/// without communication with an active run. Numbers are SI; non-finite values are null.
class Folder {
 public:
  /// @param path  a run directory, or a folder that contains run directories at any depth, also later ones
  explicit Folder(std::filesystem::path path) : path_(std::move(path)) {}

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Returns whether the folder is a run directory.
  [[nodiscard]] bool is_run() const { return std::filesystem::exists(path_ / "run.toml"); }
  /// Returns the run directory with a name as listed by `runs`.
  /// @throws InputError if there is none of this name
  [[nodiscard]] std::filesystem::path run(const std::string& name) const;

  /// Lists all runs: name, state, time, end, step, time_left, message.
  [[nodiscard]] nlohmann::json runs() const;
  /// Describes a run: title, status, the requests that it accepts, columns of its tables, times of its snapshots, its
  /// answers to requests and the last lines of its log.
  [[nodiscard]] nlohmann::json describe(const std::string& name);
  /// Returns points of columns of a table as functions of another column: {header: {x: [...], y: [...]}}.
  /// @param points  approximate number of points of each column
  /// @throws InputError if a column does not exist
  [[nodiscard]] nlohmann::json curves(const std::string& name, Table table, const std::string& x,
                                      const std::vector<std::string>& columns, std::size_t points);
  /// Returns the output file of the programs started from the page; `started` returns its last lines.
  [[nodiscard]] std::filesystem::path output_of_started() const { return path_ / "monitor.log"; }
  [[nodiscard]] nlohmann::json started() const;
  /// Returns a snapshot as gzipped `.wpv`.
  /// @param most  maximum number of particles; larger snapshots are thinned
  /// @throws InputError if the snapshot does not exist
  [[nodiscard]] std::string cloud(const std::string& name, std::size_t index, std::size_t most);

 private:
  struct Known {
    explicit Known(const std::filesystem::path& run)
        : history(run / "history.csv"), gauges(run / "gauges.csv") {}
    GrowingTable history, gauges;
    std::unique_ptr<analysis::Run> run;  // read with the index of snapshots below
    std::filesystem::file_time_type index_written{};
  };
  Known& known(const std::string& name);
  const analysis::Run& snapshots_of(const std::string& name);

  std::filesystem::path path_;
  std::map<std::string, Known> known_;
};

}  // namespace whipple::monitor
