// SPDX-License-Identifier: BSD-3-Clause
// Time of a million states of a material in C++, which test_speed.py compares with Python: processor time, the least of
// several repetitions, with fresh arrays and with the same ones.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>
#include <vector>

#include "src/material/material_file.hpp"

namespace {

using namespace whipple;

double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Arrays {
  explicit Arrays(std::size_t n) : pressure(n), temperature(n), sound_speed(n), melted(n), vaporised(n) {}
  std::vector<double> pressure, temperature, sound_speed, melted, vaporised;
};

void evaluate(const Material& material, const std::vector<double>& density, const std::vector<double>& energy,
              Arrays& a) {
  material.eos->evaluate({density, energy, a.pressure, a.temperature, a.sound_speed, a.melted, a.vaporised});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  constexpr std::size_t side = 1000, n = side * side;
  constexpr int repetitions = 3;
  const Material material = read_material(argv[1]);
  // 8 to 12 g/cm^3, 0.3 to 6 MJ/kg, in the order of np.meshgrid.
  std::vector<double> density(n), energy(n);
  for (std::size_t i = 0; i < n; ++i) {
    density[i] = 8000 + 4000.0 * static_cast<double>(i % side) / (side - 1);
    energy[i] = 0.3e6 + 5.7e6 * static_cast<double>(i / side) / (side - 1);
  }
  double fresh = std::numeric_limits<double>::infinity(), reused = fresh;
  Arrays same(n);
  for (int k = 0; k < repetitions; ++k) {
    const double begin = processor_time();
    {
      Arrays results(n);
      evaluate(material, density, energy, results);
    }
    const double middle = processor_time();
    evaluate(material, density, energy, same);
    fresh = std::min(fresh, middle - begin);
    reused = std::min(reused, processor_time() - middle);
  }
  std::printf("%.9g %.9g %.17g\n", fresh, reused, same.pressure[n / 3]);
}
