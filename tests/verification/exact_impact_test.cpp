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
    {"Al-Al 1 km/s", "flyer: released e", 1, {1.3, 0.79, 0.65}},
    {"Al-Al 1 km/s", "flyer: e, first half cell", 1, {11, 11, 11}},
    {"Al-Al 1 km/s", "flyer: e, plateau", 1, {0.68, 0.42, 0.44}},
    {"Al-Al 1 km/s", "flyer: e, plateau, first release", 1, {0.63, 0.4, 0.43}},
    {"Al-Al 1 km/s", "flyer: T max, K", 362.1, {620, 620, 630}},
    {"Al-Al 1 km/s", "flyer: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s", "flyer: p behind the shock", 1, {unbounded, 0.02, 0.018}},
    {"Al-Al 1 km/s", "flyer: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 1 km/s", "flyer: e behind the shock", 1, {unbounded, 0.029, 0.015}},
    {"Al-Al 1 km/s", "flyer: largest p", 1, {0.27, 0.27, 0.27}},
    {"Al-Al 1 km/s", "target: released e", 1, {1.5, 0.89, 0.69}},
    {"Al-Al 1 km/s", "target: e, first half cell", 1, {14, 14, 14}},
    {"Al-Al 1 km/s", "target: e, plateau", 1, {0.71, 0.42, 0.44}},
    {"Al-Al 1 km/s", "target: e, plateau, first release", 1, {0.67, 0.4, 0.43}},
    {"Al-Al 1 km/s", "target: T max, K", 362.1, {800, 800, 810}},
    {"Al-Al 1 km/s", "target: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s", "target: p behind the shock", 1, {unbounded, 0.024, 0.02}},
    {"Al-Al 1 km/s", "target: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 1 km/s", "target: e behind the shock", 1, {unbounded, 0.02, 0.012}},
    {"Al-Al 1 km/s", "target: largest p", 1, {0.36, 0.36, 0.36}},
    {"Al-Al 1 km/s", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 3 km/s", "flyer: released e", 1, {0.36, 0.21, 0.13}},
    {"Al-Al 3 km/s", "flyer: e, first half cell", 1, {4.5, 4.4, 4.4}},
    {"Al-Al 3 km/s", "flyer: e, plateau", 1, {0.063, 0.061, 0.055}},
    {"Al-Al 3 km/s", "flyer: e, plateau, first release", 1, {0.057, 0.056, 0.052}},
    {"Al-Al 3 km/s", "flyer: T max, K", 1171, {3.2e+03, 3.1e+03, 3.1e+03}},
    {"Al-Al 3 km/s", "flyer: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 3 km/s", "flyer: p behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s", "flyer: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s", "flyer: e behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s", "flyer: largest p", 1, {0.43, 0.43, 0.43}},
    {"Al-Al 3 km/s", "target: released e", 1, {0.44, 0.23, 0.13}},
    {"Al-Al 3 km/s", "target: e, first half cell", 1, {5.7, 5.5, 5.5}},
    {"Al-Al 3 km/s", "target: e, plateau", 1, {0.072, 0.056, 0.044}},
    {"Al-Al 3 km/s", "target: e, plateau, first release", 1, {0.051, 0.05, 0.042}},
    {"Al-Al 3 km/s", "target: T max, K", 1171, {3.8e+03, 3.8e+03, 3.8e+03}},
    {"Al-Al 3 km/s", "target: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 3 km/s", "target: p behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s", "target: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s", "target: e behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s", "target: largest p", 1, {0.69, 0.69, 0.69}},
    {"Al-Al 3 km/s", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s, contact at rest", "flyer: released e", 1, {1.4, 0.73, 0.41}},
    {"Al-Al 1 km/s, contact at rest", "flyer: e, first half cell", 1, {11, 11, 11}},
    {"Al-Al 1 km/s, contact at rest", "flyer: e, plateau", 1, {0.66, 0.32, 0.19}},
    {"Al-Al 1 km/s, contact at rest", "flyer: e, plateau, first release", 1, {0.62, 0.31, 0.18}},
    {"Al-Al 1 km/s, contact at rest", "flyer: T max, K", 362.1, {660, 650, 650}},
    {"Al-Al 1 km/s, contact at rest", "flyer: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s, contact at rest", "flyer: p behind the shock", 1, {unbounded, 0.015, 0.01}},
    {"Al-Al 1 km/s, contact at rest", "flyer: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 1 km/s, contact at rest", "flyer: e behind the shock", 1, {unbounded, 0.028, 0.017}},
    {"Al-Al 1 km/s, contact at rest", "flyer: largest p", 1, {0.34, 0.34, 0.34}},
    {"Al-Al 1 km/s, contact at rest", "target: released e", 1, {1.4, 0.73, 0.41}},
    {"Al-Al 1 km/s, contact at rest", "target: e, first half cell", 1, {11, 11, 11}},
    {"Al-Al 1 km/s, contact at rest", "target: e, plateau", 1, {0.66, 0.32, 0.19}},
    {"Al-Al 1 km/s, contact at rest", "target: e, plateau, first release", 1, {0.62, 0.31, 0.18}},
    {"Al-Al 1 km/s, contact at rest", "target: T max, K", 362.1, {660, 650, 650}},
    {"Al-Al 1 km/s, contact at rest", "target: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s, contact at rest", "target: p behind the shock", 1, {unbounded, 0.015, 0.01}},
    {"Al-Al 1 km/s, contact at rest", "target: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 1 km/s, contact at rest", "target: e behind the shock", 1, {unbounded, 0.028, 0.017}},
    {"Al-Al 1 km/s, contact at rest", "target: largest p", 1, {0.34, 0.34, 0.34}},
    {"Al-Al 1 km/s, contact at rest", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s, GRAY", "flyer: released e", 1, {1.3, 0.81, 0.66}},
    {"Al-Al 1 km/s, GRAY", "flyer: e, first half cell", 1, {11, 11, 11}},
    {"Al-Al 1 km/s, GRAY", "flyer: e, plateau", 1, {0.68, 0.43, 0.45}},
    {"Al-Al 1 km/s, GRAY", "flyer: e, plateau, first release", 1, {0.64, 0.41, 0.44}},
    {"Al-Al 1 km/s, GRAY", "flyer: T max, K", 356.6, {560, 560, 570}},
    {"Al-Al 1 km/s, GRAY", "flyer: share not solid", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 1 km/s, GRAY", "flyer: p behind the shock", 1, {unbounded, 0.019, 0.018}},
    {"Al-Al 1 km/s, GRAY", "flyer: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 1 km/s, GRAY", "flyer: e behind the shock", 1, {unbounded, 0.03, 0.015}},
    {"Al-Al 1 km/s, GRAY", "flyer: largest p", 1, {0.27, 0.27, 0.27}},
    {"Al-Al 1 km/s, GRAY", "target: released e", 1, {1.5, 0.9, 0.7}},
    {"Al-Al 1 km/s, GRAY", "target: e, first half cell", 1, {14, 14, 14}},
    {"Al-Al 1 km/s, GRAY", "target: e, plateau", 1, {0.72, 0.43, 0.44}},
    {"Al-Al 1 km/s, GRAY", "target: e, plateau, first release", 1, {0.68, 0.41, 0.43}},
    {"Al-Al 1 km/s, GRAY", "target: T max, K", 356.6, {700, 700, 700}},
    {"Al-Al 1 km/s, GRAY", "target: share not solid", 0, {0.058, 0.029, 0.015}},
    {"Al-Al 1 km/s, GRAY", "target: p behind the shock", 1, {unbounded, 0.024, 0.02}},
    {"Al-Al 1 km/s, GRAY", "target: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 1 km/s, GRAY", "target: e behind the shock", 1, {unbounded, 0.021, 0.012}},
    {"Al-Al 1 km/s, GRAY", "target: largest p", 1, {0.36, 0.36, 0.36}},
    {"Al-Al 1 km/s, GRAY", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Al-Al 3 km/s, GRAY", "flyer: released e", 1, {0.36, 0.2, 0.12}},
    {"Al-Al 3 km/s, GRAY", "flyer: e, first half cell", 1, {4.9, 4.8, 4.7}},
    {"Al-Al 3 km/s, GRAY", "flyer: e, plateau", 1, {0.063, 0.048, 0.044}},
    {"Al-Al 3 km/s, GRAY", "flyer: e, plateau, first release", 1, {0.057, 0.044, 0.044}},
    {"Al-Al 3 km/s, GRAY", "flyer: T max, K", 959.8, {3.4e+03, 3.4e+03, 3.3e+03}},
    {"Al-Al 3 km/s, GRAY", "flyer: share not solid", 1, {0.12, 0.087, 0.029}},
    {"Al-Al 3 km/s, GRAY", "flyer: p behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s, GRAY", "flyer: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s, GRAY", "flyer: e behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s, GRAY", "flyer: largest p", 1, {0.41, 0.41, 0.41}},
    {"Al-Al 3 km/s, GRAY", "target: released e", 1, {0.46, 0.24, 0.13}},
    {"Al-Al 3 km/s, GRAY", "target: e, first half cell", 1, {6.5, 6.4, 6.4}},
    {"Al-Al 3 km/s, GRAY", "target: e, plateau", 1, {0.067, 0.044, 0.035}},
    {"Al-Al 3 km/s, GRAY", "target: e, plateau, first release", 1, {0.049, 0.04, 0.034}},
    {"Al-Al 3 km/s, GRAY", "target: T max, K", 959.8, {4.7e+03, 4.6e+03, 4.6e+03}},
    {"Al-Al 3 km/s, GRAY", "target: share not solid", 1, {0.18, 0.087, 0.044}},
    {"Al-Al 3 km/s, GRAY", "target: p behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s, GRAY", "target: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s, GRAY", "target: e behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Al-Al 3 km/s, GRAY", "target: largest p", 1, {0.68, 0.68, 0.68}},
    {"Al-Al 3 km/s, GRAY", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Cu-Al 5.55 km/s", "flyer: released e", 1, {0.52, 0.26, 0.16}},
    {"Cu-Al 5.55 km/s", "flyer: e, first half cell", 1, {6, 5.9, 5.8}},
    {"Cu-Al 5.55 km/s", "flyer: e, plateau", 1, {0.14, 0.11, 0.083}},
    {"Cu-Al 5.55 km/s", "flyer: e, plateau, first release", 1, {0.041, 0.063, 0.073}},
    {"Cu-Al 5.55 km/s", "flyer: T max, K", 1004, {3.3e+03, 3.2e+03, 3.2e+03}},
    {"Cu-Al 5.55 km/s", "flyer: share not solid", 0, {0.21, 0.099, 0.034}},
    {"Cu-Al 5.55 km/s", "flyer: p behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Cu-Al 5.55 km/s", "flyer: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Cu-Al 5.55 km/s", "flyer: e behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Cu-Al 5.55 km/s", "flyer: largest p", 1, {0.58, 0.59, 0.59}},
    {"Cu-Al 5.55 km/s", "target: released e", 1, {0.56, 0.29, 0.16}},
    {"Cu-Al 5.55 km/s", "target: e, first half cell", 1, {5.6, 5.3, 5.3}},
    {"Cu-Al 5.55 km/s", "target: e, plateau", 1, {unbounded, 0.034, 0.036}},
    {"Cu-Al 5.55 km/s", "target: e, plateau, first release", 1, {unbounded, 0.033, 0.037}},
    {"Cu-Al 5.55 km/s", "target: T max, K", 1095, {5.3e+03, 5.3e+03, 5.3e+03}},
    {"Cu-Al 5.55 km/s", "target: share not solid", 1, {0.17, 0.08, 0.041}},
    {"Cu-Al 5.55 km/s", "target: p behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Cu-Al 5.55 km/s", "target: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Cu-Al 5.55 km/s", "target: e behind the shock", 1, {unbounded, 0.018, 0.01}},
    {"Cu-Al 5.55 km/s", "target: largest p", 1, {0.51, 0.49, 0.5}},
    {"Cu-Al 5.55 km/s", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Pb-Pb 6.58 km/s", "flyer: released e", 1, {0.13, 0.059, 0.029}},
    {"Pb-Pb 6.58 km/s", "flyer: e, first half cell", 1, {4, 3.5, 3.1}},
    {"Pb-Pb 6.58 km/s", "flyer: e, plateau", 1, {0.021, 0.019, 0.014}},
    {"Pb-Pb 6.58 km/s", "flyer: e, plateau, first release", 1, {0.038, 0.042, 0.027}},
    {"Pb-Pb 6.58 km/s", "flyer: T max, K", 5388, {1.4e+04, 2e+04, 1.7e+04}},
    {"Pb-Pb 6.58 km/s", "flyer: share not solid", 1, {0.01, 0.01, 0.01}},
    {"Pb-Pb 6.58 km/s", "flyer: p behind the shock", 1, {0.021, 0.018, 0.01}},
    {"Pb-Pb 6.58 km/s", "flyer: rho behind the shock", 1, {0.01, 0.01, 0.01}},
    {"Pb-Pb 6.58 km/s", "flyer: e behind the shock", 1, {0.042, 0.01, 0.01}},
    {"Pb-Pb 6.58 km/s", "flyer: largest p", 1, {0.65, 0.65, 0.65}},
    {"Pb-Pb 6.58 km/s", "target: released e", 1, {0.16, 0.082, 0.027}},
    {"Pb-Pb 6.58 km/s", "target: e, first half cell", 1, {5.1, 4.5, 3.9}},
    {"Pb-Pb 6.58 km/s", "target: e, plateau", 1, {0.01, 0.015, 0.01}},
    {"Pb-Pb 6.58 km/s", "target: e, plateau, first release", 1, {0.011, 0.035, 0.017}},
    {"Pb-Pb 6.58 km/s", "target: T max, K", 5388, {1.6e+04, 2.2e+04, 1.9e+04}},
    {"Pb-Pb 6.58 km/s", "target: share not solid", 1, {0.01, 0.01, 0.01}},
    {"Pb-Pb 6.58 km/s", "target: p behind the shock", 1, {0.026, 0.016, 0.01}},
    {"Pb-Pb 6.58 km/s", "target: rho behind the shock", 1, {0.01, 0.01, 0.01}},
    {"Pb-Pb 6.58 km/s", "target: e behind the shock", 1, {0.051, 0.01, 0.01}},
    {"Pb-Pb 6.58 km/s", "target: largest p", 1, {0.84, 0.86, 0.85}},
    {"Pb-Pb 6.58 km/s", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Ta-Ta 4 km/s", "flyer: released e", 1, {0.41, 0.23, 0.14}},
    {"Ta-Ta 4 km/s", "flyer: e, first half cell", 1, {4.8, 4.7, 4.6}},
    {"Ta-Ta 4 km/s", "flyer: e, plateau", 1, {0.099, 0.069, 0.059}},
    {"Ta-Ta 4 km/s", "flyer: e, plateau, first release", 1, {0.082, 0.058, 0.052}},
    {"Ta-Ta 4 km/s", "flyer: T max, K", 2812, {1.1e+04, 9.9e+03, 9.8e+03}},
    {"Ta-Ta 4 km/s", "flyer: share not solid", 0, {0.41, 0.21, 0.072}},
    {"Ta-Ta 4 km/s", "flyer: p behind the shock", 1, {unbounded, 0.016, 0.01}},
    {"Ta-Ta 4 km/s", "flyer: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Ta-Ta 4 km/s", "flyer: e behind the shock", 1, {unbounded, 0.011, 0.01}},
    {"Ta-Ta 4 km/s", "flyer: largest p", 1, {0.44, 0.44, 0.44}},
    {"Ta-Ta 4 km/s", "target: released e", 1, {0.48, 0.26, 0.15}},
    {"Ta-Ta 4 km/s", "target: e, first half cell", 1, {6.1, 6, 6}},
    {"Ta-Ta 4 km/s", "target: e, plateau", 1, {0.098, 0.064, 0.049}},
    {"Ta-Ta 4 km/s", "target: e, plateau, first release", 1, {0.069, 0.05, 0.041}},
    {"Ta-Ta 4 km/s", "target: T max, K", 2812, {1.4e+04, 1.4e+04, 1.4e+04}},
    {"Ta-Ta 4 km/s", "target: share not solid", 0, {0.29, 0.12, 0.058}},
    {"Ta-Ta 4 km/s", "target: p behind the shock", 1, {unbounded, 0.014, 0.01}},
    {"Ta-Ta 4 km/s", "target: rho behind the shock", 1, {unbounded, 0.01, 0.01}},
    {"Ta-Ta 4 km/s", "target: e behind the shock", 1, {unbounded, 0.011, 0.01}},
    {"Ta-Ta 4 km/s", "target: largest p", 1, {0.64, 0.64, 0.64}},
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
