// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "src/core/base/tensor.hpp"
#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_kind.hpp"

namespace whipple::contact {

/// The fields of bodies whose cracks part: each divides into sectors, numbered behind the fields of all bodies.
class SectorFields {
 public:
  SectorFields() = default;
  /// @param bodies   number of fields of bodies
  /// @param cracked  those of them that divide
  SectorFields(unsigned bodies, std::span<const std::uint8_t> cracked, bool planar)
      : sectors_(grid::crack_sectors(planar)), bodies_(bodies), cracked_(cracked.begin(), cracked.end()) {}

  /// Returns the number of all fields.
  [[nodiscard]] unsigned count() const { return bodies_ + sectors_ * static_cast<unsigned>(cracked_.size()); }
  [[nodiscard]] std::span<const std::uint8_t> cracked() const { return cracked_; }
  [[nodiscard]] unsigned sectors() const { return sectors_; }
  /// Returns the field of a sector, from 0, of the n-th field that divides.
  [[nodiscard]] unsigned field(std::size_t n, unsigned sector) const {
    return bodies_ + sectors_ * static_cast<unsigned>(n) + sector;
  }
  /// Returns the field of a body with those of its sectors: a bit each.
  [[nodiscard]] std::uint64_t parts(unsigned body) const;
  /// Returns the field of the body of each field.
  [[nodiscard]] std::array<std::uint8_t, grid::maximum_fields> wholes() const;

 private:
  unsigned sectors_ = 0, bodies_ = 1;
  std::vector<std::uint8_t> cracked_;
};

/// Cracks: ridges of the smoothed damage of a body, at whose nodes it has two velocity fields, one on either side
/// (docs/theory/cracks.md). Every step finds its own.
class Cracks {
 public:
  explicit Cracks(SectorFields fields) : fields_(std::move(fields)), of_body_(fields_.cracked().size()) {}

  /// A crack at a node.
  struct Crack {
    Vector3 axis;          ///< unit vector from side A to side B
    std::uint64_t side_b;  ///< bit per field of the body on side B
    double gap = 0.0;      ///< m, between its faces along the axis; negative where they overlap
  };

  [[nodiscard]] const SectorFields& fields() const { return fields_; }
  /// Nodes of elements that move with the grid, which belong to the field of their body as a whole.
  struct ElementNodes {
    std::span<const Vector3> position;   ///< m
    std::span<const double> mass;        ///< kg
    std::span<const std::uint8_t> body;  ///< field of the body
  };
  /// Finds the cracks, and gives particles beside them the fields of their sectors in place of those of their bodies.
  /// After the particles were binned. Collective.
  void find(transfer::ShapeFunction shape, const Particles& particles, const ElementNodes& nodes,
            grid::BlockGrid& grid, std::vector<std::uint8_t>& field);
  /// Returns the crack of a body at a node of a slot of this rank, if there is one.
  [[nodiscard]] std::optional<Crack> at(unsigned body, std::size_t slot, std::size_t node) const;

 private:
  /// Bit per node of each slot; empty: none.
  using Nodes = std::vector<std::uint64_t>;
  /// Lanes of the nodes of a mask, in the order of the nodes.
  struct Values {
    grid::SlotValues of;
    std::size_t lanes = 1;
    void lay_out(const Nodes& nodes, std::size_t lanes_per_node, Lanes initial = Lanes{});
    [[nodiscard]] Lanes* at(const Nodes& nodes, std::size_t slot, std::size_t node) {
      const std::uint64_t before = nodes[slot] & ((std::uint64_t{1} << node) - 1);
      return &of.values[of.begin[slot] + lanes * static_cast<std::size_t>(std::popcount(before))];
    }
    [[nodiscard]] const Lanes* at(const Nodes& nodes, std::size_t slot, std::size_t node) const {
      const std::uint64_t before = nodes[slot] & ((std::uint64_t{1} << node) - 1);
      return &of.values[of.begin[slot] + lanes * static_cast<std::size_t>(std::popcount(before))];
    }
  };
  struct OfBody {
    Nodes nodes;     // with a crack
    Nodes laid_out;  // with values
    Values cracks;   // axis; side B
    Values extents;  // m, from the node: of side A along the axis, of side B against it
  };

  template <class Shape>
  void find_in(std::size_t number, const Particles& particles, const ElementNodes& nodes,
               grid::BlockGrid& grid, std::span<const std::uint8_t> body_of,
               std::vector<std::uint8_t>& field);

  SectorFields fields_;
  std::vector<OfBody> of_body_;  // of each field that divides
  std::vector<Vector3> direction_;
  std::vector<std::uint8_t> sector_;
};

}  // namespace whipple::contact
