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

/// Numbers the fields of bodies that are divided at cracks: each such body has a field per sector, numbered after the
/// fields of all bodies.
class SectorFields {
 public:
  SectorFields() = default;
  /// @param bodies   number of fields of bodies
  /// @param cracked  fields of the bodies that are divided
  SectorFields(unsigned bodies, std::span<const std::uint8_t> cracked, bool planar)
      : sectors_(grid::crack_sectors(planar)), bodies_(bodies), cracked_(cracked.begin(), cracked.end()) {}

  /// Returns the number of all fields.
  [[nodiscard]] unsigned count() const { return bodies_ + sectors_ * static_cast<unsigned>(cracked_.size()); }
  [[nodiscard]] std::span<const std::uint8_t> cracked() const { return cracked_; }
  [[nodiscard]] unsigned sectors() const { return sectors_; }
  /// Returns the field of a sector, counted from 0, of the n-th divided body.
  [[nodiscard]] unsigned field(std::size_t n, unsigned sector) const {
    return bodies_ + sectors_ * static_cast<unsigned>(n) + sector;
  }
  /// Returns the fields of a body and of its sectors.
  [[nodiscard]] grid::FieldSet parts(unsigned body) const;
  /// Returns, for each field, the field of its body.
  [[nodiscard]] std::array<std::uint8_t, grid::maximum_fields> wholes() const;

 private:
  unsigned sectors_ = 0, bodies_ = 1;
  std::vector<std::uint8_t> cracked_;
};

/// Finds cracks: ridges of the smoothed damage of a body. At their nodes the body has two velocity fields, one on each
/// side (docs/theory/cracks.md). They are determined again in every step.
class Cracks {
 public:
  explicit Cracks(SectorFields fields) : fields_(std::move(fields)), of_body_(fields_.cracked().size()) {}

  /// Describes a crack at a node.
  struct Crack {
    Vector3 axis;          ///< unit vector from side A to side B
    std::uint64_t side_b;  ///< one bit per field of the body on side B
    double gap = 0.0;      ///< between the faces along the axis, m; negative where they overlap
  };

  [[nodiscard]] const SectorFields& fields() const { return fields_; }
  /// Holds the element nodes that move with the grid; they belong to the undivided field of their body.
  struct ElementNodes {
    std::span<const Vector3> position;   ///< m
    std::span<const double> mass;        ///< kg
    std::span<const std::uint8_t> body;  ///< field of the body
  };
  /// Finds the cracks and assigns the particles near them to the fields of their sectors instead of those of their
  /// bodies. Call after the particles were binned. Collective.
  /// @param field  velocity field of each particle: that of its body on entry
  void find(transfer::ShapeFunction shape, const Particles& particles, const ElementNodes& nodes,
            grid::BlockGrid& grid, std::vector<std::uint8_t>& field);
  /// Returns the crack of a body at a node of one of this rank's slots, if there is one.
  [[nodiscard]] std::optional<Crack> at(unsigned body, std::size_t slot, std::size_t node) const;

 private:
  /// One bit per node of each slot; empty: no nodes.
  using Nodes = std::vector<std::uint64_t>;
  /// Holds the values of the nodes of a mask, in the order of the nodes.
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
    Nodes nodes;     // at a crack
    Nodes laid_out;  // with values
    Values cracks;   // axis and side B
    Values extents;  // m, from the node: of side A along the axis, of side B in the opposite direction
  };

  template <class Shape>
  void find_in(std::size_t number, const Particles& particles, const ElementNodes& nodes,
               grid::BlockGrid& grid, std::span<const std::uint8_t> body_of,
               std::vector<std::uint8_t>& field);

  SectorFields fields_;
  std::vector<OfBody> of_body_;  // of each divided body
  std::vector<Vector3> direction_;
  std::vector<std::uint8_t> sector_;
};

}  // namespace whipple::contact
