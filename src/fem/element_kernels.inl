// SPDX-License-Identifier: BSD-3-Clause
// Included by element_kernels.hpp, once per set of registers.

#include "src/fem/hexahedron.inl"

/// Elements that go together, one per lane: `width` of an ElementGroup, those from a lane of it on. Lanes
/// without an element repeat the index of the last one; what they hold is nobody's.
struct Group {
  const ElementGroup& all;
  std::size_t lane;
  std::size_t count;  ///< lanes that are results
  std::array<std::size_t, width> index;

  Group(const ElementGroup& group, std::size_t first_lane)
      : all(group), lane(first_lane), count(std::min<std::size_t>(width, group.count - first_lane)) {
    for (std::size_t l = 0; l < width; ++l) index[l] = group.first + lane + std::min(l, count - 1);
  }

  /// One number per element, and back.
  [[nodiscard]] WHIPPLE_INLINE Vector load(const std::vector<double>& from) const {
    return load_lanes(&from[index[0]], count);
  }
  WHIPPLE_INLINE void store(std::vector<double>& to, Vector values) const {
    store_lanes(&to[index[0]], values, count);
  }
  /// Calls f(lane) for those that are results.
  template <class Function>
  WHIPPLE_INLINE void for_each_lane(std::size_t first, Function&& f) const {
    if (first + 4 <= count) {
      for (std::size_t l = 0; l < 4; ++l) f(first + l);
    } else {
      for (std::size_t l = first; l < count; ++l) f(l);
    }
  }
  /// Adds the lanes that are results to a sum, four after four.
  WHIPPLE_INLINE void add_to(double& sum, Vector values) const {
    for (std::size_t first = 0; first < width; first += 4) {
      double total = 0.0;
      for_each_lane(first, [&](std::size_t l) WHIPPLE_INLINE { total += values[l]; });
      sum += total;
    }
  }
};

/// The groups of a block.
WHIPPLE_INLINE inline std::span<const ElementGroup> groups_of(const Mesh& mesh, std::size_t block) {
  const Blocks& blocks = mesh.blocks;
  return std::span(blocks.groups)
      .subspan(blocks.first_group[block], blocks.first_group[block + 1] - blocks.first_group[block]);
}

/// Calls f(Group) for the elements of a group.
template <class Function>
WHIPPLE_INLINE inline void for_each_part(const ElementGroup& all, Function&& f) {
  for (std::size_t lane = 0; lane < all.count; lane += width) f(Group(all, lane));
}

/// A nodal field at the slots of a block; not initialised. Behind the slots there is place for the corners of
/// a group.
class BlockField {
 public:
  void copy(const Mesh& mesh, std::size_t block, const std::vector<Vector3>& field) {
    const Blocks& blocks = mesh.blocks;
    const std::uint32_t first = blocks.first_slot[block], end = blocks.first_slot[block + 1];
    for (std::uint32_t s = first; s < end; s += width) {
      std::array<Lanes, width> rows;
      for (std::uint32_t l = 0; l < width; ++l) {
        rows[l] = load_vector(field[blocks.slot_node[std::min(s + l, end - 1)]].data());
      }
      const auto c = columns(rows);
      for (std::size_t i = 0; i < 3; ++i) store_lanes(&at_[i][s - first], c[i], width);
    }
  }
  void zero(const Mesh& mesh, std::size_t block) {
    const std::uint32_t count = mesh.blocks.first_slot[block + 1] - mesh.blocks.first_slot[block];
    for (auto& component : at_) std::fill_n(component, count, 0.0);
  }
  /// The values at the slots.
  void copy_to(std::span<Vector3> values) const {
    for (std::size_t s = 0; s < values.size(); s += width) {
      const auto along = [&](std::size_t i) WHIPPLE_INLINE { return load_lanes(&at_[i][s], width); };
      const auto r = rows({along(0), along(1), along(2), Vector{}});
      for (std::size_t l = 0; l < std::min<std::size_t>(width, values.size() - s); ++l)
        store_vector(values[s + l].data(), r[l]);
    }
  }

