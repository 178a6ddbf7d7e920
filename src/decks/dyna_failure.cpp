// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/decks/unit_system.hpp"

namespace whipple::decks::dyna {
namespace {

/// Returns the failure strain at the reference rate and temperature.
double failure_strain(const DamageConstants& d, double d3, double triaxiality) {
  return d[0] + d[1] * std::exp(d3 * triaxiality);
}

}  // namespace

double d3_of_tension(const DamageConstants& d, Triaxiality triaxiality, const std::string& part,
                     const Block& material, Import& import) {
  const double given = d[2];
  if (given == 0.0 || triaxiality == Triaxiality::tension) return given;
  if (triaxiality == Triaxiality::pressure) return -given;
  const bool turned = d[1] * given > 0.0;  // unchanged, tension would fail later
  const double taken = turned ? -given : given;
  const std::string both = fmt::format(
      "failure strain in tension (triaxiality 1) {:.3g} with D3 = {}, {:.3g} with {}; --triaxiality says "
      "which "
      "stress counts positive in the deck",
      failure_strain(d, taken, 1.0), number(taken), failure_strain(d, -taken, 1.0), number(-taken));
  const std::string keyword = "*" + material.keyword;
  if (turned) {
    import.doubt(place_of(material), keyword,
                 fmt::format("{}: D3 = {} is taken as {}, so that tension breaks earlier: {}", part,
                             number(given), number(taken), both));
  } else {
    import.remark(Outcome::converted, place_of(material), keyword,
                  fmt::format("{}: D3 as it stands, with which tension breaks earlier: {}", part, both));
  }
  return taken;
}

void remark_on_failure_strain(const DamageConstants& d, double least, const std::string& part,
                              const Block& material, Import& import) {
  for (const auto& [triaxiality, called] :
       {std::pair{0.0, "shear"}, std::pair{1.0 / 3.0, "uniaxial tension"}}) {
    const double strain = failure_strain(d, d[2], triaxiality);
    if (strain > std::max(least, 0.0)) continue;
    import.doubt(place_of(material), "*" + material.keyword,
                 fmt::format("{}: D1 + D2 exp(D3 sigma*) is {:.3g} in {}: the material fails as soon as it "
                             "yields, at the least failure strain",
                             part, strain, called));
    return;
  }
}

}  // namespace whipple::decks::dyna
