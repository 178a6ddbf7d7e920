// SPDX-License-Identifier: BSD-3-Clause
#include "src/view/cloud.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <variant>

#include "src/core/base/error.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/random_bits.hpp"
#include "src/core/base/text.hpp"
#include "src/core/base/words.hpp"
#include "src/io/output_fields.hpp"

namespace whipple::view {
namespace {

static_assert(std::endian::native == std::endian::little, "the planes of a cloud are little endian");

/// Marks non-finite values: the largest number. The others divide the range of a field into equal steps.
template <class Number>
constexpr Number missing = std::numeric_limits<Number>::max();
constexpr std::uint16_t position_steps = 65535;

struct FieldOfCloud {
  std::string name, unit, meaning;
  bool codes = false;  ///< integer codes, stored unchanged
  std::function<double(std::size_t)> value;
};

bool is_code(const io::FieldFunction& function) {
  return std::holds_alternative<std::uint8_t (*)(const io::FieldSource&, std::size_t)>(function) ||
         std::holds_alternative<std::uint16_t (*)(const io::FieldSource&, std::size_t)>(function);
}

void add_velocity(const io::OutputField& field, const analysis::Snapshot& snapshot,
                  std::vector<FieldOfCloud>& fields) {
  const auto& velocity = snapshot.velocity;
  const std::string unit(field.unit);
  fields.push_back({"speed", unit, "magnitude of the velocity", false,
                    [&velocity](std::size_t i) { return velocity[i].norm(); }});
  for (const Eigen::Index axis : {0, 1, 2}) {
    const char letter = "xyz"[axis];
    fields.push_back({fmt::format("{}_{}", field.name, letter), unit,
                      fmt::format("{} along {}", field.name, letter), false,
                      [&velocity, axis](std::size_t i) { return velocity[i][axis]; }});
  }
}

std::vector<FieldOfCloud> fields_of(const analysis::Snapshot& snapshot) {
  std::map<std::string, const std::vector<double>*, std::less<>> left = {{"mass", &snapshot.mass}};
  for (const auto& [name, values] : snapshot.scalars) left[name] = &values;
  std::vector<FieldOfCloud> fields;
  const auto add = [&](const std::string& name, std::string unit, std::string meaning, bool codes,
                       const auto* values) {
    fields.push_back(
        {name, std::move(unit), std::move(meaning), codes, [values](std::size_t i) { return (*values)[i]; }});
  };
  for (const io::OutputField& field : io::output_fields()) {
    if (std::holds_alternative<Vector3 (*)(const io::FieldSource&, std::size_t)>(field.value)) {
      add_velocity(field, snapshot, fields);
    } else if (const auto found = left.find(field.name); found != left.end()) {
      add(found->first, std::string(field.unit), std::string(field.meaning), is_code(field.value),
          found->second);
      left.erase(found);
    }
  }
  for (const auto& [name, values] : left)
    add(name, "", "field that this program does not know", false, values);
  return fields;
}

std::vector<FieldOfCloud> chosen_fields(const analysis::Snapshot& snapshot,
                                        const std::vector<std::string>& names) {
  std::vector<FieldOfCloud> fields = fields_of(snapshot);
  if (names.empty()) return fields;
  const std::vector<std::string> known = cloud_fields(snapshot);
  for (const std::string& name : names) {
    if (std::ranges::find(known, name) == known.end()) {
      throw InputError(fmt::format("the snapshots have no field {}{}\nknown: {}", toml_string(name),
                                   did_you_mean(name, known), fmt::join(known, ", ")));
    }
  }
  std::erase_if(
      fields, [&](const FieldOfCloud& field) { return std::ranges::find(names, field.name) == names.end(); });
  return fields;
}

std::vector<std::size_t> kept_particles(const analysis::Snapshot& snapshot, std::uint64_t one_of) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    // Neighbours in a lattice have consecutive numbers: selecting every k-th one would be visible as stripes.
    if (scattered(snapshot.id[i]) % one_of == 0) kept.push_back(i);
  }
  if (kept.empty()) kept.push_back(0);
  return kept;
}

