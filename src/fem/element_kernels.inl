// SPDX-License-Identifier: BSD-3-Clause
// Included by element_kernels.hpp, once per set of registers.

#include "src/fem/hexahedron.inl"

/// Elements that go together, one per lane: `width` of an ElementGroup, those from a lane of it on. What
/// lanes without an element hold is nobody's.
struct Group {
  const ElementGroup& all;
  std::size_t lane;
  std::size_t count;  ///< lanes that are results
  std::size_t first;  ///< element

  Group(const ElementGroup& group, std::size_t first_lane)
      : all(group),
        lane(first_lane),
        count(std::min<std::size_t>(width, group.count - first_lane)),
        first(group.first + first_lane) {}

  /// The element of a lane; of lanes without one, the last.
  [[nodiscard]] std::size_t index(std::size_t l) const { return first + std::min(l, count - 1); }

  /// One number per element, and back.
  [[nodiscard]] WHIPPLE_INLINE Vector load(const std::vector<double>& from) const {
    return load_lanes(&from[first], count);
  }
  WHIPPLE_INLINE void store(std::vector<double>& to, Vector values) const {
    store_lanes(&to[first], values, count);
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
  /// An eighth of the field, as `modes` needs it.
  void copy(const Mesh& mesh, std::size_t block, const std::vector<Vector3>& field) {
    const Blocks& blocks = mesh.blocks;
    const std::uint32_t first = blocks.first_slot[block], end = blocks.first_slot[block + 1];
    const auto put = [&](std::uint32_t s, std::size_t i, Vector x)
                         WHIPPLE_INLINE { store_lanes(&at_[i][s - first], 0.125 * x, width); };
    for (std::uint32_t s = first; s < end; s += width) {
      const std::uint32_t* const node = &blocks.slot_node[s];
      if (s + width <= end && node[width - 1] - node[0] == width - 1) {  // ascending: no gap between them
        const auto c = load_vectors(field[node[0]].data());
        for (std::size_t i = 0; i < 3; ++i) put(s, i, c[i]);
        continue;
      }
      std::array<Lanes, width> rows;
      for (std::uint32_t l = 0; l < width; ++l) {
        rows[l] = load_vector(field[blocks.slot_node[std::min(s + l, end - 1)]].data());
      }
      const auto c = columns(rows);
      for (std::size_t i = 0; i < 3; ++i) put(s, i, c[i]);
    }
  }
  /// To where the slots are after a time dt (s) with velocities, in the very operations of `move_nodes`.
  void advance(const Mesh& mesh, std::size_t block, double dt, const BlockField& velocity) {
    const std::uint32_t count = mesh.blocks.first_slot[block + 1] - mesh.blocks.first_slot[block];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::uint32_t s = 0; s < count; s += width) {
        const Vector there = load_lanes(&at_[i][s], width) + dt * load_lanes(&velocity.at_[i][s], width);
        store_lanes(&at_[i][s], there, width);
      }
    }
  }
  void zero(const Mesh& mesh, std::size_t block) {
    const std::uint32_t count = mesh.blocks.first_slot[block + 1] - mesh.blocks.first_slot[block];
    for (auto& component : at_) std::fill_n(component, count, 0.0);
  }
  /// The values at the slots.
  void copy_to(std::span<Vector3> values) const {
    std::size_t s = 0;
    for (; s + width <= values.size(); s += width) {
      const auto along = [&](std::size_t i) WHIPPLE_INLINE { return load_lanes(&at_[i][s], width); };
      store_vectors(values[s].data(), along(0), along(1), along(2));
    }
    for (; s < values.size(); ++s) values[s] = Vector3(at_[0][s], at_[1][s], at_[2][s]);
  }

  /// Copied values of a group, as modes.
  class OfGroup {
   public:
    OfGroup(BlockField& field, const Group& group) : field_(field), group_(group) {
      if (group.all.is_row != 0) return;
      for (std::size_t a = 0; a < 8; ++a) {
        for (auto& component : field.at_) {
          const Vector corner = gather_lanes(component, &group.all.slot[a][group.lane]);
          store_lanes(&component[group.all.place[a] + group.lane], corner, width);
        }
      }
    }
    /// Returns one component of the field as modes: few numbers, which stay in registers.
    [[nodiscard]] WHIPPLE_INLINE std::array<Vector, 7> component(std::size_t i) const {
      std::array<Vector, 8> u;
      for (std::size_t a = 0; a < 8; ++a) {
        u[a] = load_lanes(&field_.at_[i][group_.all.place[a] + group_.lane], width);
      }
      return modes_of_eighths(u);
    }
    [[nodiscard]] WHIPPLE_INLINE Modes<Vector> modes() const {
      return modes_by_components(component(0), component(1), component(2));
    }

   private:
    const BlockField& field_;
    const Group& group_;
  };
  [[nodiscard]] WHIPPLE_INLINE OfGroup of(const Group& group) { return OfGroup(*this, group); }

  /// Adds the corners' parts of a field given by its modes.
  WHIPPLE_INLINE void add(const Group& group, const Modes<Vector>& field) {
    const std::array<Triple<Vector>, 8> corners = corners_of(field);
    add_component(at_[0], group, [&](std::size_t a) WHIPPLE_INLINE { return corners[a].x; });
    add_component(at_[1], group, [&](std::size_t a) WHIPPLE_INLINE { return corners[a].y; });
    add_component(at_[2], group, [&](std::size_t a) WHIPPLE_INLINE { return corners[a].z; });
  }

 private:
  template <class Share>
  WHIPPLE_INLINE static void add_component(double* to, const Group& group, const Share& share) {
    // Corners at the back and at the front of elements along a direction, edge by edge.
    const auto add_lines = [&](const std::array<std::size_t, 4>& back,
                               const std::array<std::size_t, 4>& front) WHIPPLE_INLINE {
      for (std::size_t edge = 0; edge < 4; ++edge) {
        add_to_line(to + group.all.place[back[edge]] + group.lane, share(back[edge]), share(front[edge]),
                    group.count);
      }
    };
    switch (group.all.along) {
      case 1:
        return add_lines({0, 3, 4, 7}, {1, 2, 5, 6});
      case 2:
        return add_lines({0, 1, 4, 5}, {3, 2, 7, 6});
      case 3:
        return add_lines({0, 1, 2, 3}, {4, 5, 6, 7});
      default:
        break;
    }
    std::array<Vector, 8> shares;
    for (std::size_t a = 0; a < 8; ++a) shares[a] = share(a);
    for (std::size_t l = 0; l < group.count; ++l) {
      for (std::size_t a = 0; a < 8; ++a) to[group.all.slot[a][group.lane + l]] += shares[a][l];
    }
  }

  double at_[3][ElementGroup::gathered_place(8)];  // NOLINT: without initialisation
};

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
    for (std::size_t l = 0; l < width; ++l) rows[l] = 8 * group.index(l) + number;
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

