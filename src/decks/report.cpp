// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "src/core/base/text_table.hpp"

namespace whipple::decks {
namespace {

std::string text_of(const Place& place) {
  if (place.line == 0) return "-";
  return place.file.empty()
             ? fmt::format("line {}", place.line)
             : fmt::format("{}, line {}", std::filesystem::path(place.file).filename().string(), place.line);
}

}  // namespace

std::size_t Import::count(Outcome outcome) const {
  return static_cast<std::size_t>(std::ranges::count(remarks, outcome, &Remark::outcome));
}

void Import::sort_remarks() {
  std::ranges::stable_sort(remarks, [](const Remark& a, const Remark& b) {
    return std::tie(a.place.file, a.place.line) < std::tie(b.place.file, b.place.line);
  });
}

std::string Import::report() const {
  std::string text = fmt::format("{}: {}, units {}\n\n", deck, grammar, units);
  std::vector<std::vector<std::string>> rows = {{"body", "particles of the deck", "mass g", "shape"}};
  for (const BodyRow& body : bodies) {
    rows.push_back({body.name, fmt::format("{:.0f}", body.particles), fmt::format("{:.6g}", 1e3 * body.mass),
                    body.shape});
  }
  text += text_table(rows, "lrrl");
  for (const Word<Outcome>& word : words(Outcome{})) {
    text += fmt::format("\n{} ({})\n", word.text, count(word.value));
    rows.clear();
    for (const Remark& remark : remarks) {
      if (remark.outcome != word.value) continue;
      rows.push_back({"", text_of(remark.place), remark.keyword, remark.text});
    }
    text += text_table(rows, "llll");
  }
  return text;
}

}  // namespace whipple::decks
