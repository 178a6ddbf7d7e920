// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <type_traits>

#include "src/case/shapes/shape.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"

namespace whipple::cases {

/// Supplies the reading of a shape that is constructed from its keys and the folder of the case, and the resolution of
/// the case if it takes one, with an InputError where that is not possible.
/// @tparam Kind  the shape
/// @tparam Keys  its keys, with `parameters()`
template <class Kind, class Keys>
struct Made {
  static std::string describe() { return describe_table(Keys::parameters()); }
  static void schema(input::Schema& value) { input::add_keys(value, Keys::parameters()); }
  static std::unique_ptr<Shape> read(input::Table& holder, const std::string& key) {
    auto table = holder.required_table(key);
    Keys keys;
    if (!table || !table->read(Keys::parameters(), keys)) return nullptr;
    try {
      if constexpr (std::is_constructible_v<Kind, Keys, std::filesystem::path, double>) {
        return std::make_unique<Kind>(keys, table->folder(), table->resolution());
      } else {
        return std::make_unique<Kind>(keys, table->folder());
      }
    } catch (const InputError& error) {
      holder.error_at(key, "'" + table->name() + "': " + error.what());
      return nullptr;
    }
  }

 private:
  Made() = default;
  friend Kind;
};

}  // namespace whipple::cases