/// Deviators of points, those of lane l from row(l) on.
template <class Row>
WHIPPLE_INLINE inline Columns<Vector> deviator_of(Row&& row) {
  static_assert(sizeof(SymmetricTensor) == 6 * sizeof(double));
  std::array<Lanes, width> front, back;
  for (std::size_t l = 0; l < width; ++l) {
    const double* const s = row(l);
    front[l] = whipple::load(s);
    back[l] = whipple::load(s + 2);
  }
  const auto normal = columns(front), shear = columns(back);  // xx yy zz xy, zz xy yz zx
  const Vector &xy = normal[3], &yz = shear[2], &zx = shear[3];
  return {{normal[0], xy, zx}, {xy, normal[1], yz}, {zx, yz, normal[2]}};
}
WHIPPLE_INLINE inline Columns<Vector> deviator_at(const GaussPoints& points, const Rows& at) {
  return deviator_of([&](std::size_t l) WHIPPLE_INLINE { return &points.deviatoric_stress[at[l]].xx; });
}
/// Those of a group of elements with one point. (Lanes without an element may take what follows in the
/// block.)
WHIPPLE_INLINE inline Columns<Vector> deviator_at(const GaussPoints& points, const Group& group) {
  constexpr std::size_t n = 6;
  const std::vector<SymmetricTensor>& all = points.deviatoric_stress;
  const double* from = &all[group.first].xx;
  std::array<double, n * width> last;  // without initialisation
  if (group.first % Blocks::size + width > Blocks::size || group.first + width > all.size()) {
    for (std::size_t l = 0; l < width; ++l) std::copy_n(&all[group.index(l)].xx, n, &last[n * l]);
    from = last.data();
  }
  return deviator_of([&](std::size_t l) WHIPPLE_INLINE { return from + n * l; });
}