  /// Coefficients of the modes.
  [[nodiscard]] WHIPPLE_INLINE Modes<Vector> modes(const Group& group) {
    std::array<std::size_t, 8> first;
    for (std::size_t a = 0; a < 8; ++a) {
      first[a] = group.all.is_row != 0 ? group.all.slot[a][0] + group.lane : place_of(a);
    }
    if (group.all.is_row == 0) {
      for (std::size_t a = 0; a < 8; ++a) {
        for (auto& component : at_) {
          store_lanes(&component[place_of(a)], gather_lanes(component, &group.all.slot[a][group.lane]),
                      width);
        }
      }
    }
    std::array<Triple<Vector>, 8> u;
    for (std::size_t a = 0; a < 8; ++a) {
      const auto along = [&](std::size_t i) WHIPPLE_INLINE { return load_lanes(&at_[i][first[a]], width); };
      u[a] = {along(0), along(1), along(2)};
    }
    return modes_of(u);
  }
  /// Keeps the corners' shares of a field given by its modes for `add`.
  /// @param parity  0 or 1: those of two groups are kept
  WHIPPLE_INLINE void put(const Group& group, const Modes<Vector>& field, std::size_t parity) {
    const auto corners = corners_of(field);
    for (std::size_t a = 0; a < 8; ++a) {
      const std::size_t place = place_of(a, parity) + group.lane;
      store_lanes(&at_[0][place], corners[a].x, width);
      store_lanes(&at_[1][place], corners[a].y, width);
      store_lanes(&at_[2][place], corners[a].z, width);
    }
  }
  /// Adds what was kept of four corners of a group.
  WHIPPLE_INLINE void add(const ElementGroup& group, const std::array<std::size_t, 4>& corners,
                          std::size_t parity) {
    for (const std::size_t a : corners) {
      for (auto& component : at_) {
        const double* const shares = &component[place_of(a, parity)];
        if (group.is_row != 0) {
          double* const to = &component[group.slot[a][0]];
          for (std::size_t l = 0; l < group.count; l += width) {
            const Vector share = load_lanes(shares + l, std::min<std::size_t>(width, group.count - l));
            store_lanes(to + l, load_lanes(to + l, width) + share, width);
          }
        } else {
          for (std::size_t l = 0; l < group.count; ++l) component[group.slot[a][l]] += shares[l];
        }
      }
    }
  }

 private:
  static constexpr std::size_t places = 8 * Blocks::size;
  static constexpr std::size_t place_of(std::size_t corner, std::size_t parity = 0) {
    return places + ElementGroup::size * (8 * parity + corner);
  }

  double at_[3][places + 16 * ElementGroup::size];  // NOLINT: without initialisation
};

/// n numbers one after the other per element. From the last lane to the first: that of the last element comes
/// after those that are nobody's.
template <std::size_t n>
WHIPPLE_INLINE inline void scatter(const std::array<Vector, n>& values,
                                   const std::array<double*, width>& to) {
  for (std::size_t j = 0; j < n / 4 * 4; j += 4) {
    const auto four = rows({values[j], values[j + 1], values[j + 2], values[j + 3]});
    for (std::size_t l = width; l-- > 0;) whipple::store(to[l] + j, four[l]);
  }
  for (std::size_t j = n / 4 * 4; j < n; ++j) {
    for (std::size_t l = width; l-- > 0;) to[l][j] = values[j][l];
  }
}

using Rows = std::array<std::size_t, width>;

/// One of the 2 x 2 x 2 Gauss points; weight 1.
struct GaussPoint {
  std::size_t number;
  double xi, eta, zeta;

  explicit GaussPoint(std::size_t g)
      : number(g),
        xi(gauss_coordinate * corner_coordinates[g][0]),
        eta(gauss_coordinate * corner_coordinates[g][1]),
        zeta(gauss_coordinate * corner_coordinates[g][2]) {}

  [[nodiscard]] Rows rows(const Group& group) const {
    Rows rows;
    for (std::size_t l = 0; l < width; ++l) rows[l] = 8 * group.index[l] + number;
    return rows;
  }
  template <class T>
  [[nodiscard]] Columns<T> gradient(const Modes<T>& u) const {
    return natural_gradient(u, xi, eta, zeta);
  }
};

template <class T>
void add_to_diagonal(Columns<T>& m, const T& value) {
  m.x.x += value;
  m.y.y += value;
  m.z.z += value;
}

WHIPPLE_INLINE inline Columns<Vector> deviator_at(const GaussPoints& points, const Rows& at) {
  static_assert(sizeof(SymmetricTensor) == 6 * sizeof(double));
  std::array<Lanes, width> front, back;
  for (std::size_t l = 0; l < width; ++l) {
    const double* const s = &points.deviatoric_stress[at[l]].xx;
    front[l] = whipple::load(s);
    back[l] = whipple::load(s + 2);
  }
  const auto normal = columns(front), shear = columns(back);  // xx yy zz xy, zz xy yz zx
  const Vector &xy = normal[3], &yz = shear[2], &zx = shear[3];
  return {{normal[0], xy, zx}, {xy, normal[1], yz}, {zx, yz, normal[2]}};
}

