// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/splitting.hpp"

#include <fmt/format.h>

#include <cmath>

#include "src/case/case.hpp"
#include "src/case/shapes/points.hpp"

namespace whipple::cases {

ParameterTable<Splitting> Splitting::parameters() {
  return {
      choice("of", &Splitting::of,
             "gas, detonation products, liquid and vapour under pressure and without voids | all intact "
             "material as well, which avoids numerical fracture of stretched solids")
          .optional(),
      real("length", &Splitting::length, "", range::between(0.0, 2.0),
           "length (in cells) of a particle along its longest direction above which it is split in two; "
           "0: never. Particles of the shape function `gimp`, whose domains keep their size, are not split")
          .optional(),
      integer("maximum_generations", &Splitting::maximum_generations, range::between(0, 20),
              "largest number of successive splits of a particle")
          .optional(),
      integer("maximum_particles", &Splitting::maximum_particles, range::positive(),
              "number of particles of the run beyond which none is split; refused splits are counted "
              "(`refused_divisions`)")
          .optional()};
}

/// Adds a fault for a length below that of the particles: all of them would be split as often as the generations allow.
void Splitting::check(const Case& setup, const Faults& faults) const {
  for (const Body& body : setup.bodies) {
    const bool is_given = body.shape != nullptr && !body.shape->particles().empty();
    const double own = is_given ? largest_edge(body.shape->particles()) / setup.domain.cell_size
                                : std::cbrt(1.0 / static_cast<double>(body.discretization.per_cell));
    if (length == 0.0 || length >= own || !body.discretization.has_particles()) continue;
    faults.add("length",
               fmt::format("'length' is {}, and the particles of body \"{}\" are {:.3g} cells long "
                           "from the start: expected at least that, or 0 (never){}",
                           length, body.name, own,
                           is_given ? "; particles of a file want cells no smaller than they are" : ""));
    return;
  }
}

}  // namespace whipple::cases
