// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace whipple::decks::dyna {

/// Lists keywords without influence on the physics of the case.
inline constexpr std::array harmless = {"KEYWORD",
                                        "KEYWORD_ID",
                                        "KEYWORD_JOBID",
                                        "END",
                                        "COMMENT",
                                        "CONTROL_ENERGY",
                                        "CONTROL_OUTPUT",
                                        "CONTROL_CPU",
                                        "CONTROL_HOURGLASS",
                                        "HOURGLASS",
                                        "CONTROL_BULK_VISCOSITY",
                                        "CONTROL_SOLUTION",
                                        "CONTROL_TIMESTEP",
                                        "CONTROL_CONTACT",
                                        "CONTROL_SPH",
                                        "CONTROL_ALE",
                                        "CONTROL_ACCURACY",
                                        "CONTROL_SHELL",
                                        "CONTROL_SOLID",
                                        "CONTROL_PARALLEL",
                                        "CONTROL_UNITS"};
/// Lists keywords that define items used by others: if such an item is not read, it is reported.
inline constexpr std::array used_by_others = {"DEFINE_CURVE",
                                              "DEFINE_TABLE",
                                              "DEFINE_VECTOR",
                                              "DEFINE_COORDINATE_SYSTEM",
                                              "DEFINE_COORDINATE_VECTOR",
                                              "SET_SEGMENT",
                                              "SET_SOLID",
                                              "SET_SOLID_GENERATE",
                                              "SET_SHELL",
                                              "SET_SHELL_LIST"};

}  // namespace whipple::decks::dyna
