// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "src/monitor/folder.hpp"
#include "src/monitor/site.hpp"

namespace whipple::monitor {

/// Starts a run in the background with the arguments of `whipple run`.
using Start = std::function<void(const std::vector<std::string>& arguments)>;

/// Handles the requests of the page (docs/manual/monitor.md), independently of the network.
class Handler : public Site {
 public:
  /// @param page   folder of the page's files
  /// @param view   folder of the viewer's modules
  /// @param cases  folder of the cases that can be started: sub-folders with a case.toml; empty: none
  Handler(Folder folder, Access access, const std::filesystem::path& page, const std::filesystem::path& view,
          std::filesystem::path cases, Start start);

 private:
  [[nodiscard]] Response read(const std::string& path, const std::string& query) override;
  [[nodiscard]] Response change(const std::string& path, const nlohmann::json& body) override;
  [[nodiscard]] Response steer(const nlohmann::json& body);
  [[nodiscard]] Response resume(const nlohmann::json& body);
  [[nodiscard]] Response begin(const nlohmann::json& body);
  [[nodiscard]] std::vector<std::string> cases() const;

  Folder folder_;
  std::filesystem::path cases_;
  Start start_;
};

}  // namespace whipple::monitor
