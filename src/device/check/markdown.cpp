// SPDX-License-Identifier: BSD-3-Clause
#include "src/device/check/markdown.hpp"

#include <array>
#include <cstdarg>
#include <cstdio>

namespace whipple::device::check {
namespace {

[[gnu::format(printf, 1, 2)]] std::string format(const char* text, ...) {
  std::array<char, 512> written{};
  std::va_list values;
  va_start(values, text);
  std::vsnprintf(written.data(), written.size(), text, values);
  va_end(values);
  return written.data();
}

std::string largest(const std::vector<Difference>& list) {
  if (list.empty()) return "0";
  return format("%.1e (%s)", list.front().largest, list.front().component.c_str());
}

}  // namespace

std::string comparison_head() {
  return "| state | particles | steps | largest difference after one | of sums | after all | of sums | same "
         "bits twice "
         "|\n| --- | --- | --- | --- | --- | --- | --- | --- |\n";
}

std::string comparison_row(const StoredState& state, const Comparison& found) {
  const bool all = found.steps == state.steps.size();
  return format("| %s | %zu | %zu | %s | %s | %s | %s | %s |\n", state.name.c_str(), state.start.size(),
                found.steps, largest(found.first).c_str(), largest(found.first_sums).c_str(),
                all ? largest(found.last).c_str() : "-", all ? largest(found.last_sums).c_str() : "-",
                !found.twice    ? "-"
                : found.repeats ? "yes"
                                : "no");
}

std::string timing_table(const std::vector<Timing>& timings, const Rates& rates) {
  std::string text = "| particles | arrangement | ns per particle and step (roofline) | bytes per particle |";
  for (const char* stage : stage_names) text += std::string(" ") + stage + " |";
  text += "\n| --- | --- | --- | --- |";
  for (std::size_t s = 0; s < stage_count; ++s) text += " --- |";
  text += "\n";
  for (const Timing& t : timings) {
    if (!t.fault.empty()) {
      text += format("| %.3g | %s | %s |", t.size.particles, t.arrangement.c_str(), t.fault.c_str());
      for (std::size_t s = 0; s <= stage_count; ++s) text += " |";
      text += "\n";
      continue;
    }
    text += format("| %.3g | %s | %.3f (%.3f) | %.0f |", t.size.particles, t.arrangement.c_str(),
                   1e9 * t.step, 1e9 * roofline_of_step(t.size, rates), t.bytes / t.size.particles);
    for (const double seconds : t.of_stages) text += format(" %.3f |", 1e9 * seconds);
    text += "\n";
  }
  return text;
}

}  // namespace whipple::device::check
