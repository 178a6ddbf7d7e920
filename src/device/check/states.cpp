// SPDX-License-Identifier: BSD-3-Clause
#include "src/device/check/states.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <type_traits>

namespace whipple::device::check {
namespace {

constexpr std::array<char, 8> magic = {'W', 'H', 'I', 'P', 'S', 'T', 'A', 'T'};
constexpr std::uint32_t version = 1;
constexpr std::uint32_t most_items = 1U << 28U;  // of a list: a longer one is none

/// Sizes of what is stored as it lies in memory: a file with others was written by another program.
constexpr std::array<std::uint32_t, 12> sizes = {
    0x01020304,  // order of bytes
    state_components,
    all_components,
    stored_sums,
    sizeof(Mirror),
    sizeof(LossConstants),
    sizeof(ContactConstants),
    sizeof(WallConstants),
    sizeof(DomainLimits),
    sizeof(ConductingBody),
    sizeof(DomainsOfBody),
    sizeof(MaterialConstants),
};

enum class Column : std::uint8_t { one_number, as_before, numbers };

class Writer {
 public:
  explicit Writer(const std::filesystem::path& file) : out_(file, std::ios::binary) {}
  template <class T>
  void value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    out_.write(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  template <class T>
  void list(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(static_cast<std::uint64_t>(values.size()));
    out_.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(T)));
  }
  void text(const std::string& text) { list(std::vector<char>(text.begin(), text.end())); }
  /// @param before  of the same particles; null: none
  void points(const PointsOnHost& points, const PointsOnHost* before) {
    list(points.body);
    list(points.origin);
    for (std::size_t c = 0; c < state_components; ++c) {
      const std::vector<double>& column = points.numbers[c];
      const auto same = [&](double x) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(column.front());
      };
      if (!column.empty() && std::ranges::all_of(column, same)) {
        value(Column::one_number);
        value(column.front());
      } else if (before != nullptr && before->numbers[c].size() == column.size() &&
                 std::memcmp(column.data(), before->numbers[c].data(), column.size() * sizeof(double)) == 0) {
        value(Column::as_before);
      } else {
        value(Column::numbers);
        list(column);
      }
    }
  }
  [[nodiscard]] bool end() { return static_cast<bool>(out_.flush()); }

 private:
  std::ofstream out_;
};

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file.string()), in_(file, std::ios::binary) {
    if (!in_) wrong("cannot be read");
    std::error_code error;
    left_ = std::filesystem::file_size(file, error);
    if (error) wrong("cannot be read");
  }
  [[noreturn]] void wrong(const std::string& why) const { throw WrongInput(file_ + ": error: " + why); }
  template <class T>
  void value(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    take(&value, sizeof(T));
  }
  template <class T>
  void list(std::vector<T>& values) {
    std::uint64_t size = 0;
    value(size);
    if (size > most_items || size * sizeof(T) > left_) truncated();
    values.resize(size);
    take(values.data(), size * sizeof(T));
  }
  void text(std::string& text) {
    std::vector<char> letters;
    list(letters);
    text.assign(letters.begin(), letters.end());
  }
  void points(PointsOnHost& points, const PointsOnHost* before) {
    list(points.body);
    list(points.origin);
    const std::size_t n = points.size();
    if (points.origin.size() != n) wrong("the lists of a state differ in length");
    for (std::size_t c = 0; c < state_components; ++c) {
      std::vector<double>& column = points.numbers[c];
      Column kind{};
      value(kind);
      if (kind == Column::one_number) {
        double number = 0.0;
        value(number);
        column.assign(n, number);
      } else if (kind == Column::as_before && before != nullptr) {
        column = before->numbers[c];
      } else if (kind == Column::numbers) {
        list(column);
      } else {
        wrong("a component is stored in no known way");
      }
      if (column.size() != n) wrong("the lists of a state differ in length");
    }
  }
  void end() const {
    if (left_ != 0) wrong("is longer than its state");
  }

 private:
  void take(void* to, std::size_t size) {
    if (size == 0) return;
    if (size > left_ || !in_.read(static_cast<char*>(to), static_cast<std::streamsize>(size))) truncated();
    left_ -= size;
  }
  [[noreturn]] void truncated() const { wrong("is truncated, or no state at all"); }

  std::string file_;
  std::ifstream in_;
  std::uint64_t left_ = 0;
};

