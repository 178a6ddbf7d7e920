// SPDX-License-Identifier: BSD-3-Clause
#include "tests/verification/exact/result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "src/core/base/error.hpp"

namespace whipple::verification::exact {
namespace {

std::string number(double x) {
  if (std::isnan(x)) return "-";
  const double size = std::abs(x);
  if (x == 0 || (size >= 1e-3 && size < 1e5)) return fmt::format("{:.4g}", x);
  return fmt::format("{:.1e}", x);
}

std::string row(const std::vector<double>& values) {
  std::string text;
  for (const double x : values) {
    text += text.empty() ? "" : ", ";
    text += std::isnan(x) ? "-" : fmt::format("{:.3g}", x);
  }
  return text;
}

}  // namespace

double Result::at(std::string_view figure) const {
  const auto found = std::ranges::find(figures, figure, &Figure::name);
  if (found == figures.end()) throw StateError(fmt::format("no figure '{}'", figure));
  return found->value;
}

double order_of(const Result& coarse, const Result& fine, std::string_view figure) {
  const auto exact = std::ranges::find(fine.figures, figure, &Figure::name)->exact;
  return std::log(std::abs(coarse.at(figure) - exact) / std::abs(fine.at(figure) - exact)) /
         std::log(coarse.cell / fine.cell);
}

std::string markdown(std::span<const Result> results) {
  std::string text = "| figure | exact |", rule = "| --- | --- |";
  for (const Result& result : results) {
    text += fmt::format(" {} |", result.resolution);
    rule += " --- |";
  }
  text += " orders |\n" + rule + " --- |\n";
  for (std::size_t f = 0; f < results[0].figures.size(); ++f) {
    const Figure& figure = results[0].figures[f];
    text += fmt::format("| {} | {} |", figure.name, number(figure.exact));
    for (const Result& result : results) text += fmt::format(" {} |", number(result.figures.at(f).value));
    std::string orders;
    for (std::size_t i = 1; figure.name.starts_with("L1") && i < results.size(); ++i) {
      orders +=
          fmt::format("{}{:.2f}", i == 1 ? "" : ", ", order_of(results[i - 1], results[i], figure.name));
    }
    text += fmt::format(" {} |\n", orders);
  }
  if (results[0].profiles.empty()) return text;
  text += "\n| profile | cells | values |\n| --- | --- | --- |\n";
  for (std::size_t p = 0; p < results[0].profiles.size(); ++p) {
    for (const Result& result : results) {
      const Profile& profile = result.profiles.at(p);
      text += fmt::format("| {} | {} | {} |\n", profile.name, result.resolution, row(profile.values));
    }
  }
  return text;
}

void print(const std::string& problem, const Result& result) {
  for (const Figure& f : result.figures) {
    std::printf("%s, %s: %s %s (exact %s)\n", problem.c_str(), result.resolution.c_str(), f.name.c_str(),
                number(f.value).c_str(), number(f.exact).c_str());
  }
  for (const Profile& p : result.profiles) {
    std::printf("%s, %s: %s %s\n", problem.c_str(), result.resolution.c_str(), p.name.c_str(),
                row(p.values).c_str());
  }
}

}  // namespace whipple::verification::exact
