// SPDX-License-Identifier: BSD-3-Clause
#include "eos/root.hpp"

#include <fmt/core.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

#include "src/core/base/error.hpp"

namespace whipple::eos {

double find_root(const std::function<double(double)>& function, double from, double to, const char* what,
                 int digits) {
  if (from > to) std::swap(from, to);
  const double at_from = function(from), at_to = function(to);
  if (at_from == 0) return from;
  if (at_to == 0) return to;
  if (std::isnan(at_from) || std::isnan(at_to) || std::signbit(at_from) == std::signbit(at_to)) {
    throw StateError(fmt::format("no {} between {:.8g} and {:.8g}: the residual is {:.3g} and {:.3g} there",
                                 what, from, to, at_from, at_to));
  }
  std::uintmax_t evaluations = 200;
  const auto [lower, upper] = boost::math::tools::toms748_solve(
      function, from, to, at_from, at_to, boost::math::tools::eps_tolerance<double>(digits), evaluations);
  return 0.5 * (lower + upper);
}

}  // namespace whipple::eos
