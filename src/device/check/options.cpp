// SPDX-License-Identifier: BSD-3-Clause
#include "src/device/check/options.hpp"

#include <cmath>
#include <cstdlib>

#include "src/device/check/states.hpp"

namespace whipple::device::check {

const char* const usage =
    "Usage: whipple-device-check FILE... [--device gpu|emulated] [--steps N] [--twice] [--sizes N,N,...]\n"
    "                            [--per-cell N,N,...] [--no-rates] [--json OUT] [--markdown OUT]\n"
    "Steps stored states (whipple bench --states FOLDER) on a device, and compares every component with what "
    "the\n"
    "host's kernels made of them after the first and after the last step.\n"
    "  --device    gpu: the graphics processor (default); emulated: its kernels on the threads of this "
    "machine\n"
    "  --steps     at most so many; with fewer than the file holds only the first is compared\n"
    "  --twice     repeat, and compare bits\n"
    "  --sizes     also time the step of so many particles: the first state repeated along x, a dense block "
    "and\n"
    "              clouds of its first particle\n"
    "  --per-cell  particles per cell of the block and the clouds (default: 8,2,0.5,0.0625)\n"
    "  --no-rates  do not measure the device's bandwidth and arithmetic: rooflines are 0\n"
    "  --json      write the results to a file; --markdown: as tables\n"
    "Bounds, over the largest magnitude of a component: 1e-11 after the first step (plastic strain\n"
    "and deviatoric stress 1e-10), 1e-8 after the last.\n"
    "Exit codes: 0 all within them, 1 one is not, "
    "2 wrong options or files, 3 no device, or it failed.\n";

namespace {

double number_of(const std::string& option, const std::string& text) {
  char* end = nullptr;
  const double x = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(x) || !(x > 0.0))
    throw WrongInput(option + " " + text + ": expected positive numbers, for example 1e5,1e6");
  return x;
}

std::vector<double> numbers_of(const std::string& option, const std::string& text) {
  std::vector<double> numbers;
  std::size_t begin = 0;
  while (true) {
    const std::size_t comma = text.find(',', begin);
    numbers.push_back(number_of(option, text.substr(begin, comma - begin)));
    if (comma == std::string::npos) return numbers;
    begin = comma + 1;
  }
}

/// Number of a size_t that memory may hold.
std::size_t count_of(const std::string& option, double number) {
  if (number > 4e9 || number != std::floor(number))
    throw WrongInput(option + ": expected whole numbers below 4e9");
  return static_cast<std::size_t>(number);
}

On device_of(const std::string& word) {
  if (word == "gpu") return On::gpu;
  if (word == "emulated") return On::emulated;
  throw WrongInput("--device " + word + ": expected gpu or emulated");
}

}  // namespace

Options read_options(int argc, char** argv) {
  Options options;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    const auto value = [&] {
      if (i + 1 == arguments.size()) throw WrongInput(argument + ": expected a value");
      return arguments[++i];
    };
    if (argument.empty() || argument[0] != '-') {
      options.files.push_back(argument);
    } else if (argument == "--device") {
      options.device = device_of(value());
    } else if (argument == "--json") {
      options.json = value();
    } else if (argument == "--markdown") {
      options.markdown = value();
    } else if (argument == "--steps") {
      options.steps = count_of(argument, number_of(argument, value()));
    } else if (argument == "--sizes") {
      for (const double size : numbers_of(argument, value()))
        options.sizes.push_back(count_of(argument, size));
    } else if (argument == "--per-cell") {
      options.per_cell = numbers_of(argument, value());
    } else if (argument == "--twice") {
      options.twice = true;
    } else if (argument == "--no-rates") {
      options.rates = false;
    } else if (argument == "--help" || argument == "-h") {
      options.help = true;
    } else {
      throw WrongInput(argument + ": no such option\n" + usage);
    }
  }
  if (options.files.empty() && !options.help)
    throw WrongInput(std::string("expected stored states\n") + usage);
  return options;
}

}  // namespace whipple::device::check
