// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "eos/files/sesame.hpp"
#include "eos/files/sesame_layout.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"

namespace whipple::eos {
namespace {

namespace fs = std::filesystem;
using namespace sesame_layout;

class Writer {
 public:
  explicit Writer(const fs::path& path) : path_(path) {}

  void header(const SesameMaterial& material, int table, std::size_t words) {
    if (words > most_words) {
      throw InputError(
          fmt::format("{}: table {} has {} words, a SESAME file holds {} at most: take fewer grid points",
                      path_.string(), table, words, most_words));
    }
    fmt::format_to(std::back_inserter(text_), "{:2d}{:6d}{:6d}{:6d}   r{:9d}{:9d}{:4d}{:34d}\n",
                   text_.empty() ? 0 : 1, material.number, table, words, material.created, material.changed,
                   1, 1);
  }

  void comment(const SesameMaterial& material) {
    std::string text = material.comment;
    std::ranges::replace(text, '\n', ' ');
    text.resize(std::max<std::size_t>(1, (text.size() + comment_width - 1) / comment_width) * comment_width,
                ' ');
    header(material, 101, text.size());
    for (std::size_t at = 0; at < text.size(); at += comment_width)
      text_ += text.substr(at, comment_width) + '\n';
  }

  void add(double value, double unit) { words_.push_back(value / unit); }
  void add(const std::vector<double>& values, double unit) {
    for (const double value : values) add(value, unit);
  }

  void table(const SesameMaterial& material, int number) {
    header(material, number, words_.size());
    for (std::size_t at = 0; at < words_.size(); at += words_per_line) {
      const std::size_t count = std::min(words_per_line, words_.size() - at);
      std::string line;
      for (std::size_t i = 0; i < count; ++i) line += word(material, number, words_[at + i]);
      // One flag per word of the line: 1 if it is present.
      line.resize(words_per_line * word_width, ' ');
      text_ += line + std::string(count, '1') + std::string(words_per_line - count, '0') + '\n';
    }
    words_.clear();
  }

  void finish() {
    text_ += fmt::format(" 2{:>78}\n", 2);
    write_text_atomically(path_, text_);
  }

 private:
  [[nodiscard]] std::string word(const SesameMaterial& material, int table, double value) const {
    if (!std::isfinite(value)) {
      throw InputError(fmt::format("{}: table {} of material {} would hold a number that is not finite",
                                   path_.string(), table, material.number));
    }
    std::string text = fmt::format("{:15.8E}", value);
    // Fortran drops the E before three digits of exponent.
    constexpr std::size_t usual_exponent = 4;
    if (const std::size_t e = text.find('E'); text.size() - e > usual_exponent) text.erase(e, 1);
    return fmt::format("{:>{}}", text, word_width);
  }

  fs::path path_;
  std::string text_;
  std::vector<double> words_;
};

}  // namespace

void write_sesame(const fs::path& path, std::span<const SesameMaterial> materials) {
  Writer writer(path);
  for (const SesameMaterial& m : materials) {
    if (m.number < 1 || m.number > 999999) {
      throw InputError(fmt::format("{}: material number {}: expected 1 to 999999", path.string(), m.number));
    }
    writer.comment(m);
    writer.add(m.atomic_number, 1);
    writer.add(m.atomic_mass, g_mol);
    writer.add(m.reference_density, Mg_m3);
    writer.add(m.bulk_modulus, GPa);
    writer.add(m.exchange_coefficient, 1);
    writer.table(m, 201);

    writer.add(static_cast<double>(m.total.density.size()), 1);
    writer.add(static_cast<double>(m.total.temperature.size()), 1);
    writer.add(m.total.density, Mg_m3);
    writer.add(m.total.temperature, K);
    writer.add(m.total.pressure, GPa);
    writer.add(m.total.energy, MJ_kg);
    writer.add(m.total.helmholtz, MJ_kg);
    writer.table(m, 301);

    const SesameVaporisation& v = m.vaporisation;
    if (v.temperature.empty()) continue;
    writer.add(static_cast<double>(v.temperature.size()), 1);
    writer.add(v.pressure, GPa);
    writer.add(v.temperature, K);
    writer.add(v.vapour_density, Mg_m3);
    writer.add(v.liquid_density, Mg_m3);
    writer.add(v.vapour_energy, MJ_kg);
    writer.add(v.liquid_energy, MJ_kg);
    writer.add(v.vapour_helmholtz, MJ_kg);
    writer.add(v.liquid_helmholtz, MJ_kg);
    writer.table(m, 401);
  }
  writer.finish();
}

}  // namespace whipple::eos