/// -(p + q)
WHIPPLE_INLINE inline Vector mean_stress_at(const GaussPoints& points, const Rows& at) {
  Vector stress;
  for (std::size_t l = 0; l < width; ++l) {
    stress[l] = -(points.pressure[at[l]] + points.artificial_viscosity[at[l]]);
  }
  return stress;
}

WHIPPLE_INLINE inline std::array<Triple<Vector>, 4> hourglass_forces_of(const Elements& elements,
                                                                        const Group& group) {
  std::array<Vector, 12> q;
  for (std::size_t j = 0; j < 12; j += 4) {
    std::array<Lanes, width> rows;
    for (std::size_t l = 0; l < width; ++l) {
      rows[l] = whipple::load(elements.hourglass_force[group.index[l]].data() + j);
    }
    const auto four = columns(rows);
    std::copy_n(four.begin(), 4, q.begin() + j);
  }
  return {{{q[0], q[1], q[2]}, {q[3], q[4], q[5]}, {q[6], q[7], q[8]}, {q[9], q[10], q[11]}}};
}

template <class T>
WHIPPLE_INLINE inline Columns<T> scaled(const Columns<T>& m, const T& factor) {
  return {factor * m.x, factor * m.y, factor * m.z};
}

/// The gradient whose volume ratio det(I + dt L) is `ratio` (eq. 2.8).
WHIPPLE_INLINE inline Columns<Vector> with_volume_ratio(const Columns<Vector>& gradient, const Vector& ratio,
                                                        double dt) {
  Columns<Vector> f = scaled(gradient, in_all(dt));
  add_to_diagonal(f, in_all(1.0));
  const Vector stretch = cube_root_near_one(ratio / determinant(f));
  // (stretch F - I)/dt without the difference of large numbers
  Columns<Vector> result = scaled(gradient, stretch);
  add_to_diagonal(result, (stretch - 1.0) / dt);
  return result;
}

WHIPPLE_INLINE inline void store_gradient(const DeformationStep& step, const Rows& at,
                                          const Columns<Vector>& l) {
  std::array<double*, width> to;
  for (std::size_t k = 0; k < width; ++k) to[k] = step.gradient[at[k]].data();
  scatter<9>({l.x.x, l.x.y, l.x.z, l.y.x, l.y.y, l.y.z, l.z.x, l.z.y, l.z.z}, to);
}

/// The four modes that the mean gradient does not see.
constexpr std::array<Triple<Vector> Modes<Vector>::*, 4> hourglass_modes = {
    &Modes<Vector>::eta_zeta, &Modes<Vector>::zeta_xi, &Modes<Vector>::xi_eta, &Modes<Vector>::xi_eta_zeta};

WHIPPLE_INLINE inline void count_inverted(const Group& group, Vector volume, DeformationReport& report) {
  if (all_positive(volume)) return;
  for (std::size_t l = 0; l < group.count; ++l) {
    if (volume[l] > 0.0) continue;
    ++report.inverted;
    report.first_inverted = std::min(report.first_inverted, group.index[l]);
  }
}

/// What the plastic strain since the last step leaves of the hourglass forces (eq. 3.7); marks it as done.
/// @param modulus  rho c^2
WHIPPLE_INLINE inline Vector return_factor(const Group& group, Elements& elements, const GaussPoints& points,
                                           const Columns<Vector>& deviator, const Vector& modulus) {
  const Vector strain = group.load(points.plastic_strain);
  const Vector increment = strain - group.load(elements.returned_plastic_strain);
  group.store(elements.returned_plastic_strain, strain);
  const Vector overshoot = 0.8 * modulus * maximum(increment, Vector{});  // 3 G dep of metals
  const Vector equivalent = root(1.5 * contraction(deviator, deviator));
  return overshoot > 0.0 ? equivalent / (equivalent + overshoot) : in_all(1.0);
}

template <HourglassControl::Kind kind>
struct OnePoint {
  static constexpr bool viscous = kind == HourglassControl::Kind::viscous;

