// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "src/io/ranks.hpp"

namespace whipple::io {

/// Writes one file RUN.KIND.NNNNNN.hdf per snapshot and the index RUN.KIND.hdf.series with the physical times, which is
/// the file to open in ParaView. A file gets its final name when it is complete, and the index is updated afterwards,
/// so that a killed run leaves a readable series.
class Series {
 public:
  /// Starts a new series: an index of that name is replaced at the first snapshot.
  Series(std::filesystem::path folder, std::string run, std::string kind, const Ranks& ranks)
      : folder_(std::move(folder)), run_(std::move(run)), kind_(std::move(kind)), ranks_(ranks) {}

  /// Continues the series in the folder: keeps its snapshots up to and including `time` (s), removes the later ones
  /// from the index and deletes their files. A missing index is an empty series. Collective.
  /// @throws InputError if the index is not readable
  void restart(double time);

  /// Writes a snapshot by `write_file(path)` and updates the index. A snapshot at the time of the last one replaces it.
  /// Returns the path of the file. Collective.
  /// @param time  s, not before the last snapshot
  /// @throws InputError if the file cannot be written
  std::filesystem::path write(double time,
                              const std::function<void(const std::filesystem::path&)>& write_file);

  /// Returns the number of snapshots in the index.
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] std::filesystem::path index_path() const;

 private:
  struct Entry {
    std::string file;
    double time;
  };
  [[nodiscard]] std::string index_text() const;

  std::filesystem::path folder_;
  std::string run_, kind_;
  Ranks ranks_;
  std::vector<Entry> entries_;
};

}  // namespace whipple::io
