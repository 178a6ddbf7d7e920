// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "src/core/base/text.hpp"

namespace whipple {
namespace {
bool visible = true;
constexpr int bar_width = 28;
}  // namespace

void set_progress_visible(bool value) { visible = value; }

Progress::Progress(std::string label, double total)
    : label_(std::move(label)), total_(total), terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (last_done_ > first_) print(last_done_, last_remark_, true);
}

void Progress::start_from(double done) { first_ = last_done_ = done; }

void Progress::update(double done, const std::string& remark) {
  last_done_ = done;
  last_remark_ = remark;
  const auto now = Clock::now();
  const double interval = terminal_ ? 0.2 : 60.0;
  if (std::chrono::duration<double>(now - printed_).count() < interval) return;
  printed_ = now;
  print(done, remark, false);
}

void Progress::print(double done, const std::string& remark, bool last) {
  if (!visible) return;
  const double elapsed = std::chrono::duration<double>(Clock::now() - begin_).count();
  const double share = total_ > 0 ? std::clamp(done / total_, 0.0, 1.0) : 0.0;
  const double rate = elapsed > 0 ? (done - first_) / elapsed : 0.0;
  const std::string left = last         ? "in " + format_duration(elapsed)
                           : rate > 0.0 ? format_duration((total_ - done) / rate) + " left"
                                        : "time left unknown";
  // Written without a check: a full disk or a closed terminal does not end the work.
  std::string line;
  if (terminal_) {
    const int filled = static_cast<int>(std::lround(share * bar_width));
    const std::string bar(static_cast<std::size_t>(filled), '#');
    line = fmt::format("\r{} [{:-<{}}] {:5.1f} %  {}  {}\033[K{}", label_, bar, bar_width, 100 * share, left,
                       remark, last ? "\n" : "");
  } else {
    line = fmt::format("{} {:5.1f} %  {}  {}\n", label_, 100 * share, left, remark);
  }
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace whipple
