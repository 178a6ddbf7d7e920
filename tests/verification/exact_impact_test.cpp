// SPDX-License-Identifier: BSD-3-Clause
// Planar impacts with release with the default scheme: heat at the contact, in the plateau and at the free
// surfaces, against Hugoniot and isentrope of the same equation of state. Bounds say how good the scheme is
// today, not how good it should be; docs/exact_suite.md has all figures.
#include <cctype>

#include "tests/verification/exact/expect.hpp"
#include "tests/verification/exact/planar_impact.hpp"

namespace whipple::verification::exact {
namespace {

// Cells of 0.4, 0.2 and 0.1 mm; what the figures are: docs/exact_suite.md.
// clang-format off
constexpr Bound impact_bounds[] = {
    {"Al-Al 1 km/s", "flyer: released e", 1, {0.33, 0.29, 0.33}},
    {"Al-Al 1 km/s", "flyer: e, first half cell", 1, {0.2, 0.037, 0.26}},
    {"Al-Al 1 km/s", "flyer: e, plateau", 1, {0.6, 0.34, 0.33}},
    {"Al-Al 1 km/s", "flyer: e, plateau, first release", 1, {0.57, 0.32, 0.32}},
    {"Al-Al 1 km/s", "flyer: T max, K", 362.1, {52, 58, 74}},
    {"Al-Al 1 km/s", "flyer: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s", "flyer: p behind the shock", 1, {unbounded, 0.021, 0.019}},
    {"Al-Al 1 km/s", "flyer: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 1 km/s", "flyer: e behind the shock", 1, {unbounded, 0.022, 0.01}},
    {"Al-Al 1 km/s", "flyer: largest p", 1, {0.23, 0.23, 0.23}},
    {"Al-Al 1 km/s", "target: released e", 1, {0.4, 0.32, 0.35}},
    {"Al-Al 1 km/s", "target: e, first half cell", 1, {0.2, 0.35, 0.54}},
    {"Al-Al 1 km/s", "target: e, plateau", 1, {0.63, 0.34, 0.34}},
    {"Al-Al 1 km/s", "target: e, plateau, first release", 1, {0.59, 0.33, 0.32}},
    {"Al-Al 1 km/s", "target: T max, K", 362.1, {57, 64, 77}},
    {"Al-Al 1 km/s", "target: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s", "target: p behind the shock", 1, {unbounded, 0.025, 0.021}},
    {"Al-Al 1 km/s", "target: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 1 km/s", "target: e behind the shock", 1, {unbounded, 0.017, 0.01}},
    {"Al-Al 1 km/s", "target: largest p", 1, {0.27, 0.27, 0.27}},
    {"Al-Al 1 km/s", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 3 km/s", "flyer: released e", 1, {0.047, 0.035, 0.019}},
    {"Al-Al 3 km/s", "flyer: e, first half cell", 1, {0.039, 0.031, 0.045}},
    {"Al-Al 3 km/s", "flyer: e, plateau", 1, {0.033, 0.031, 0.014}},
    {"Al-Al 3 km/s", "flyer: e, plateau, first release", 1, {0.033, 0.032, 0.017}},
    {"Al-Al 3 km/s", "flyer: T max, K", 1171, {72, 76, 81}},
    {"Al-Al 3 km/s", "flyer: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 3 km/s", "flyer: p behind the shock", 1, {unbounded, 0.014, 0.01}},
    {"Al-Al 3 km/s", "flyer: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s", "flyer: e behind the shock", 1, {unbounded, 0.024, 0.012}},
    {"Al-Al 3 km/s", "flyer: largest p", 1, {0.28, 0.28, 0.28}},
    {"Al-Al 3 km/s", "target: released e", 1, {0.01, 0.015, 0.014}},
    {"Al-Al 3 km/s", "target: e, first half cell", 1, {0.15, 0.18, 0.19}},
    {"Al-Al 3 km/s", "target: e, plateau", 1, {0.022, 0.036, 0.022}},
    {"Al-Al 3 km/s", "target: e, plateau, first release", 1, {0.021, 0.038, 0.024}},
    {"Al-Al 3 km/s", "target: T max, K", 1171, {150, 150, 160}},
    {"Al-Al 3 km/s", "target: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 3 km/s", "target: p behind the shock", 1, {unbounded, 0.012, 0.01}},
    {"Al-Al 3 km/s", "target: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s", "target: e behind the shock", 1, {unbounded, 0.021, 0.012}},
    {"Al-Al 3 km/s", "target: largest p", 1, {0.42, 0.42, 0.42}},
    {"Al-Al 3 km/s", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s, contact at rest", "flyer: released e", 1, {0.35, 0.24, 0.15}},
    {"Al-Al 1 km/s, contact at rest", "flyer: e, first half cell", 1, {0.18, 0.11, 0.12}},
    {"Al-Al 1 km/s, contact at rest", "flyer: e, plateau", 1, {0.59, 0.28, 0.15}},
    {"Al-Al 1 km/s, contact at rest", "flyer: e, plateau, first release", 1, {0.57, 0.27, 0.14}},
    {"Al-Al 1 km/s, contact at rest", "flyer: T max, K", 362.1, {50, 48, 50}},
    {"Al-Al 1 km/s, contact at rest", "flyer: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s, contact at rest", "flyer: p behind the shock", 1, {unbounded, 0.016, 0.01}},
    {"Al-Al 1 km/s, contact at rest", "flyer: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 1 km/s, contact at rest", "flyer: e behind the shock", 1, {unbounded, 0.026, 0.013}},
    {"Al-Al 1 km/s, contact at rest", "flyer: largest p", 1, {0.25, 0.25, 0.25}},
    {"Al-Al 1 km/s, contact at rest", "target: released e", 1, {0.35, 0.24, 0.15}},
    {"Al-Al 1 km/s, contact at rest", "target: e, first half cell", 1, {0.18, 0.11, 0.12}},
    {"Al-Al 1 km/s, contact at rest", "target: e, plateau", 1, {0.59, 0.28, 0.15}},
    {"Al-Al 1 km/s, contact at rest", "target: e, plateau, first release", 1, {0.57, 0.27, 0.14}},
    {"Al-Al 1 km/s, contact at rest", "target: T max, K", 362.1, {50, 48, 50}},
    {"Al-Al 1 km/s, contact at rest", "target: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s, contact at rest", "target: p behind the shock", 1, {unbounded, 0.016, 0.01}},
    {"Al-Al 1 km/s, contact at rest", "target: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 1 km/s, contact at rest", "target: e behind the shock", 1, {unbounded, 0.026, 0.013}},
    {"Al-Al 1 km/s, contact at rest", "target: largest p", 1, {0.25, 0.25, 0.25}},
    {"Al-Al 1 km/s, contact at rest", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s, GRAY", "flyer: released e", 1, {0.34, 0.3, 0.34}},
    {"Al-Al 1 km/s, GRAY", "flyer: e, first half cell", 1, {0.23, 0.055, 0.26}},
    {"Al-Al 1 km/s, GRAY", "flyer: e, plateau", 1, {0.61, 0.35, 0.34}},
    {"Al-Al 1 km/s, GRAY", "flyer: e, plateau, first release", 1, {0.59, 0.33, 0.33}},
    {"Al-Al 1 km/s, GRAY", "flyer: T max, K", 356.6, {46, 56, 69}},
    {"Al-Al 1 km/s, GRAY", "flyer: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s, GRAY", "flyer: p behind the shock", 1, {unbounded, 0.02, 0.019}},
    {"Al-Al 1 km/s, GRAY", "flyer: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 1 km/s, GRAY", "flyer: e behind the shock", 1, {unbounded, 0.025, 0.01}},
    {"Al-Al 1 km/s, GRAY", "flyer: largest p", 1, {0.23, 0.23, 0.23}},
    {"Al-Al 1 km/s, GRAY", "target: released e", 1, {0.42, 0.33, 0.35}},
    {"Al-Al 1 km/s, GRAY", "target: e, first half cell", 1, {0.17, 0.27, 0.51}},
    {"Al-Al 1 km/s, GRAY", "target: e, plateau", 1, {0.64, 0.35, 0.34}},
    {"Al-Al 1 km/s, GRAY", "target: e, plateau, first release", 1, {0.61, 0.34, 0.33}},
    {"Al-Al 1 km/s, GRAY", "target: T max, K", 356.6, {55, 62, 72}},
    {"Al-Al 1 km/s, GRAY", "target: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s, GRAY", "target: p behind the shock", 1, {unbounded, 0.026, 0.021}},
    {"Al-Al 1 km/s, GRAY", "target: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 1 km/s, GRAY", "target: e behind the shock", 1, {unbounded, 0.018, 0.01}},
    {"Al-Al 1 km/s, GRAY", "target: largest p", 1, {0.27, 0.27, 0.27}},
    {"Al-Al 1 km/s, GRAY", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 3 km/s, GRAY", "flyer: released e", 1, {0.042, 0.033, 0.018}},
    {"Al-Al 3 km/s, GRAY", "flyer: e, first half cell", 1, {0.026, 0.022, 0.032}},
    {"Al-Al 3 km/s, GRAY", "flyer: e, plateau", 1, {0.026, 0.029, 0.014}},
    {"Al-Al 3 km/s, GRAY", "flyer: e, plateau, first release", 1, {0.025, 0.03, 0.015}},
    {"Al-Al 3 km/s, GRAY", "flyer: T max, K", 959.8, {9.6, 9.6, 9.6}},
    {"Al-Al 3 km/s, GRAY", "flyer: share not solid", 1, {0.12, 0.058, 0.029}},
    {"Al-Al 3 km/s, GRAY", "flyer: p behind the shock", 1, {unbounded, 0.015, 0.01}},
    {"Al-Al 3 km/s, GRAY", "flyer: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s, GRAY", "flyer: e behind the shock", 1, {unbounded, 0.024, 0.012}},
    {"Al-Al 3 km/s, GRAY", "flyer: largest p", 1, {0.27, 0.27, 0.27}},
    {"Al-Al 3 km/s, GRAY", "target: released e", 1, {0.01, 0.016, 0.014}},
    {"Al-Al 3 km/s, GRAY", "target: e, first half cell", 1, {0.15, 0.17, 0.18}},
    {"Al-Al 3 km/s, GRAY", "target: e, plateau", 1, {0.019, 0.035, 0.021}},
    {"Al-Al 3 km/s, GRAY", "target: e, plateau, first release", 1, {0.015, 0.037, 0.022}},
    {"Al-Al 3 km/s, GRAY", "target: T max, K", 959.8, {9.6, 9.6, 9.7}},
    {"Al-Al 3 km/s, GRAY", "target: share not solid", 1, {0.12, 0.058, 0.029}},
    {"Al-Al 3 km/s, GRAY", "target: p behind the shock", 1, {unbounded, 0.013, 0.01}},
    {"Al-Al 3 km/s, GRAY", "target: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s, GRAY", "target: e behind the shock", 1, {unbounded, 0.022, 0.012}},
    {"Al-Al 3 km/s, GRAY", "target: largest p", 1, {0.41, 0.41, 0.41}},
    {"Al-Al 3 km/s, GRAY", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Cu-Al 5.55 km/s", "flyer: released e", 1, {0.045, 0.03, 0.01}},
    {"Cu-Al 5.55 km/s", "flyer: e, first half cell", 1, {0.081, 0.076, 0.54}},
    {"Cu-Al 5.55 km/s", "flyer: e, plateau", 1, {0.031, 0.028, 0.01}},
    {"Cu-Al 5.55 km/s", "flyer: e, plateau, first release", 1, {0.029, 0.028, 0.01}},
    {"Cu-Al 5.55 km/s", "flyer: T max, K", 1004, {92, 120, 350}},
    {"Cu-Al 5.55 km/s", "flyer: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Cu-Al 5.55 km/s", "flyer: p behind the shock", 1, {unbounded, 0.019, 0.011}},
    {"Cu-Al 5.55 km/s", "flyer: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Cu-Al 5.55 km/s", "flyer: e behind the shock", 1, {unbounded, 0.023, 0.011}},
    {"Cu-Al 5.55 km/s", "flyer: largest p", 1, {0.36, 0.36, 0.36}},
    {"Cu-Al 5.55 km/s", "target: released e", 1, {0.053, 0.043, 0.03}},
    {"Cu-Al 5.55 km/s", "target: e, first half cell", 1, {0.036, 0.025, 0.036}},
    {"Cu-Al 5.55 km/s", "target: e, plateau", 1, {unbounded, 0.047, 0.029}},
    {"Cu-Al 5.55 km/s", "target: e, plateau, first release", 1, {unbounded, 0.047, 0.029}},
    {"Cu-Al 5.55 km/s", "target: T max, K", 1095, {41, 28, 41}},
    {"Cu-Al 5.55 km/s", "target: share not solid", 1, {0.01, 0.01, 0.01}},
    {"Cu-Al 5.55 km/s", "target: p behind the shock", 1, {unbounded, 0.022, 0.01}},
    {"Cu-Al 5.55 km/s", "target: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Cu-Al 5.55 km/s", "target: e behind the shock", 1, {unbounded, 0.041, 0.02}},
    {"Cu-Al 5.55 km/s", "target: largest p", 1, {0.25, 0.26, 0.26}},
    {"Cu-Al 5.55 km/s", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Pb-Pb 6.58 km/s", "flyer: released e", 1, {0.08, 0.054, 0.046}},
    {"Pb-Pb 6.58 km/s", "flyer: e, first half cell", 1, {0.01, 0.06, 0.1}},
    {"Pb-Pb 6.58 km/s", "flyer: e, plateau", 1, {0.076, 0.044, 0.039}},
    {"Pb-Pb 6.58 km/s", "flyer: e, plateau, first release", 1, {0.09, 0.053, 0.052}},
    {"Pb-Pb 6.58 km/s", "flyer: T max, K", 5388, {130, 130, 260}},
    {"Pb-Pb 6.58 km/s", "flyer: share not solid", 1, {0.01, 0.01, 0.01}},
    {"Pb-Pb 6.58 km/s", "flyer: p behind the shock", 1, {0.026, 0.02, 0.012}},
    {"Pb-Pb 6.58 km/s", "flyer: rho behind the shock", 1, {0.01, 0.01, 0.01}},
    {"Pb-Pb 6.58 km/s", "flyer: e behind the shock", 1, {0.059, 0.034, 0.027}},
    {"Pb-Pb 6.58 km/s", "flyer: largest p", 1, {0.3, 0.3, 0.3}},
    {"Pb-Pb 6.58 km/s", "target: released e", 1, {0.091, 0.06, 0.053}},
    {"Pb-Pb 6.58 km/s", "target: e, first half cell", 1, {0.014, 0.077, 0.11}},
    {"Pb-Pb 6.58 km/s", "target: e, plateau", 1, {0.089, 0.048, 0.046}},
    {"Pb-Pb 6.58 km/s", "target: e, plateau, first release", 1, {0.11, 0.06, 0.058}},
    {"Pb-Pb 6.58 km/s", "target: T max, K", 5388, {130, 130, 130}},
    {"Pb-Pb 6.58 km/s", "target: share not solid", 1, {0.01, 0.01, 0.01}},
    {"Pb-Pb 6.58 km/s", "target: p behind the shock", 1, {0.031, 0.018, 0.01}},
    {"Pb-Pb 6.58 km/s", "target: rho behind the shock", 1, {0.01, 0.01, 0.01}},
    {"Pb-Pb 6.58 km/s", "target: e behind the shock", 1, {0.059, 0.035, 0.026}},
    {"Pb-Pb 6.58 km/s", "target: largest p", 1, {0.43, 0.44, 0.44}},
    {"Pb-Pb 6.58 km/s", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Ta-Ta 4 km/s", "flyer: released e", 1, {0.01, 0.012, 0.01}},
    {"Ta-Ta 4 km/s", "flyer: e, first half cell", 1, {0.074, 0.081, 0.065}},
    {"Ta-Ta 4 km/s", "flyer: e, plateau", 1, {0.01, 0.017, 0.01}},
    {"Ta-Ta 4 km/s", "flyer: e, plateau, first release", 1, {0.01, 0.028, 0.015}},
    {"Ta-Ta 4 km/s", "flyer: T max, K", 2812, {430, 400, 440}},
    {"Ta-Ta 4 km/s", "flyer: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Ta-Ta 4 km/s", "flyer: p behind the shock", 1, {unbounded, 0.019, 0.01}},
    {"Ta-Ta 4 km/s", "flyer: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Ta-Ta 4 km/s", "flyer: e behind the shock", 1, {unbounded, 0.024, 0.012}},
    {"Ta-Ta 4 km/s", "flyer: largest p", 1, {0.25, 0.25, 0.25}},
    {"Ta-Ta 4 km/s", "target: released e", 1, {0.043, 0.01, 0.01}},
    {"Ta-Ta 4 km/s", "target: e, first half cell", 1, {0.29, 0.3, 0.32}},
    {"Ta-Ta 4 km/s", "target: e, plateau", 1, {0.013, 0.023, 0.015}},
    {"Ta-Ta 4 km/s", "target: e, plateau, first release", 1, {0.01, 0.034, 0.023}},
    {"Ta-Ta 4 km/s", "target: T max, K", 2812, {610, 610, 610}},
    {"Ta-Ta 4 km/s", "target: share not solid", 0, {0.12, 0.087, 0.044}},
    {"Ta-Ta 4 km/s", "target: p behind the shock", 1, {unbounded, 0.015, 0.01}},
    {"Ta-Ta 4 km/s", "target: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Ta-Ta 4 km/s", "target: e behind the shock", 1, {unbounded, 0.02, 0.012}},
    {"Ta-Ta 4 km/s", "target: largest p", 1, {0.39, 0.39, 0.39}},
    {"Ta-Ta 4 km/s", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
};
// clang-format on

constexpr std::array<double, 3> cell_sizes{0.4e-3, 0.2e-3, 0.1e-3};

class ExactImpact : public testing::TestWithParam<PlanarImpact> {};
class ExactImpactFine : public ExactImpact {};

void expect_impact(const PlanarImpact& impact, bool fine) {
  expect_convergence(impact.name, [&](double cell) { return run(impact, cell); }, cell_sizes, fine,
                     impact_bounds, {});
}

TEST_P(ExactImpact, HeatsAndReleases) { expect_impact(GetParam(), false); }
TEST_P(ExactImpactFine, HeatsAndReleases) { expect_impact(GetParam(), true); }

/// Letters and digits of the name.
std::string test_name(const testing::TestParamInfo<PlanarImpact>& info) {
  std::string name;
  for (const char c : info.param.name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Of, ExactImpact, testing::ValuesIn(planar_impacts()), test_name);
INSTANTIATE_TEST_SUITE_P(Of, ExactImpactFine, testing::ValuesIn(planar_impacts()), test_name);

}  // namespace
}  // namespace whipple::verification::exact
