// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/requests.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/text.hpp"
#include "src/core/base/units.hpp"
#include "src/core/input/document.hpp"

namespace whipple::run {
namespace {

constexpr auto table = std::to_array<ActEntry>({
    {Act::pause, "pause", "wait after the step under way until `resume` or `end`"},
    {Act::resume, "resume", "continue after `pause`"},
    {Act::snapshot, "snapshot", "write a snapshot more"},
    {Act::checkpoint, "checkpoint", "write a checkpoint more"},
    {Act::stop, "stop", "write a checkpoint and stop; `whipple run --restart` continues"},
    {Act::end, "end", "end at this simulated time; without a value: after the step under way", &Schedule::end,
     "time.end"},
    {Act::snapshot_every, "snapshot_every", "simulated time between snapshots", &Schedule::snapshot_every,
     "output.snapshot_every"},
    {Act::checkpoint_every, "checkpoint_every", "wall-clock time between checkpoints",
     &Schedule::checkpoint_every, "output.checkpoint_every"},
    {Act::history_every, "history_every", "steps between rows of history.csv", &Schedule::history_every,
     "output.history_every"},
    {Act::gauges_every, "gauges_every", "steps between rows of gauges.csv", &Schedule::gauges_every,
     "output.gauges_every"},
});

const ParameterInfo* find(std::span<const UnboundParameter> parameters, std::string_view name) {
  const auto found = std::ranges::find_if(parameters, [&](const auto& p) { return p.info.name == name; });
  return found == parameters.end() ? nullptr : &found->info;
}

/// Returns unit and range of a key of the case.
ParameterInfo parameter_of(std::string_view key) {
  const std::string_view name = key.substr(key.find('.') + 1);
  const auto time = cases::TimeControl::parameters();
  const auto output = cases::OutputControl::parameters();
  const ParameterInfo* info =
      key.starts_with("time.") ? find(time.parameters(), name) : find(output.parameters(), name);
  if (info == nullptr) throw InternalError(fmt::format("the case has no key {}", key));
  return *info;
}

double whole_number(const std::string& text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    throw InputError(fmt::format("expected a whole number, found {}", toml_string(text)));
  return static_cast<double>(number);
}

}  // namespace

Schedule::Schedule(const cases::Case& setup)
    : end(setup.time.end),
      snapshot_every(setup.output.snapshot_every),
      checkpoint_every(setup.output.checkpoint_every),
      history_every(static_cast<double>(setup.output.history_every)),
      gauges_every(static_cast<double>(setup.output.gauges_every)) {}

void Schedule::write_to(cases::Case& setup) const {
  setup.time.end = end;
  setup.output.snapshot_every = snapshot_every;
  setup.output.checkpoint_every = checkpoint_every;
  setup.output.history_every = static_cast<std::int64_t>(history_every);
  setup.output.gauges_every = static_cast<std::int64_t>(gauges_every);
}

std::span<const ActEntry> acts() { return table; }

const ActEntry& entry_of(Act act) {
  const auto found = std::ranges::find(table, act, &ActEntry::act);
  if (found == table.end()) throw InternalError("no act is asked for");
  return *found;
}

std::string describe_acts() {
  std::string text;
  for (const ActEntry& entry : table) {
    const std::string value = entry.changes == nullptr ? "" : entry.act == Act::end ? " [VALUE]" : " VALUE";
    text += fmt::format("  {:<24}  {}\n", fmt::format("{}{}", entry.word, value), entry.meaning);
  }
  return text;
}

Request parse_request(const std::string& word, const std::string& value) {
  const auto entry = std::ranges::find(table, word, &ActEntry::word);
  if (entry == table.end()) {
    std::vector<std::string> words;
    for (const ActEntry& known : table) words.emplace_back(known.word);
    throw InputError(fmt::format("unknown request {}{} (accepted: {})", toml_string(word),
                                 did_you_mean(word, words), fmt::join(words, ", ")));
  }
  if (entry->changes == nullptr) {
    if (!value.empty())
      throw InputError(fmt::format("\"{}\" takes no value, found {}", word, toml_string(value)));
    return {entry->act};
  }
  if (value.empty()) {
    if (entry->act == Act::end) return {Act::end};
    throw InputError(fmt::format("\"{}\" needs a value", word));
  }
  const ParameterInfo info = parameter_of(entry->key);
  try {
    const double number = info.unit.empty() ? whole_number(value) : units::parse_quantity(value, info.unit);
    if (!std::isfinite(number) || !info.range.contains(number)) {
      throw InputError(fmt::format("must be {}{}{}, found {}", info.range.text(),
                                   info.unit.empty() ? "" : " ", info.unit, toml_string(value)));
    }
    return {entry->act, number};
  } catch (const InputError& error) {
    throw InputError(fmt::format("\"{}\": {}", word, error.what()));
  }
}

ParameterTable<RequestWords> RequestWords::parameters() {
  return {text("request", &RequestWords::request, "what is asked"),
          text("value", &RequestWords::value, "with its unit").optional()};
}

std::string number_of(const ActEntry& entry, const Schedule& schedule) {
  return units::format_quantity(schedule.*(entry.changes), parameter_of(entry.key).unit);
}

RequestWords read_request(const std::filesystem::path& file) {
  input::Document document = input::Document::from_file(file);
  RequestWords words;
  document.root().read(RequestWords::parameters(), words);
  document.finish();
  return words;
}

std::string request_toml(const std::string& word, const std::string& value) {
  return fmt::format("request = {}\n{}", toml_string(word),
                     value.empty() ? "" : fmt::format("value = {}\n", toml_string(value)));
}

}  // namespace whipple::run
