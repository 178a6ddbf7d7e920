// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "src/core/base/temporary_folder.hpp"
#include "src/core/process/job.hpp"

namespace whipple::editor {

/// Checks a text by `whipple check` in another process: what it costs, and how it may end, does not concern the server.
/// The process is ended when the object is destroyed.
class CheckJob {
 public:
  /// @param program  the executable whipple
  /// @param file     of the case; its folder is that of the paths in the text
  CheckJob(const std::filesystem::path& program, const std::filesystem::path& file, const std::string& text);

  /// Returns nothing while it runs, then what it found:
  ///   "faults": each with line, column, key and text
  ///   "check":  what would run, as of `whipple check --json`; missing if there are faults
  ///   "cloud":  whether there is a preview
  ///   "message": what the program said, if it ended otherwise
  [[nodiscard]] std::optional<nlohmann::json> result();

  /// Returns the particles at the start as a .wpv file. @throws InputError if there are none
  [[nodiscard]] std::string cloud() const;

 private:
  TemporaryFolder folder_;
  process::Job job_;
};

}  // namespace whipple::editor
