// SPDX-License-Identifier: BSD-3-Clause
#include "src/particles/history.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "src/core/base/error.hpp"

namespace whipple {

History::History(HistoryField declared) : field(std::move(declared)) {
  switch (field.rank) {
    case Rank::scalar:
      values.emplace<0>();
      break;
    case Rank::vector:
      values.emplace<1>();
      break;
    case Rank::symmetric_tensor:
      values.emplace<2>();
      break;
    case Rank::tensor:
      values.emplace<3>();
      break;
  }
}

const History* Histories::find(const std::string& name) const {
  const auto found = std::ranges::find_if(all_, [&](const History& h) { return h.field.name == name; });
  return found == all_.end() ? nullptr : &*found;
}

History& Histories::add(const HistoryField& field) {
  const auto place =
      std::ranges::find_if(all_, [&](const History& h) { return !(h.field.name < field.name); });
  if (place == all_.end() || place->field.name != field.name) return *all_.insert(place, History(field));
  const HistoryField& known = place->field;
  if (known.unit != field.unit || known.rank != field.rank || known.convection != field.convection) {
    throw InputError(fmt::format("two material models declare different history fields \"{}\"", field.name));
  }
  return *place;
}

void Histories::declare(const HistoryField& field, std::size_t count) {
  std::visit([&]<class Value>(
                 std::vector<Value>& values) { values.resize(count, neutral_value<Value>(field.neutral)); },
             add(field).values);
}

}  // namespace whipple
