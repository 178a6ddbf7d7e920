// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/run.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "src/core/base/log.hpp"
#include "src/core/base/text.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/run_directory.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/setup/remarks.hpp"
#include "src/setup/tables.hpp"
#include "src/run/preparation.hpp"
#include "src/run/runner.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::run {
namespace {

namespace fs = std::filesystem;

/// Name of a run: the folder of its case, or the file if that is not called case.toml.
std::string run_name(const fs::path& case_file) {
  const std::string stem = case_file.stem().string();
  if (stem != "case") return stem;
  const std::string folder = fs::absolute(case_file).parent_path().filename().string();
  return folder.empty() ? stem : folder;
}

/// Material files as they lie in the run directory, so that a restart does not depend on files elsewhere.
std::vector<std::string> material_copies(const setup::Case& setup) {
  std::vector<std::string> names;
  std::map<std::string, fs::path> taken;
  for (const auto& material : setup.materials) {
    std::string name = material->file.filename().string();
    for (int i = 2; taken.contains(name) && taken[name] != material->file; ++i) {
      name = fmt::format("{}_{}.toml", material->file.stem().string(), i);
    }
    taken[name] = material->file;
    names.push_back("materials/" + name);
  }
  return names;
}

std::string provenance(const setup::Case& setup, const std::string& program, int ranks) {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return fmt::format(
      "\n[provenance]\nprogram = {}\ncase_file = {}\nmachine = {}\nranks = {}\nthreads = {}\nstarted = {}\n",
      toml_string(program), toml_string(setup.file.string()), toml_string(host.data()), ranks,
      parallel::threads(),
      toml_string(fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::chrono::system_clock::to_time_t(
                                                          std::chrono::system_clock::now())))));
}

io::RunDirectory new_directory(const setup::Case& setup, const fs::path& path, const RunOptions& options,
                               const io::Ranks& ranks) {
  const std::string name = run_name(setup.file);
  std::optional<io::RunDirectory> created;
  ranks.on_root([&] {
    created = io::RunDirectory::create(path, name, options.force);
    const io::RunDirectory& directory = *created;
    const std::vector<std::string> copies = material_copies(setup);
    fs::create_directories(directory.path() / "materials");
    for (std::size_t b = 0; b < copies.size(); ++b) {
      io::write_text_atomically(directory.path() / copies[b], io::read_text(setup.materials[b]->file));
      for (const fs::path& companion : setup.materials[b]->companions) {
        const fs::path copy = (directory.path() / copies[b]).parent_path() / companion;
        fs::create_directories(copy.parent_path());
        fs::copy_file(setup.materials[b]->file.parent_path() / companion, copy,
                      fs::copy_options::overwrite_existing);
      }
    }
    directory.write_input(setup::to_toml(setup, copies) + provenance(setup, options.program, ranks.count()));
  });
  return created ? *created : io::RunDirectory::open(path, name);
}

fs::path output_directory(const RunOptions& options, const fs::path& case_file) {
  return options.output_directory.empty() ? fs::path("run") / run_name(case_file) : options.output_directory;
}

}  // namespace

int run_case(const RunOptions& options) {
  const io::Ranks ranks(parallel::world());
  if (!ranks.is_root()) log::set_level(log::Level::quiet);
  set_threads(options.threads, parallel::world());
  if (options.restart) {
    std::shared_ptr<const FileLock> lock;  // before anything is read that another run may write
    ranks.on_root([&] { lock = io::lock_run(options.output_directory); });
    const fs::path input = options.output_directory / "run.toml";
    setup::Case setup = setup::read_case(input, options.overrides);
    setup::tabulate_materials(setup, ranks);
    io::Checkpoint checkpoint =
        io::read_latest_checkpoint(options.output_directory / "checkpoint", parallel::world());
    const io::RunDirectory directory =
        io::RunDirectory::open(options.output_directory, checkpoint.values.text("run_name"));
    if (ranks.is_root()) log::add_file(directory.log_file());
    ranks.on_root([&] { directory.remove_partial_files(); });
    std::string changed_input;
    if (!options.overrides.empty()) {
      std::vector<std::string> materials;  // the copies in the run directory
      for (const setup::Body& body : setup.bodies) materials.push_back(body.material);
      changed_input = setup::to_toml(setup, materials) + provenance(setup, options.program, ranks.count());
    }
    return run_steps(setup, directory, std::move(checkpoint), changed_input, options, ranks);
  }
  setup::Case setup = setup::read_case(options.case_file, options.overrides);
  require_memory(setup, parallel::world());
  setup::tabulate_materials(setup, ranks);
  const io::RunDirectory directory =
      new_directory(setup, output_directory(options, options.case_file), options, ranks);
  if (ranks.is_root()) log::add_file(directory.log_file());
  log::info("{}: {}", setup.title.empty() ? directory.name() : setup.title, directory.path().string());
  for (const std::string& remark : setup::remarks(setup)) log::warning("{}", remark);
  return run_steps(setup, directory, options, ranks);
}

}  // namespace whipple::run
