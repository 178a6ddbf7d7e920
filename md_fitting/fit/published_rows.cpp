// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/published_rows.hpp"

#include <array>

namespace whipple::fit {
namespace {

constexpr std::string_view liu2013 = "Liu, Wang & Zhang, Int. J. Mech. Mater. Des. 9 (2013) 127";
constexpr std::string_view steinberg1996 = "Steinberg, UCRL-MA-106439 (1996)";

constexpr std::array rows = {
    PublishedRow{"experiment (Liu et al. 2013)", "Cu", liu2013, 0.1118e-3, 3940.0, 1.489, 1.97, 1.5, 4.9e-4,
                 1790.0},
    PublishedRow{"MD (Liu et al. 2013)", "Cu", liu2013, 0.1119e-3, 3980.0, 1.301, 1.86, 1.7, 8.3e-4, 2006.0},
    PublishedRow{"experiment (Steinberg 1996)", "Al", steinberg1996, 1e-3 / 2.707, 5386.0, 1.339, 1.97, 1.5,
                 1.35e-3, 1220.0},
    // Steinberg's shock curve of lead is a cubic: the straight line is from a different source.
    PublishedRow{
        "experiment (Anderson et al. 1990; Steinberg 1996)", "Pb",
        "lead, C and S: Anderson, Trucano & Mullin, Int. J. Impact Eng. 9 (1990) 89, as typed in the public "
        "input of MPM3D-F90",
        1e-3 / 11.34, 2092.0, 1.45, 2.74, 2.2, 2.98e-3, 760.0},
    PublishedRow{"experiment (Steinberg 1996)", "Ni", steinberg1996, 1e-3 / 8.9, 4650.0, 1.445, 1.93, 1.4,
                 0.0, 2330.0},
    PublishedRow{"experiment (Steinberg 1996)", "Ta", steinberg1996, 1e-3 / 16.69, 3410.0, 1.2, 1.67, 1.3,
                 0.0, 4340.0},
    PublishedRow{"experiment (Steinberg 1996)", "W", steinberg1996, 1e-3 / 19.3, 4030.0, 1.237, 1.67, 1.3,
                 1.3e-3, 4520.0},
};

}  // namespace

std::span<const PublishedRow> published_rows() { return rows; }

}  // namespace whipple::fit