template <class Number>
void append_number(std::string& bytes, Number number) {
  const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  bytes.append(raw.data(), raw.size());
}

/// Holds the header and the planes written so far.
struct CloudFile {
  nlohmann::ordered_json header;
  std::string planes;

  /// Pads the planes to a multiple of four bytes, as typed arrays of a browser require.
  void end_plane() { planes.append((4 - planes.size() % 4) % 4, '\0'); }
};

void append_positions(const analysis::Snapshot& snapshot, const std::vector<std::size_t>& kept,
                      CloudFile& file) {
  Vector3 lower = snapshot.position[kept.front()], upper = lower;
  for (const std::size_t i : kept) {
    lower = lower.cwiseMin(snapshot.position[i]);
    upper = upper.cwiseMax(snapshot.position[i]);
  }
  file.header["lower"] = {lower.x(), lower.y(), lower.z()};
  file.header["upper"] = {upper.x(), upper.y(), upper.z()};
  for (const Eigen::Index axis : {0, 1, 2}) {
    const double size = upper[axis] - lower[axis];
    for (const std::size_t i : kept) {
      const double share = size > 0.0 ? (snapshot.position[i][axis] - lower[axis]) / size : 0.0;
      append_number(file.planes, static_cast<std::uint16_t>(std::lround(share * position_steps)));
    }
    file.end_plane();
  }
}

void append_codes(const FieldOfCloud& field, const std::vector<std::size_t>& kept, CloudFile& file) {
  double greatest = 0.0;
  for (const std::size_t i : kept) greatest = std::max(greatest, field.value(i));
  const bool narrow = greatest <= std::numeric_limits<std::uint8_t>::max();
  for (const std::size_t i : kept) {
    if (narrow) {
      append_number(file.planes, static_cast<std::uint8_t>(field.value(i)));
    } else {
      append_number(file.planes, static_cast<std::uint16_t>(field.value(i)));
    }
  }
  file.end_plane();
  file.header["fields"].push_back({{"name", field.name},
                                   {"unit", field.unit},
                                   {"meaning", field.meaning},
                                   {"type", narrow ? "u8" : "u16"},
                                   {"codes", true}});
}

template <class Number>
void append_reals(const FieldOfCloud& field, const std::vector<std::size_t>& kept, CloudFile& file) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const std::size_t i : kept) {
    const double value = field.value(i);
    if (!std::isfinite(value)) continue;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  if (lowest > highest) lowest = highest = 0.0;
  const double size = highest - lowest;
  constexpr double steps = missing<Number> - 1;
  for (const std::size_t i : kept) {
    const double value = field.value(i);
    const double share = size > 0.0 ? (value - lowest) / size : 0.0;
    append_number(file.planes,
                  std::isfinite(value) ? static_cast<Number>(std::lround(share * steps)) : missing<Number>);
  }
  file.end_plane();
  file.header["fields"].push_back({{"name", field.name},
                                   {"unit", field.unit},
                                   {"meaning", field.meaning},
                                   {"type", sizeof(Number) == 1 ? "u8" : "u16"},
                                   {"lo", lowest},
                                   {"hi", highest}});
}

/// Appends the increments of the ascending numbers: mostly zeros and ones, which compress to almost nothing.
void append_ids(const analysis::Snapshot& snapshot, const std::vector<std::size_t>& kept, CloudFile& file) {
  std::uint64_t last = 0;
  for (const std::size_t i : kept) {
    const std::uint64_t step = snapshot.id[i] - last;
    if (step > std::numeric_limits<std::uint32_t>::max()) {
      throw InputError(
          fmt::format("the number of particle {} is too far from that of the next", snapshot.id[i]));
    }
    append_number(file.planes, static_cast<std::uint32_t>(step));
    last = snapshot.id[i];
  }
  file.end_plane();
  file.header["fields"].push_back({{"name", "id"},
                                   {"unit", ""},
                                   {"meaning", "number of the particle, kept for its life"},
                                   {"type", "u32"},
                                   {"increments", true}});
}

