// SPDX-License-Identifier: BSD-3-Clause
#include "src/solids/step.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/text.hpp"

namespace whipple::solids {
namespace {

constexpr std::string_view mark = "ISO-10303-21";

StepMesher& registered() {
  static StepMesher mesher;
  return mesher;
}

}  // namespace

void set_step_mesher(StepMesher mesher) { registered() = std::move(mesher); }

bool is_step(const std::filesystem::path& path) {
  std::ifstream file = regular_file(path);
  std::string begin(200, '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(file.gcount()));
  const std::size_t first = begin.find_first_not_of(" \t\r\n");
  return first != std::string::npos && std::string_view(begin).substr(first).starts_with(mark);
}

void triangulate_step(const std::filesystem::path& step, double edge, const std::filesystem::path& stl) {
  const std::string file = utf8(step.string());
  if (read_text(step).find("LENGTH_UNIT") == std::string::npos) {
    throw InputError(fmt::format("{}: a STEP file without a unit of length", file));
  }
  if (!registered()) {
    throw InputError(
        fmt::format("{}: a STEP file, which this program does not triangulate: save it as STL", file));
  }
  registered()(step, edge, stl);
}

}  // namespace whipple::solids