  WHIPPLE_INLINE void operator()(const DeformationStep& step, const Group& group, const Modes<Vector>& x,
                                 const Modes<Vector>& mean_velocity, const Modes<Vector>& end_velocity,
                                 DeformationReport& report) const {
    GaussPoints& points = step.mesh.points;
    Elements& elements = step.mesh.elements;
    if (const std::size_t first = group.index[0]; group.lane == 0) {
      prefetch(first + prefetch_distance, points.mass, points.pressure, points.artificial_viscosity,
               points.deviatoric_stress, points.sound_speed, points.plastic_strain, points.length,
               points.specific_internal_energy, elements.hourglass_force, elements.hourglass_energy,
               elements.returned_plastic_strain);
    }
    const double dt = step.dt;
    const VolumeGradient<Vector> beta = volume_gradient(x);
    const Vector per_volume = 1.0 / beta.volume;
    const Vector mass = group.load(points.mass);

    // Velocity gradient of the step. First, because the divisions that follow one another in it take long.
    const VolumeGradient<Vector> end = volume_gradient(x + dt * end_velocity);
    const Columns<Vector> l = scaled(mean_gradient_times_volume(end_velocity, beta), per_volume);
    store_gradient(step, group.index, with_volume_ratio(l, end.volume * per_volume, dt));

    // Work of the stress (eq. 2.7) and of the hourglass forces (eq. 3.6), on the mean velocity.
    Columns<Vector> mean = mean_gradient_times_volume(mean_velocity, beta);
    const Columns<Vector> deviator = deviator_at(points, group.index);
    Columns<Vector> stress = deviator;
    add_to_diagonal(stress, -(group.load(points.pressure) + group.load(points.artificial_viscosity)));
    const Vector work = dt * contraction(stress, mean);
    mean = scaled(mean, per_volume);
    auto q = hourglass_forces_of(elements, group);
    Vector hourglass_work{};
    for (std::size_t m = 0; m < 4; ++m) {
      const auto mode = hourglass_modes[m];
      hourglass_work += dot(q[m], mean_velocity.*mode - mean * (x.*mode));
    }
    hourglass_work = (root8 * dt) * hourglass_work;

    // Hourglass forces of the next step (eq. 3.3, 3.4).
    const Vector sound_speed = group.load(points.sound_speed);
    const Vector frequency = root8 * sound_speed * root(beta.squared_norm()) * per_volume;
    const double coefficient = 0.125 * root8 * step.hourglass.coefficient;
    const Vector resistance =
        mass * frequency * (viscous ? in_all(2.0 * coefficient) : (coefficient * dt) * frequency);
    Vector heat = hourglass_work;
    if constexpr (!viscous) {
      const Vector returned =
          return_factor(group, elements, points, deviator, mass * per_volume * sound_speed * sound_speed);
      const Vector stored = group.load(elements.hourglass_energy) + hourglass_work;
      heat = (1.0 - returned * returned) * maximum(stored, Vector{});
      group.store(elements.hourglass_energy, stored - heat);
      for (Triple<Vector>& force : q) force = returned * force;
    }
    for (std::size_t m = 0; m < 4; ++m) {
      const auto mode = hourglass_modes[m];
      if constexpr (viscous) {
        q[m] = resistance * (end_velocity.*mode - l * (x.*mode));
      } else {
        q[m] += resistance * (end_velocity.*mode) + l * (dt * q[m] - resistance * (x.*mode));
      }
    }
    std::array<double*, width> to;
    for (std::size_t k = 0; k < width; ++k) to[k] = elements.hourglass_force[group.index[k]].data();
    scatter<12>(
        {q[0].x, q[0].y, q[0].z, q[1].x, q[1].y, q[1].z, q[2].x, q[2].y, q[2].z, q[3].x, q[3].y, q[3].z}, to);

    group.store(points.length, one_point_length(end));
    group.store(points.specific_internal_energy,
                group.load(points.specific_internal_energy) + (work + heat) / mass);
    group.add_to(report.work, work);
    group.add_to(report.hourglass_work, hourglass_work);
    count_inverted(group, end.volume, report);
  }
};