/// -(p + q)
WHIPPLE_INLINE inline Vector mean_stress_at(const GaussPoints& points, const Rows& at) {
  Vector stress;
  for (std::size_t l = 0; l < width; ++l) {
    stress[l] = -(points.pressure[at[l]] + points.artificial_viscosity[at[l]]);
  }
  return stress;
}

/// Calls f(component of q, the array of it) for the twelve components of hourglass forces.
template <class Function>
WHIPPLE_INLINE inline void for_each_hourglass_component(std::array<Triple<Vector>, 4>& q, Function&& f) {
  constexpr auto components = Elements::hourglass_components();
  for (std::size_t m = 0; m < 4; ++m) {
    f(q[m].x, components[3 * m]);
    f(q[m].y, components[3 * m + 1]);
    f(q[m].z, components[3 * m + 2]);
  }
}
WHIPPLE_INLINE inline std::array<Triple<Vector>, 4> hourglass_forces_of(const Elements& elements,
                                                                        const Group& group) {
  std::array<Triple<Vector>, 4> q;
  for_each_hourglass_component(
      q, [&](Vector& x, const auto component) WHIPPLE_INLINE { x = group.load(elements.*component); });
  return q;
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

/// Calls f(L_ij, component) for the nine components of a gradient.
template <class Function>
WHIPPLE_INLINE inline void for_each_component(const Columns<Vector>& l, Function&& f) {
  f(l.x.x, 0), f(l.y.x, 1), f(l.z.x, 2);
  f(l.x.y, 3), f(l.y.y, 4), f(l.z.y, 5);
  f(l.x.z, 6), f(l.y.z, 7), f(l.z.z, 8);
}

/// The four modes that the mean gradient does not see.
constexpr std::array<Triple<Vector> Modes<Vector>::*, 4> hourglass_modes = {
    &Modes<Vector>::eta_zeta, &Modes<Vector>::zeta_xi, &Modes<Vector>::xi_eta, &Modes<Vector>::xi_eta_zeta};

/// The report of a block in the making: sums of each lane of the groups.
struct Tally {
  std::array<Vector, ElementGroup::size / width> work{}, hourglass_work{};
  DeformationReport inverted;

  WHIPPLE_INLINE void add(const Group& group, Vector work_done, Vector hourglass_work_done) {
    work[group.lane / width] += first_lanes(work_done, group.count);
    hourglass_work[group.lane / width] += first_lanes(hourglass_work_done, group.count);
  }
  WHIPPLE_INLINE void count_inverted(const Group& group, Vector volume) {
    if (all_positive(volume)) return;
    for (std::size_t l = 0; l < group.count; ++l) {
      if (volume[l] > 0.0) continue;
      ++inverted.inverted;
      inverted.first_inverted = std::min(inverted.first_inverted, group.index(l));
    }
  }
  [[nodiscard]] DeformationReport report() const {
    DeformationReport report = inverted;
    for (std::size_t part = 0; part < work.size(); ++part) {
      for (std::size_t l = 0; l < width; ++l) {
        report.work += work[part][l];
        report.hourglass_work += hourglass_work[part][l];
      }
    }
    return report;
  }
};

/// Returns the factor by which the plastic strain since the last step reduces the hourglass forces (eq. 3.7),
/// and marks it as applied.
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

/// Fields at the corners of a group that determine its motion.
struct Fields {
  BlockField::OfGroup position, mean_velocity, end_velocity;
};

/// The matrix of the rows row(index, axis).
template <class Row>
WHIPPLE_INLINE inline Columns<Vector> by_rows(Row&& row) {
  const Triple<Vector> x = row(0, &Triple<Vector>::x), y = row(1, &Triple<Vector>::y),
                       z = row(2, &Triple<Vector>::z);
  return {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}};
}

template <HourglassControl::Kind kind>
struct OnePoint {
  static constexpr bool viscous = kind == HourglassControl::Kind::viscous;