/// Calls f.value or f.list for all parts of a problem.
template <class F, class P>
void visit(F& f, P& p) {
  f.value(p.dimension), f.value(p.cell_size), f.value(p.lower), f.value(p.cells), f.value(p.faces),
      f.value(p.mirrors);
  f.value(p.slope_smoothing), f.value(p.kappa), f.value(p.losses);
  f.value(p.shock_conduction), f.value(p.conduction_onset), f.value(p.conduction_rise);
  f.value(p.strong_pressure), f.value(p.filled), f.value(p.fields);
  f.value(p.contact), f.value(p.walls), f.value(p.domain_limits);
  f.list(p.field_of_body), f.list(p.initial_density), f.list(p.conducting);
  f.list(p.domains), f.list(p.materials), f.list(p.tables);
}

/// Calls the functions of f for all parts of a state behind its head.
template <class F, class S>
void visit_content(F& f, S& state) {
  f.text(state.name), f.text(state.what);
  visit(f, state.problem);
  f.list(state.steps);
  f.points(state.start, nullptr);
  f.points(state.first.points, &state.start);
  f.points(state.last.points, &state.first.points);
  f.value(state.first.totals), f.value(state.last.totals);
}

/// Checks what the kernels rely on.
void require_whole(const StoredState& state, const Reader& reader) {
  const Problem& p = state.problem;
  const std::size_t bodies = p.field_of_body.size();
  for (const std::size_t size :
       {p.initial_density.size(), p.conducting.size(), p.domains.size(), p.materials.size()}) {
    if (size != bodies) reader.wrong("the lists of bodies differ in length");
  }
  if (!(p.cell_size > 0.0) || std::ranges::any_of(p.cells, [](int n) { return n < 1; }))
    reader.wrong("has no cells");
  if (std::ranges::any_of(p.field_of_body, [&](std::uint8_t field) { return field >= p.fields; }))
    reader.wrong("a body is in no field");
  if (state.steps.empty() || state.start.size() == 0) reader.wrong("has no steps or no particles");
  for (const PointsOnHost* points : {&state.start, &state.first.points, &state.last.points}) {
    const auto is_none = [&](std::uint32_t body) { return body >= bodies; };
    const auto is_new = [&](std::uint32_t origin) { return origin >= state.start.size(); };
    if (std::ranges::any_of(points->body, is_none) || std::ranges::any_of(points->origin, is_new))
      reader.wrong("a particle is of no body or was not there at the start");
  }
}

}  // namespace

void write_state(const std::filesystem::path& file, const StoredState& state) {
  Writer out(file);
  out.value(magic);
  out.value(version);
  out.value(sizes);
  out.text(state.revision);
  visit_content(out, state);
  if (!out.end()) throw std::runtime_error(file.string() + ": error: cannot be written");
}

StoredState read_state(const std::filesystem::path& file) {
  Reader in(file);
  std::array<char, 8> of_file{};
  std::uint32_t of_version = 0;
  in.value(of_file);
  if (of_file != magic) in.wrong("is no state (whipple bench --states writes them)");
  in.value(of_version);
  if (of_version != version)
    in.wrong("is of version " + std::to_string(of_version) + "; this program reads " +
             std::to_string(version));
  auto of_sizes = sizes;
  in.value(of_sizes);
  StoredState state;
  in.text(state.revision);
  if (of_sizes != sizes)
    in.wrong("was written by other sources (" + state.revision + "): its structures have other sizes");
  visit_content(in, state);
  in.end();
  require_whole(state, in);
  return state;
}

}  // namespace whipple::device::check