struct DeformEightPoints {
  void operator()(const DeformationStep& step, const Group& group, const Modes<Vector>& x,
                  const Modes<Vector>& mean_velocity, const Modes<Vector>& end_velocity,
                  DeformationReport& report) const {
    GaussPoints& points = step.mesh.points;
    const double dt = step.dt;
    const VolumeGradient<Vector> beta = volume_gradient(x);
    const Modes<Vector> end_position = x + dt * end_velocity;
    const VolumeGradient<Vector> end = volume_gradient(end_position);
    const Vector ratio = end.volume / beta.volume;
    const Columns<Vector> mean = mean_gradient_times_volume(mean_velocity, beta);
    const Vector mean_divergence = (mean.x.x + mean.y.y + mean.z.z) / beta.volume;
    const auto [length, least_jacobian] = eight_point_size(end_position, end);
    Vector total{};  // work
    for (std::size_t g = 0; g < 8; ++g) {
      const GaussPoint at(g);
      const Rows rows = at.rows(group);
      const Columns<Vector> jacobian = at.gradient(x), cofactor = cofactors(jacobian);
      const Vector det = determinant(jacobian);
      // du/dxi J^-1 times det J: the rows of the inverse are the columns of the cofactors
      const auto in_space = [&](const Modes<Vector>& u) {
        const Columns<Vector> natural = at.gradient(u);
        Columns<Vector> l{};
        add_dyad(l, natural.x, cofactor.x);
        add_dyad(l, natural.y, cofactor.y);
        add_dyad(l, natural.z, cofactor.z);
        return l;
      };
      // Work (eq. 4.3), velocity gradient (eq. 4.4)
      const Vector work = dt * (contraction(deviator_at(points, rows), in_space(mean_velocity)) +
                                det * mean_stress_at(points, rows) * mean_divergence);
      store_gradient(step, rows, with_volume_ratio(scaled(in_space(end_velocity), 1.0 / det), ratio, dt));
      for (std::size_t k = 0; k < group.count; ++k) {
        points.specific_internal_energy[rows[k]] += work[k] / points.mass[rows[k]];
        points.length[rows[k]] = length[k];
      }
      total += work;
    }
    group.add_to(report.work, total);
    count_inverted(group, least_jacobian, report);
  }
};

/// Forces f_a = sum_k F_k phi_ka of a stress on the mean gradient (eq. 2.6).
WHIPPLE_INLINE inline Modes<Vector> mean_gradient_forces(const Columns<Vector>& stress,
                                                         const VolumeGradient<Vector>& beta) {
  return {-(stress * beta.xi),      -(stress * beta.eta),    -(stress * beta.zeta), -(stress * beta.eta_zeta),
          -(stress * beta.zeta_xi), -(stress * beta.xi_eta), Triple<Vector>{}};
}

struct ForcesOfOnePoint {
  WHIPPLE_INLINE Modes<Vector> operator()(const Mesh& mesh, const Group& group,
                                          const Modes<Vector>& x) const {
    if (const std::size_t first = group.index[0]; group.lane == 0) {
      prefetch(first + prefetch_distance, mesh.points.pressure, mesh.points.artificial_viscosity,
               mesh.points.deviatoric_stress, mesh.elements.hourglass_force);
    }
    const VolumeGradient<Vector> beta = volume_gradient(x);
    Columns<Vector> stress = deviator_at(mesh.points, group.index);
    add_to_diagonal(stress,
                    -(group.load(mesh.points.pressure) + group.load(mesh.points.artificial_viscosity)));
    const auto q = hourglass_forces_of(mesh.elements, group);
    // Hourglass resistance (eq. 3.5): its part along B_a acts like a stress, the rest on the four modes.
    const Vector scale = -root8 / beta.volume;
    const std::array<Triple<Vector>, 4> shape = {x.eta_zeta, x.zeta_xi, x.xi_eta, x.xi_eta_zeta};
    for (std::size_t m = 0; m < 4; ++m) add_dyad(stress, scale * q[m], shape[m]);
    Modes<Vector> f = mean_gradient_forces(stress, beta);
    f.eta_zeta -= (1.0 / root8) * q[0];
    f.zeta_xi -= (1.0 / root8) * q[1];
    f.xi_eta -= (1.0 / root8) * q[2];
    f.xi_eta_zeta -= (1.0 / root8) * q[3];
    return f;
  }
};