  WHIPPLE_INLINE void operator()(const DeformationStep& step, const Group& group, const Fields& fields,
                                 Tally& tally) const {
    GaussPoints& points = step.mesh.points;
    Elements& elements = step.mesh.elements;
    if (const std::size_t first = group.first; group.lane == 0) {
      prefetch(first + prefetch_distance, points.mass, points.pressure, points.artificial_viscosity,
               points.deviatoric_stress, points.sound_speed, points.plastic_strain, points.length,
               points.specific_internal_energy, elements.hourglass_energy, elements.returned_plastic_strain);
      for (const auto component : Elements::hourglass_components()) {
        prefetch(first + prefetch_distance, elements.*component);
      }
    }
    const double dt = step.dt;
    const Modes<Vector> x = fields.position.modes();
    const VolumeGradient<Vector> beta = volume_gradient(x);
    const Vector per_volume = 1.0 / beta.volume, per_eighth = 8.0 * per_volume;

    // Component by component, each a row of a gradient: there are not registers enough for all of a field.
    using Axis = Vector Triple<Vector>::*;
    std::array<Triple<Vector>, 4> end_modes;
    Modes<Vector> moved = x;
    const auto end_row = [&](std::size_t i, Axis axis) WHIPPLE_INLINE {
      const std::array<Vector, 7> u = fields.end_velocity.component(i);
      moved.xi.*axis += dt * u[0];
      moved.eta.*axis += dt * u[1];
      moved.zeta.*axis += dt * u[2];
      moved.eta_zeta.*axis += dt * u[3];
      moved.zeta_xi.*axis += dt * u[4];
      moved.xi_eta.*axis += dt * u[5];
      for (std::size_t m = 0; m < 4; ++m) end_modes[m].*axis = u[3 + m];
      return per_eighth * mean_gradient_times_eighth(u, beta);
    };
    const Columns<Vector> l = by_rows(end_row);

    // Velocity gradient of the step. First, because the divisions that follow one another in it take long.
    const VolumeGradient<Vector> end = volume_gradient(moved);
    for_each_component(with_volume_ratio(l, end.volume * per_volume, dt),
                       [&](const Vector& value, std::size_t k)
                           WHIPPLE_INLINE { group.store(step.gradient.component[k], value); });
    group.store(points.length, one_point_length(end));

    // Work of the stress (eq. 2.7) and of the hourglass forces (eq. 3.6), on the mean velocity.
    auto q = hourglass_forces_of(elements, group);
    Vector hourglass_rate{};
    const Columns<Vector> mean = by_rows([&](std::size_t i, Axis axis) WHIPPLE_INLINE {
      const std::array<Vector, 7> u = fields.mean_velocity.component(i);
      for (std::size_t m = 0; m < 4; ++m) hourglass_rate += q[m].*axis * u[3 + m];
      return mean_gradient_times_eighth(u, beta);
    });
    const Columns<Vector> deviator = deviator_at(points, group);
    Columns<Vector> stress = deviator;
    add_to_diagonal(stress, -(group.load(points.pressure) + group.load(points.artificial_viscosity)));
    const Vector work = (8.0 * dt) * contraction(stress, mean);
    Columns<Vector> carried{};  // sum_k Q_k x_k^T
    for (std::size_t m = 0; m < 4; ++m) add_dyad(carried, q[m], x.*hourglass_modes[m]);
    const Vector hourglass_work = (root8 * dt) * (hourglass_rate - per_eighth * contraction(carried, mean));

    // Hourglass forces of the next step (eq. 3.3, 3.4).
    const Vector sound_speed = group.load(points.sound_speed), rate = sound_speed * per_volume;
    const Vector frequency_squared = 8.0 * beta.squared_norm() * rate * rate;  // eq. 5.1
    const double coefficient = 0.125 * root8 * step.hourglass.coefficient;
    const Vector mass = group.load(points.mass);
    const Vector resistance = mass * (viscous ? 2.0 * coefficient * root(frequency_squared)
                                              : (coefficient * dt) * frequency_squared);
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
        q[m] = resistance * (end_modes[m] - l * (x.*mode));
      } else {
        q[m] += resistance * end_modes[m] + l * (dt * q[m] - resistance * (x.*mode));
      }
    }
    for_each_hourglass_component(q, [&](const Vector& force, const auto component)
                                        WHIPPLE_INLINE { group.store(elements.*component, force); });

    group.store(points.specific_internal_energy,
                group.load(points.specific_internal_energy) + (work + heat) / mass);
    tally.add(group, work, hourglass_work);
    tally.count_inverted(group, end.volume);
  }
};

