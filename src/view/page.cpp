// SPDX-License-Identifier: BSD-3-Clause
#include "src/view/page.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/pattern.hpp"
#include "src/io/run_directory.hpp"
#include "src/view/cloud.hpp"

namespace whipple::view {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t least_detail = 4096;

/// Returns the indices of the snapshots that a page shows.
std::vector<std::size_t> chosen_times(std::size_t available, std::size_t wanted) {
  const std::size_t count = std::min(available, std::max<std::size_t>(wanted, 1));
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) {
    chosen.push_back(count == 1 ? available - 1 : (i * (available - 1) + (count - 1) / 2) / (count - 1));
  }
  return chosen;
}

/// Returns the HTML elements that contain the clouds.
std::string packed_times(const analysis::Run& run, const std::vector<std::size_t>& times,
                         const CloudOptions& options) {
  std::string elements;
  for (const std::size_t index : times) {
    const analysis::SnapshotEntry& entry = run.snapshots[index];
    const std::string cloud = pack_cloud(run, analysis::read_snapshot(entry), options);
    elements += fmt::format(
        "<script type=\"application/octet-stream\" class=\"cloud\" data-time=\"{}\">{}</script>\n",
        entry.time, base64(gzipped(cloud)));
  }
  return elements;
}

std::string escaped(std::string_view text) {
  std::string html;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      default:
        html += letter;
    }
  }
  return html;
}

/// Replaces a placeholder of the template, which occurs once.
void fill(std::string& html, std::string_view mark, std::string_view text) {
  const std::size_t at = html.find(mark);
  if (at == std::string::npos) throw InternalError(fmt::format("page.html has no mark {}", mark));
  html.replace(at, mark.size(), text);
}

/// Returns the page without its clouds.
std::string empty_page(const analysis::Run& run, const fs::path& viewer) {
  std::string html = read_text(viewer / "page.html");
  const std::string script = joined_modules(viewer / "main.js");
  if (script.find("</script") != std::string::npos)
    throw InternalError("the viewer's modules end their own script");
  fill(html, "@TITLE@", escaped(run.title.empty() ? run.folder.filename().string() : run.title));
  fill(html, "@STYLE@", read_text(viewer / "style.css"));
  fill(html, "@SCRIPT@", script);
  return html;
}

void append_module(const fs::path& file, std::set<fs::path>& done, std::string& script) {
  if (!done.insert(file).second) return;
  static const Pattern import_line(R"(import \{[^}]*\} from '\./([a-z_]+\.js)';)");
  std::istringstream lines(read_text(file));
  std::string own;
  for (std::string line; std::getline(lines, line);) {
    if (const auto found = import_line.match(line)) {
      append_module(file.parent_path() / found->at(1), done, script);
    } else if (line.starts_with("import ")) {
      throw InputError(fmt::format("{}: error: imports otherwise than by one line: {}", file.string(), line));
    } else {
      constexpr std::string_view exported = "export ";
      own += line.starts_with(exported) ? line.substr(exported.size()) : line;
      own += '\n';
    }
  }
  script += own;
}

}  // namespace

std::string gzipped(std::string_view bytes) {
  constexpr int level = 6, window_of_gzip = 15 + 16, memory = 8;
  z_stream stream = {};
  if (bytes.size() > std::numeric_limits<uInt>::max())
    throw InputError("a snapshot is too large for the viewer");
  if (deflateInit2(&stream, level, Z_DEFLATED, window_of_gzip, memory, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw InternalError("zlib refuses to compress");
  }
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  // zlib does not write to its input, but its interface is not const.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // NOLINT
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());  // NOLINT
  stream.avail_out = static_cast<uInt>(packed.size());
  const int end = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (end != Z_STREAM_END) throw InternalError("zlib did not come to an end");
  return packed;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t i) {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U;
  };
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned group = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    for (const unsigned shift : {18U, 12U, 6U, 0U}) text += digits[group >> shift & 63U];
  }
  const std::size_t filled = (3 - bytes.size() % 3) % 3;
  text.replace(text.size() - filled, filled, filled, '=');
  return text;
}

std::string joined_modules(const fs::path& main) {
  std::set<fs::path> done;
  std::string script;
  append_module(main, done, script);
  return script;
}

Page make_page(const analysis::Run& run, const PageOptions& options, const fs::path& viewer) {
  if (run.snapshots.empty())
    throw InputError(fmt::format("{}: error: has no snapshots", run.folder.string()));
  std::string html = empty_page(run, viewer);
  const std::vector<std::size_t> times = chosen_times(run.snapshots.size(), options.times);
  const double room = options.most_bytes - static_cast<double>(html.size());
  Page page;
  page.times = times.size();
  const auto detail = [](double excess) { return static_cast<std::uint64_t>(std::ceil(excess)); };
  // The last snapshot compresses least: its size determines the number of particles.
  const std::string last = packed_times(run, {times.back()}, {options.fields, 1, options.bits});
  page.one_of = std::max<std::uint64_t>(
      1, detail(0.8 * static_cast<double>(last.size() * times.size()) / std::max(room, 1.0)));
  for (;;) {
    if (page.one_of > least_detail || room <= 0.0) {
      throw InputError(
          fmt::format("no page of {:.3g} MB can hold {} times: allow more, or ask for fewer times or fields",
                      1e-6 * options.most_bytes, times.size()));
    }
    const std::string clouds = packed_times(run, times, {options.fields, page.one_of, options.bits});
    const double excess = static_cast<double>(clouds.size()) / room;
    if (excess <= 1.0) {
      fill(html, "@CLOUDS@", clouds);
      page.html = std::move(html);
      return page;
    }
    page.one_of = std::max(page.one_of + 1, detail(static_cast<double>(page.one_of) * excess));
  }
}

std::size_t write_clouds(const analysis::Run& run, const std::vector<std::string>& fields,
                         const fs::path& folder) {
  if (run.snapshots.empty())
    throw InputError(fmt::format("{}: error: has no snapshots", run.folder.string()));
  make_folder(folder);
  for (const analysis::SnapshotEntry& entry : run.snapshots) {
    const std::string cloud = pack_cloud(run, analysis::read_snapshot(entry), {fields});
    io::write_text_atomically(folder / (entry.file.stem().string() + ".wpv.gz"), gzipped(cloud));
  }
  return run.snapshots.size();
}

}  // namespace whipple::view
