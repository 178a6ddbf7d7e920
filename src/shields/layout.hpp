// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/core/base/words.hpp"
#include "src/shields/shield.hpp"

namespace whipple::shields {

/// Selects what is computed: a section through the axis (normal impact), or space with mirror planes, a quarter of a
/// normal impact and half of an oblique one.
enum class Model : std::uint8_t { section, space };
constexpr std::array<Word<Model>, 2> words(Model) {
  return {{{Model::section, "section"}, {Model::space, "space"}}};
}

/// Selects what stands for foam: a porous material of its density, or the struts of random cells.
enum class FoamModel : std::uint8_t { layer, struts };
constexpr std::array<Word<FoamModel>, 2> words(FoamModel) {
  return {{{FoamModel::layer, "layer"}, {FoamModel::struts, "struts"}}};
}

/// Holds what may be chosen of a case.
struct CaseOptions {
  Model model = Model::section;
  FoamModel foam = FoamModel::layer;
  std::uint64_t seed = 1;                ///< selects one of many random foams
  std::optional<double> cell_size = {};  ///< m, instead of the rule
  double most_across = 32.0;             ///< most cells across the sphere by the rule
};

/// Describes the extent of a sheet in the case, m.
struct Plate {
  std::string name;
  double front = 0.0;  ///< coordinate of its front face along the normal
  double thickness = 0.0;
  std::array<double, 2> along =
      {};                ///< in the plane of an oblique flight; of a disc minus and plus its radius
  double radius = 0.0;   ///< of a disc, and half of the width across that plane
  double cells = 0.0;    ///< across its thickness
  bool resolved = true;  ///< at least two cells
};

/// Describes cells, extents and times of a case.
struct Layout {
  Model model = Model::section;
  double cell_size = 0.0;     ///< m
  std::string chosen_by;      ///< why that cell size
  double cells_across = 0.0;  ///< the sphere
  std::vector<Plate> plates;  ///< bumpers, and the wall at last
  std::optional<Plate> foam;  ///< between bumper and wall
  FoamModel foam_model = FoamModel::layer;
  std::uint64_t seed = 1;                        ///< of the cells of the foam
  std::array<double, 3> lower = {}, upper = {};  ///< of the domain, m; the normal is z
  double end = 0.0;                              ///< s, at the latest
  double snapshot_every = 0.0;                   ///< s
  double particles = 0.0;                        ///< estimate
};

/// Chooses cells, extents and times of the case of an impact (docs/manual/shields.md, "Cells and extents").
/// @throws InputError if the impact cannot be modelled: a section of an oblique flight or of struts,
/// stuffing, foam of several bumpers, of unknown cells or of a density that no layer of the library has
Layout layout_of(const Impact& impact, const CaseOptions& options);

/// Lists the sheets thinner than two cells, for messages; empty: none.
std::string not_resolved(const Layout& layout);

}  // namespace whipple::shields
