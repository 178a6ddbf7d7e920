// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/build/tables.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <utility>

#include "eos/files/table_file.hpp"
#include "eos/table/table_of_model.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/progress.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::cases {
namespace {

std::shared_ptr<const Material> tabulated(const Material& material, double error) {
  std::optional<Progress> progress;
  const eos::ForEach for_each = [](std::size_t n, const std::function<void(std::size_t)>& body) {
    parallel::for_each_uneven(n, body);
  };
  eos::TableData data = eos::cached_table(*material.eos, {.error = error}, eos::table_cache(),
                                          material.file.stem().string(), for_each, [&](double share) {
                                            if (!progress) progress.emplace("table", 1.0);
                                            progress->update(share, material.name);
                                          });
  log::detail("{}: table of {} kB, error {:.2g}", material.name, data.size() / 1000, error);
  auto table = std::make_shared<const eos::TableOfModel>(eos::Table(std::move(data)), material.eos);
  return std::make_shared<const Material>(with_eos(material, std::move(table)));
}

bool is_table(const Material& material) {
  return dynamic_cast<const eos::TableOfModel*>(material.eos.get()) != nullptr;
}

void replace_models(Case& setup) {
  // Bodies that share a material also share its table.
  std::map<std::pair<std::shared_ptr<const Material>, double>, std::shared_ptr<const Material>> tables;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Body& body = setup.bodies[b];
    if (body.equation_of_state != Evaluation::table || is_table(*setup.materials[b])) continue;
    auto& table = tables[{setup.materials[b], body.table_error}];
    try {
      if (!table) table = tabulated(*setup.materials[b], body.table_error);
    } catch (const InputError& error) {
      throw InputError(
          fmt::format("body \"{}\", equation_of_state = \"table\": {}", body.name, error.what()));
    }
    setup.materials[b] = table;
  }
}

}  // namespace

void tabulate_materials(Case& setup, const io::Ranks& ranks) {
  // The root runs first: the other ranks read its tables from the cache. Without a cache, all ranks build the same
  // tables.
  ranks.on_root([&] { replace_models(setup); });
  if (!ranks.is_root()) replace_models(setup);
}

}  // namespace whipple::cases