/// Returns the direction in which one body flies at another at the start: of the two with the largest relative velocity,
/// that of the faster one, of equally fast ones that of the first; none if all bodies move alike.
std::optional<Vector3> flight_of(const analysis::Run& run) {
  Vector3 flight = Vector3::Zero();
  for (std::size_t a = 0; a < run.bodies.size(); ++a) {
    for (std::size_t b = a + 1; b < run.bodies.size(); ++b) {
      const Vector3 &of_a = run.bodies[a].velocity, &of_b = run.bodies[b].velocity;
      const Vector3 relative = of_a - of_b;
      if (!(relative.norm() > (1.0 + 1e-9) * flight.norm())) continue;
      flight = of_b.norm() > (1.0 + 1e-9) * of_a.norm() ? Vector3(-relative) : relative;
    }
  }
  const double size = flight.norm();
  if (!(size > 0.0)) return std::nullopt;
  return Vector3(flight / size);
}

nlohmann::ordered_json header_of(const analysis::Run& run, const analysis::Snapshot& snapshot,
                                 std::size_t kept, std::uint64_t one_of) {
  nlohmann::ordered_json header = {{"n", kept},          {"of", snapshot.size()},
                                   {"one_of", one_of},   {"time", snapshot.time},
                                   {"title", run.title}, {"dimension", std::string(word_of(run.dimension))}};
  for (const std::optional<double>& plane : run.mirror_planes) {
    header["mirrors"].push_back(plane ? nlohmann::ordered_json(*plane) : nlohmann::ordered_json());
  }
  for (const analysis::BodyInput& body : run.bodies) {
    header["bodies"].push_back({{"name", body.name}, {"spacing", body.spacing}});
  }
  if (const std::optional<Vector3> flight = flight_of(run))
    header["flight"] = {flight->x(), flight->y(), flight->z()};
  header["fields"] = nlohmann::ordered_json::array();
  return header;
}

}  // namespace

std::vector<std::string> cloud_fields(const analysis::Snapshot& snapshot) {
  std::vector<std::string> names;
  for (const FieldOfCloud& field : fields_of(snapshot)) names.push_back(field.name);
  return names;
}

std::string pack_cloud(const analysis::Run& run, const analysis::Snapshot& snapshot,
                       const CloudOptions& options) {
  if (snapshot.size() == 0)
    throw InputError(fmt::format("the snapshot at {} s has no particles", snapshot.time));
  const std::vector<std::size_t> kept = kept_particles(snapshot, std::max<std::uint64_t>(options.one_of, 1));
  CloudFile file;
  file.header = header_of(run, snapshot, kept.size(), std::max<std::uint64_t>(options.one_of, 1));
  append_positions(snapshot, kept, file);
  append_ids(snapshot, kept, file);
  const FieldOfCloud body = {"body", "", "number of the body in the case, from 0", true,
                             [&](std::size_t i) { return snapshot.body[i]; }};
  append_codes(body, kept, file);
  for (const FieldOfCloud& field : chosen_fields(snapshot, options.fields)) {
    if (field.codes) {
      append_codes(field, kept, file);
    } else if (options.bits == 8) {
      append_reals<std::uint8_t>(field, kept, file);
    } else {
      append_reals<std::uint16_t>(field, kept, file);
    }
  }
  std::string header = json_text(file.header, -1);
  header.append((4 - header.size() % 4) % 4, ' ');
  std::string bytes = "WPV1";
  append_number(bytes, static_cast<std::uint32_t>(header.size()));
  return bytes + header + file.planes;
}

}  // namespace whipple::view