struct ForcesOfBBar {
  WHIPPLE_INLINE Modes<Vector> operator()(const Mesh& mesh, const Group& group,
                                          const Modes<Vector>& x) const {
    const VolumeGradient<Vector> beta = volume_gradient(x);
    Modes<Vector> f{};
    Vector mean_stress{};  // times the volume
    for (std::size_t g = 0; g < 8; ++g) {
      const GaussPoint at(g);
      const auto rows = at.rows(group);
      const Columns<Vector> jacobian = at.gradient(x);
      mean_stress += determinant(jacobian) * mean_stress_at(mesh.points, rows);
      // Deviator: det J s : grad u = (s cof J) : du/dxi
      const Columns<Vector> cofactor = cofactors(jacobian), s = deviator_at(mesh.points, rows);
      const Triple<Vector> px = -0.125 * (s * cofactor.x), py = -0.125 * (s * cofactor.y),
                           pz = -0.125 * (s * cofactor.z);
      f.xi += px;
      f.eta += py;
      f.zeta += pz;
      f.eta_zeta += at.zeta * py + at.eta * pz;
      f.zeta_xi += at.zeta * px + at.xi * pz;
      f.xi_eta += at.eta * px + at.xi * py;
      f.xi_eta_zeta += (at.eta * at.zeta) * px + (at.zeta * at.xi) * py + (at.xi * at.eta) * pz;
    }
    // Pressure on the mean gradient.
    Columns<Vector> mean{};
    add_to_diagonal(mean, mean_stress / beta.volume);
    return f + mean_gradient_forces(mean, beta);
  }
};

/// Has a part of what the next block copies of its nodes fetched: group g's share of it.
template <class... Fields>
WHIPPLE_INLINE inline void prefetch_next_block(const Mesh& mesh, std::size_t block, std::size_t g,
                                               const Fields&... fields) {
  const Blocks& blocks = mesh.blocks;
  if (block + 1 >= block_count(mesh)) return;
  const std::size_t groups = blocks.first_group[block + 1] - blocks.first_group[block];
  const std::size_t first = blocks.first_slot[block + 1], count = blocks.first_slot[block + 2] - first;
  for (std::size_t s = first + count * g / groups; s < first + count * (g + 1) / groups; ++s) {
    (__builtin_prefetch(fields[blocks.slot_node[s]].data(), 0, 2), ...);
  }
}

/// The entries. Everything they call is inlined into them.
struct Kernels {
  /// Calls kernel(step, group, position, mean and end velocity by modes, report) for the elements of a block.
  template <class Kernel>
  WHIPPLE_WHOLE_KERNEL static void deform(const DeformationStep& step, const Motion& motion,
                                          std::size_t block, const Kernel& kernel,
                                          DeformationReport& report) {
    BlockField position, mean, end;
    position.copy(step.mesh, block, step.mesh.nodes.position);
    mean.copy(step.mesh, block, motion.mean);
    end.copy(step.mesh, block, motion.end);
    const std::span<const ElementGroup> groups = groups_of(step.mesh, block);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      prefetch_next_block(step.mesh, block, g, step.mesh.nodes.position, motion.mean, motion.end);
      for_each_part(groups[g], [&](const Group& group) WHIPPLE_INLINE {
        kernel(step, group, position.modes(group), mean.modes(group), end.modes(group), report);
      });
    }
  }

  /// Forces kernel(mesh, group, position by modes) of the elements of a block, at its slots.
  template <class Kernel>
  WHIPPLE_WHOLE_KERNEL static void forces(Mesh& mesh, std::size_t block, const Kernel& kernel) {
    BlockField position, force;
    position.copy(mesh, block, mesh.nodes.position);
    force.zero(mesh, block);
    // Sums at neighbouring corners of a row lie one number apart: what was written at one place should not be
    // read at the next before it has reached the cache. So corners of the same colour of a chessboard go
    // together, the second colour after the forces of the next group.
    constexpr std::array<std::size_t, 4> white = {0, 2, 5, 7}, black = {1, 3, 4, 6};
    const std::span<const ElementGroup> groups = groups_of(mesh, block);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      prefetch_next_block(mesh, block, g, mesh.nodes.position);
      for_each_part(groups[g], [&](const Group& group) WHIPPLE_INLINE {
        force.put(group, kernel(mesh, group, position.modes(group)), g % 2);
      });
      force.add(groups[g], white, g % 2);
      if (g > 0) force.add(groups[g - 1], black, (g - 1) % 2);
    }
    force.add(groups.back(), black, (groups.size() - 1) % 2);
    Blocks& blocks = mesh.blocks;
    const std::uint32_t first = blocks.first_slot[block];
    force.copy_to(std::span(blocks.slot_force).subspan(first, blocks.first_slot[block + 1] - first));
  }

  using Viscous = OnePoint<HourglassControl::Kind::viscous>;
  using Stiffness = OnePoint<HourglassControl::Kind::stiffness>;
  using EightPoints = DeformEightPoints;
  using OnePointForces = ForcesOfOnePoint;
  using BBarForces = ForcesOfBBar;
};
