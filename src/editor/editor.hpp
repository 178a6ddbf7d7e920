// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "src/editor/case_file.hpp"
#include "src/editor/check_job.hpp"
#include "src/monitor/site.hpp"

namespace whipple::editor {

/// Holds what the page offers, which the rest of the program knows.
struct Offers {
  std::string schema;                           ///< JSON schema of a case
  nlohmann::json suggestions;                   ///< texts that a key may have: {"material": [...]}
  std::filesystem::path cases;                  ///< folder of cases to start from
  std::filesystem::path program;                ///< the executable, for checks
  std::filesystem::path page, viewer, monitor;  ///< folders of the files of the page
};

/// Handles the requests of the page that edits a case (docs/manual/edit.md), independently of the network. No request
/// names a file: read and written is the one of the case, and what its text refers to is read by `whipple check`.
class Editor : public monitor::Site {
 public:
  Editor(CaseFile file, monitor::Access access, Offers offers);

 private:
  [[nodiscard]] monitor::Response read(const std::string& path, const std::string& query) override;
  [[nodiscard]] monitor::Response change(const std::string& path, const nlohmann::json& body) override;
  [[nodiscard]] monitor::Response content() const;
  [[nodiscard]] monitor::Response schema() const;
  [[nodiscard]] monitor::Response library() const;
  [[nodiscard]] monitor::Response start_from(const nlohmann::json& body) const;
  [[nodiscard]] monitor::Response parse(const nlohmann::json& body) const;
  [[nodiscard]] monitor::Response edit(const nlohmann::json& body) const;
  [[nodiscard]] monitor::Response check(const nlohmann::json& body);
  [[nodiscard]] monitor::Response result(const nlohmann::json& body);
  [[nodiscard]] monitor::Response cloud(const nlohmann::json& body);
  [[nodiscard]] monitor::Response save(const nlohmann::json& body) const;
  CheckJob& job_of(const nlohmann::json& body);

  CaseFile file_;
  Offers offers_;
  std::unique_ptr<CheckJob> job_;  ///< of the last text; an older one is ended
  std::uint64_t number_ = 0;       ///< of the job
};

}  // namespace whipple::editor