struct DeformEightPoints {
  void operator()(const DeformationStep& step, const Group& group, const Fields& fields, Tally& tally) const {
    const Modes<Vector> x = fields.position.modes(), mean_velocity = fields.mean_velocity.modes(),
                        end_velocity = fields.end_velocity.modes();
    GaussPoints& points = step.mesh.points;
    const double dt = step.dt;
    const VolumeGradient<Vector> beta = volume_gradient(x);
    const Modes<Vector> end_position = x + dt * end_velocity;
    const VolumeGradient<Vector> end = volume_gradient(end_position);
    const Vector ratio = end.volume / beta.volume;
    const auto along = [&](std::size_t i) {
      return mean_gradient_times_eighth(fields.mean_velocity.component(i), beta);
    };
    const Vector mean_divergence = 8.0 * (along(0).x + along(1).y + along(2).z) / beta.volume;
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
      const Columns<Vector> l = with_volume_ratio(scaled(in_space(end_velocity), 1.0 / det), ratio, dt);
      for_each_component(l, [&](const Vector& value, std::size_t c) {
        for (std::size_t k = 0; k < group.count; ++k) step.gradient.component[c][rows[k]] = value[k];
      });
      for (std::size_t k = 0; k < group.count; ++k) {
        points.specific_internal_energy[rows[k]] += work[k] / points.mass[rows[k]];
        points.length[rows[k]] = length[k];
      }
      total += work;
    }
    tally.add(group, total, Vector{});
    tally.count_inverted(group, least_jacobian);
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
    const VolumeGradient<Vector> beta = volume_gradient(x);
    Columns<Vector> stress = deviator_at(mesh.points, group);
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

/// Prefetches part g of the node data that the next block copies.
template <class... Fields>
WHIPPLE_INLINE inline void prefetch_next_block(const Mesh& mesh, std::size_t block, std::size_t g,
                                               const Fields&... fields) {
  const Blocks& blocks = mesh.blocks;
  if (block + 1 >= blocks.count()) return;
  const std::size_t groups = blocks.first_group[block + 1] - blocks.first_group[block];
  const std::size_t first = blocks.first_slot[block + 1], count = blocks.first_slot[block + 2] - first;
  for (std::size_t s = first + count * g / groups; s < first + count * (g + 1) / groups; ++s) {
    (__builtin_prefetch(fields[blocks.slot_node[s]].data(), 0, 2), ...);
  }
}

/// The entries. Everything they call is inlined into them.
struct Kernels {
  using Field = BlockField;

  /// The positions of the nodes of a block.
  WHIPPLE_WHOLE_KERNEL static void copy_positions(const Mesh& mesh, std::size_t block, BlockField& position) {
    position.copy(mesh, block, mesh.nodes.position);
  }

  /// Calls kernel(step, group, fields, tally) for the elements of a block.
  /// @param position  those at the end of the step, afterwards
  template <class Kernel>
  WHIPPLE_WHOLE_KERNEL static DeformationReport deform(const DeformationStep& step, const Motion& motion,
                                                       std::size_t block, const Kernel& kernel,
                                                       BlockField& position) {
    BlockField mean, end;
    position.copy(step.mesh, block, step.mesh.nodes.position);
    mean.copy(step.mesh, block, motion.mean);
    end.copy(step.mesh, block, motion.end);
    Tally tally;
    const std::span<const ElementGroup> groups = groups_of(step.mesh, block);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      prefetch_next_block(step.mesh, block, g, step.mesh.nodes.position, motion.mean, motion.end);
      for_each_part(groups[g], [&](const Group& group) WHIPPLE_INLINE {
        kernel(step, group, Fields{position.of(group), mean.of(group), end.of(group)}, tally);
      });
    }
    position.advance(step.mesh, block, step.dt, end);
    return tally.report();
  }

  /// Forces kernel(mesh, group, position by modes) of the elements of a block, at its slots.
  template <class Kernel>
  WHIPPLE_WHOLE_KERNEL static void forces(Mesh& mesh, std::size_t block, const Kernel& kernel,
                                          BlockField& position) {
    BlockField force;
    force.zero(mesh, block);
    for (const ElementGroup& all : groups_of(mesh, block)) {
      for_each_part(all, [&](const Group& group) WHIPPLE_INLINE {
        force.add(group, kernel(mesh, group, position.of(group).modes()));
      });
    }
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
