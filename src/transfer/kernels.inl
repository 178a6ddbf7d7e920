// SPDX-License-Identifier: BSD-3-Clause
// Included by kernels.hpp, once per set of registers.

/// Blocks with fewer particles than this use direct access: that costs by the stencil, of which linear
/// functions have one for all particles of a cell.
template <class Shape>
constexpr std::size_t direct_access_below = Shape::count == 2 ? 16 : 6;

/// Copies the part of a node that a local copy holds: all of it, or only the first register.
WHIPPLE_INLINE inline void copy_node(const grid::Node& from, grid::Node& to) {
  store_node(to, load_node(from));
}
WHIPPLE_INLINE inline void copy_node(const grid::Node& from, Lanes& to) { to = from.first; }
WHIPPLE_INLINE inline void add_node(const grid::Node& from, grid::Node& to) {
  store_node(to, load_node(to) + load_node(from));
}
WHIPPLE_INLINE inline void add_node(Lanes from, grid::Node& to) { to.first += from; }
WHIPPLE_INLINE inline void clear_node(grid::Node& node) { store_node(node, both(Lanes{}, Lanes{})); }
WHIPPLE_INLINE inline void clear_node(Lanes& first) { first = Lanes{}; }
WHIPPLE_INLINE inline Lanes& first_register(grid::Node& node) { return node.first; }
WHIPPLE_INLINE inline Lanes& first_register(Lanes& first) { return first; }

/// Copy of the nodes that a block reaches; index = position in the reach, z fastest.
/// @tparam Shape    its stencil gives the reach
/// @tparam Content  what is copied: grid::Node, or Lanes for Node::first
template <class Shape, class Content = grid::Node>
class ReachCopy {
 public:
  static constexpr int before = Shape::stencil.before(), edge = Shape::stencil.edge();
  static constexpr int before_z = Shape::stencil.before_z(), edge_z = Shape::stencil.edge_z();
  static constexpr int size = edge * edge * edge_z;
  static_assert(Shape::stencil.count <= edge - grid::block_edge + 1);

  /// The nodes of one particle.
  struct Stencil {
    Content* origin;
    Content& operator()(std::size_t i, std::size_t j, std::size_t k) const {
      return origin[(i * edge + j) * edge_z + k];
    }
  };
  /// @param first  node, as of grid::PlaceInStencil
  Stencil stencil(std::int32_t first) { return {&nodes_[static_cast<std::size_t>(first)]}; }

  void clear() {
    for (Content& node : nodes_) clear_node(node);
  }
  void load(const grid::BlockGrid& grid, std::size_t slot, unsigned field) {
    for_each_owner(grid, slot, field, [&](const grid::Node* owner, int in_block, std::size_t here) {
      copy_node(owner[in_block], nodes_[here]);
    });
  }
  /// Adds the copy to the grid. Blocks of one colour do not overlap, so no two threads meet here.
  void add_to(grid::BlockGrid& grid, std::size_t slot, unsigned field) const {
    for_each_owner(grid, slot, field, [&](grid::Node* owner, int in_block, std::size_t here) {
      add_node(nodes_[here], owner[in_block]);
    });
  }

 private:
  static std::size_t index(int x, int y, int z) {
    return static_cast<std::size_t>((x * edge + y) * edge_z + z);
  }

  /// Calls f(nodes of the owning block, index in it, index here) for every node of the reach whose block is
  /// active; no particle reaches the others.
  template <class Grid, class Function>
  static void for_each_owner(Grid& grid, std::size_t slot, unsigned field, Function&& f) {
    static constexpr grid::ReachMap map = grid::reach_map();
    constexpr int skipped = 1 - before, skipped_z = 1 - before_z;  // the map begins one node before the block
    const auto& neighbours = grid.neighbours(slot);
    for (int x = 0; x < edge; ++x) {
      for (int y = 0; y < edge; ++y) {
        const auto ux = static_cast<std::size_t>(x + skipped);
        const auto uy = static_cast<std::size_t>(y + skipped);
        const int row = grid::node_index(map.node[ux], map.node[uy], 0);
        const auto part = [&](int z_block, auto from, auto to) {
          const std::int32_t owner = neighbours[static_cast<std::size_t>(
              grid::neighbour_index(map.block[ux], map.block[uy], z_block))];
          if (owner == grid::BlockGrid::no_slot) return;
          auto* nodes = grid.nodes(static_cast<std::size_t>(owner), field);
          for (int z = from; z < to; ++z) {
            f(nodes, row + map.node[static_cast<std::size_t>(z + skipped_z)], index(x, y, z));
          }
        };
        using Number = std::integral_constant<int, before_z>;
        using Behind = std::integral_constant<int, before_z + grid::block_edge>;
        using End = std::integral_constant<int, edge_z>;
        if constexpr (edge_z == 1) {
          part(1, Number{}, End{});
        } else {
          if constexpr (before_z > 0) part(0, std::integral_constant<int, 0>{}, Number{});
          part(1, Number{}, Behind{});
          part(2, Behind{}, End{});
        }
      }
    }
  }

  std::array<Content, size> nodes_;
};

/// The nodes of the grid themselves, each found through the neighbours of the block.
template <class Shape>
class DirectAccess {
 public:
  DirectAccess(grid::BlockGrid& grid, std::size_t slot, unsigned field)
      : grid_(grid), neighbours_(grid.neighbours(slot)), field_(field) {}

  class Stencil {
   public:
    grid::Node& operator()(std::size_t i, std::size_t j, std::size_t k) const {
      return *node_[(i * count + j) * along_z + k];
    }

   private:
    friend class DirectAccess;
    static constexpr std::size_t count = Shape::count, along_z = count_z<Shape>;
    std::array<grid::Node*, count * count * along_z> node_;
  };
  /// @param first  node, as of grid::PlaceInStencil
  Stencil stencil(std::int32_t first) {
    static constexpr grid::ReachMap map = grid::reach_map();
    constexpr int edge = Shape::stencil.edge(), edge_z = Shape::stencil.edge_z();
    constexpr int skipped = 1 - Shape::stencil.before(), skipped_z = 1 - Shape::stencil.before_z();
    const int x = first / (edge * edge_z) + skipped, y = first / edge_z % edge + skipped,
              z = first % edge_z + skipped_z;
    Stencil all;
    grid::Node** next = all.node_.data();
    for (int i = x; i < x + Shape::count; ++i) {
      for (int j = y; j < y + Shape::count; ++j) {
        const auto ux = static_cast<std::size_t>(i), uy = static_cast<std::size_t>(j);
        const int row = grid::node_index(map.node[ux], map.node[uy], 0);
        for (int k = z; k < z + static_cast<int>(count_z<Shape>); ++k) {
          const auto uz = static_cast<std::size_t>(k);
          const std::int32_t owner = neighbours_[static_cast<std::size_t>(
              grid::neighbour_index(map.block[ux], map.block[uy], map.block[uz]))];
          *next++ = grid_.nodes(static_cast<std::size_t>(owner), field_) + row + map.node[uz];
        }
      }
    }
    return all;
  }

 private:
  grid::BlockGrid& grid_;
  const std::array<std::int32_t, 27>& neighbours_;
  unsigned field_;
};

/// Calls f(points of one velocity field, access to its nodes) to read what the points of a block reach.
template <class Shape, class Content, class Function>
void read_nodes(grid::BlockGrid& grid, grid::BlockGrid::Points points, std::size_t slot, Function&& f) {
  grid.for_each_field(points, slot, [&](std::span<const std::uint32_t> members, unsigned field) {
    if (members.size() < direct_access_below<Shape>) {
      DirectAccess<Shape> access(grid, slot, field);
      f(members, access);
    } else {
      ReachCopy<Shape, Content> copy;
      copy.load(grid, slot, field);
      f(members, copy);
    }
  });
}
/// Calls `f` for the stencils of the points of a slot, to add to their nodes.
template <class Shape, class Content, class Function>
void add_to_nodes(grid::BlockGrid& grid, grid::BlockGrid::Points points, std::size_t slot, Function&& f) {
  grid.for_each_field(points, slot, [&](std::span<const std::uint32_t> members, unsigned field) {
    if (members.size() < direct_access_below<Shape>) {
      DirectAccess<Shape> access(grid, slot, field);
      f(members, access);
    } else {
      // Those of the block itself arrive while its points are worked on.
      const grid::Node* const own = grid.nodes(slot, field);
      for (int i = 0; i < grid::nodes_per_block; ++i) __builtin_prefetch(own + i, 1, 2);
      ReachCopy<Shape, Content> copy;
      copy.clear();
      f(members, copy);
      copy.add_to(grid, slot, field);
    }
  });
}

/// Points that take something at a time; if there are fewer, the last stands for the others.
using PointsOfGroup = std::array<std::uint32_t, together>;

/// These points with their places, or weights where the place alone is not enough, and nodes.
template <class ShapeOfGroup, class Access>
struct Group {
  using Shape = ShapeOfGroup;
  PointsOfGroup point;
  std::array<const grid::PlaceInStencil*, together> place;
  std::array<const Weights<Shape::count>*, together> weights;
  std::array<typename Access::Stencil, together> stencil;

  [[nodiscard]] WHIPPLE_INLINE Vector first(std::size_t i, std::size_t j, std::size_t k) const {
    return of_group([&](std::size_t m) -> Lanes { return first_register(stencil[m](i, j, k)); });
  }
  [[nodiscard]] WHIPPLE_INLINE Vector second(std::size_t i, std::size_t j, std::size_t k) const {
    return of_group([&](std::size_t m) -> Lanes { return stencil[m](i, j, k).second; });
  }
};

/// One direction of the stencils of a group: of values at its nodes the sum with N, and with it the sum with
/// slopes: the derivatives of N (`derivatives` of them make 1/m), or N r, whose sums over the nodes vanish.
template <class Shape>
class Direction {
 public:
  static constexpr std::size_t n = Shape::count;
  using Values = std::array<Vector, n>;
  Values distance;  ///< r, m

  template <class Group>
  WHIPPLE_INLINE Direction(const Group& group, std::size_t a, double) {
    const auto& w = group.weights;
    for (std::size_t k = 0; k < n; ++k) {
      weight_[k] = spread([&](std::size_t m) -> const Lanes& { return w[m]->weight[k]; }, a);
      derivative_[k] = spread([&](std::size_t m) -> const Lanes& { return w[m]->derivative[k]; }, a);
      distance[k] = spread([&](std::size_t m) -> const Lanes& { return w[m]->distance[k]; }, a);
      moment_[k] = weight_[k] * distance[k];
    }
  }
  WHIPPLE_INLINE Vector sum(const Values& f) const {
    Vector of_weight, of_slopes;
    both(weight_, f, of_weight, of_slopes);
    return of_weight;
  }
  WHIPPLE_INLINE void with_derivatives(const Values& f, Vector& of_weight, Vector& of_derivatives) const {
    both(derivative_, f, of_weight, of_derivatives);
  }
  WHIPPLE_INLINE void with_moments(const Values& f, Vector& of_weight, Vector& of_moments) const {
    both(moment_, f, of_weight, of_moments);
  }
  WHIPPLE_INLINE Vector derivatives(Vector sum) const { return sum; }

 private:
  /// Three nodes take differences from the middle one, which both sums share.
  WHIPPLE_INLINE void both(const Values& slopes, const Values& f, Vector& of_weight,
                           Vector& of_slopes) const {
    if constexpr (n == 3) {
      const Vector before = f[0] - f[1], behind = f[2] - f[1];
      of_weight = multiply_add(weight_[2], behind, multiply_add(weight_[0], before, f[1]));
      of_slopes = multiply_add(slopes[2], behind, slopes[0] * before);
    } else {
      of_weight = weight_[0] * f[0];
      of_slopes = slopes[0] * f[0];
      for (std::size_t k = 1; k < n; ++k) {
        of_weight = multiply_add(weight_[k], f[k], of_weight);
        of_slopes = multiply_add(slopes[k], f[k], of_slopes);
      }
    }
  }

  Values weight_, derivative_, moment_;  // N, dN/dx, N r
};

/// Quadratic B-splines: with a = x - 3/2, x in cells from the first node, N_0 = a^2/2, N_2 = (a + 1)^2/2 and
/// dx dN/dx = {a, -2 a - 1, a + 1}, so that the sum with the derivatives serves in the one with N.
template <>
class Direction<QuadraticBSpline> {
 public:
  static constexpr std::size_t n = 3;
  using Values = std::array<Vector, n>;
  Values distance;

  template <class Group>
  WHIPPLE_INLINE Direction(const Group& group, std::size_t a, double cell_size) {
    const Vector x = of_group([&](std::size_t m) { return broadcast(group.place[m]->from_first(a)); });
    a_ = x - 1.5;
    half_a_ = 0.5 * a_;
    half_c_ = half_a_ + 0.5;
    before_ = half_a_ * a_;
    behind_ = half_c_ * (a_ + 1.0);
    distance = {-cell_size * x, cell_size * (1.0 - x), cell_size * (2.0 - x)};
    moment_before_ = before_ * distance[0];
    moment_behind_ = behind_ * distance[2];
    per_cell_ = 1.0 / cell_size;
  }
  WHIPPLE_INLINE Vector sum(const Values& f) const {
    return multiply_add(behind_, f[2] - f[1], multiply_add(before_, f[0] - f[1], f[1]));
  }
  WHIPPLE_INLINE void with_derivatives(const Values& f, Vector& of_weight, Vector& of_derivatives) const {
    const Vector before = f[0] - f[1], behind = f[2] - f[1];
    of_derivatives = multiply_add(a_, before + behind, behind);
    of_weight = multiply_add(half_a_, of_derivatives, multiply_add(half_c_, behind, f[1]));
  }
  WHIPPLE_INLINE void with_moments(const Values& f, Vector& of_weight, Vector& of_moments) const {
    const Vector before = f[0] - f[1], behind = f[2] - f[1];
    of_weight = multiply_add(behind_, behind, multiply_add(before_, before, f[1]));
    of_moments = multiply_add(moment_behind_, behind, moment_before_ * before);
  }
  WHIPPLE_INLINE Vector derivatives(Vector sum) const { return per_cell_ * sum; }

 private:
  Vector a_, half_a_, half_c_;            // a, a/2, (a + 1)/2
  Vector before_, behind_;                // N_0, N_2
  Vector moment_before_, moment_behind_;  // N_0 r_0, N_2 r_2
  double per_cell_;
};

/// The one node along z of a stencil in a plane.
struct FlatDirection {
  static constexpr std::size_t n = 1;
  using Values = std::array<Vector, n>;
  Values distance{};

  template <class Group>
  WHIPPLE_INLINE FlatDirection(const Group&, std::size_t, double) {}
  WHIPPLE_INLINE static Vector sum(const Values& f) { return f[0]; }
  WHIPPLE_INLINE static void with_derivatives(const Values& f, Vector& of_weight, Vector& of_derivatives) {
    of_weight = f[0];
    of_derivatives = Vector{};
  }
  WHIPPLE_INLINE static void with_moments(const Values& f, Vector& of_weight, Vector& of_moments) {
    of_weight = f[0];
    of_moments = Vector{};
  }
};

/// The directions x and y, and z.
template <class Shape>
using Along = Direction<typename AlongAxis<Shape>::type>;
template <class Shape>
using AlongZ = std::conditional_t<Planar<Shape>, FlatDirection, Along<Shape>>;

enum class Slopes { derivatives, moments };

/// Sums of one vector per node, built up direction by direction: along the rows in z, over the rows of a
/// plane, over the planes.
template <class Direction, Slopes kind>
struct NodeSums {
  static constexpr std::size_t n = Direction::n;
  using Values = std::array<Vector, n>;
  struct Rows {
    Values value, slope;
  };
  Values value, slope_y, slope_z;

  template <class Any>
  WHIPPLE_INLINE static void add_up(const Any& along, const typename Any::Values& f, Vector& value,
                                    Vector& slope) {
    if constexpr (kind == Slopes::derivatives) {
      along.with_derivatives(f, value, slope);
    } else {
      along.with_moments(f, value, slope);
    }
  }
  template <class DirectionOfZ>
  WHIPPLE_INLINE static void set_row(Rows& rows, std::size_t row, const DirectionOfZ& z,
                                     const typename DirectionOfZ::Values& f) {
    add_up(z, f, rows.value[row], rows.slope[row]);
  }
  WHIPPLE_INLINE void set_plane(std::size_t plane, const Direction& y, const Rows& rows) {
    add_up(y, rows.value, value[plane], slope_y[plane]);
    slope_z[plane] = y.sum(rows.slope);
  }
  WHIPPLE_INLINE ValueAndGradient<Vector> total(const Direction& x) const {
    ValueAndGradient<Vector> total;
    add_up(x, value, total.value, total.gradient[0]);
    total.gradient[1] = x.sum(slope_y);
    total.gradient[2] = x.sum(slope_z);
    if constexpr (kind == Slopes::derivatives) {
      for (Vector& slope : total.gradient) slope = x.derivatives(slope);
    }
    return total;
  }
};

/// D = a_p(x_i) - v_i is the difference of the particle's affine field and the grid's velocity at node i.
template <bool affine, class Group>
WHIPPLE_INLINE inline Moments<Vector> moments(const Group& group, double cell_size, Vector v,
                                              const std::array<Vector, 3>& c) {
  using InPlaneOrSpace = Along<typename Group::Shape>;
  using AcrossPlane = AlongZ<typename Group::Shape>;
  constexpr std::size_t n = InPlaneOrSpace::n, n_z = AcrossPlane::n;
  const InPlaneOrSpace x(group, 0, cell_size), y(group, 1, cell_size);
  const AcrossPlane z(group, 2, cell_size);
  NodeSums<InPlaneOrSpace, Slopes::derivatives> velocity, increment;
  NodeSums<InPlaneOrSpace, Slopes::moments> change;
  std::array<Vector, n> loss;
  for (std::size_t i = 0; i < n; ++i) {
    Vector field_x = v;
    if constexpr (affine) field_x = multiply_add(x.distance[i], c[0], field_x);
    typename NodeSums<InPlaneOrSpace, Slopes::derivatives>::Rows row_velocity, row_increment;
    typename NodeSums<InPlaneOrSpace, Slopes::moments>::Rows row_change;
    std::array<Vector, n> row_loss;
#pragma GCC unroll 4
    for (std::size_t j = 0; j < n; ++j) {
      Vector field_y = field_x;
      if constexpr (affine) field_y = multiply_add(y.distance[j], c[1], field_y);
      std::array<Vector, n_z> velocities, d, changed, lost;
#pragma GCC unroll 4
      for (std::size_t k = 0; k < n_z; ++k) {
        const Vector first = group.first(i, j, k);
        Vector field = field_y;
        if constexpr (affine) field = multiply_add(z.distance[k], c[2], field);
        const Vector beta =
            relaxation(first, [&](std::size_t m) -> const grid::Node& { return group.stencil[m](i, j, k); });
        const Vector difference = field - first;
        d[k] = group.second(i, j, k);
        velocities[k] = first;
        const Vector relaxed = beta * difference, rest = difference - d[k];
        changed[k] = d[k] - relaxed;
        lost[k] = multiply_add(relaxed, rest + rest, d[k] * d[k]);
      }
      velocity.set_row(row_velocity, j, z, velocities);
      increment.set_row(row_increment, j, z, d);
      change.set_row(row_change, j, z, changed);
      row_loss[j] = z.sum(lost);
    }
    velocity.set_plane(i, y, row_velocity);
    increment.set_plane(i, y, row_increment);
    change.set_plane(i, y, row_change);
    loss[i] = y.sum(row_loss);
  }
  Moments<Vector> total = {velocity.total(x), increment.total(x), change.total(x), x.sum(loss)};
  total.velocity.value += total.increment.value;
  for (std::size_t a = 0; a < 3; ++a) total.velocity.gradient[a] += total.increment.gradient[a];
  return total;
}

/// Sums of one vector per node, value(i, j, k).
template <class Group, class Value>
WHIPPLE_INLINE inline ValueAndGradient<Vector> sums_of(const Group& group, double cell_size, Value&& value) {
  using InPlaneOrSpace = Along<typename Group::Shape>;
  using AcrossPlane = AlongZ<typename Group::Shape>;
  constexpr std::size_t n = InPlaneOrSpace::n, n_z = AcrossPlane::n;
  const InPlaneOrSpace x(group, 0, cell_size), y(group, 1, cell_size);
  const AcrossPlane z(group, 2, cell_size);
  NodeSums<InPlaneOrSpace, Slopes::derivatives> planes;
#pragma GCC unroll 4
  for (std::size_t i = 0; i < n; ++i) {
    typename NodeSums<InPlaneOrSpace, Slopes::derivatives>::Rows rows;
#pragma GCC unroll 4
    for (std::size_t j = 0; j < n; ++j) {
      std::array<Vector, n_z> nodes;
#pragma GCC unroll 4
      for (std::size_t k = 0; k < n_z; ++k) nodes[k] = value(i, j, k);
      planes.set_row(rows, j, z, nodes);
    }
    planes.set_plane(i, y, rows);
  }
  return planes.total(x);
}

/// Sum of lanes 0 to 2, in all lanes.
WHIPPLE_INLINE inline Vector sum_of_three(Vector v) { return lane(v, 0) + lane(v, 1) + lane(v, 2); }

/// a x b in lanes 0 to 2 of every point, 0 in lane 3.
WHIPPLE_INLINE inline Vector cross(Vector a, Vector b) { return turned(a * turned(b) - turned(a) * b); }

WHIPPLE_INLINE inline Vector squared_norm(const std::array<Vector, 3>& columns) {
  return sum_of_three(columns[0] * columns[0] + columns[1] * columns[1] + columns[2] * columns[2]);
}

/// C_p <- C_p (I + dt L)^-1, never growing (equation 4.8): v_p belongs to the new position, so C_p must be
/// carried there. @returns the loss of |C|^2
WHIPPLE_INLINE inline Vector advect_affine_field(std::array<Vector, 3>& c,
                                                 const std::array<Vector, 3>& gradient, double dt) {
  const Vector f0 = of_group([](std::size_t) { return Lanes{1.0, 0.0, 0.0, 0.0}; }) + dt * gradient[0];
  const Vector f1 = of_group([](std::size_t) { return Lanes{0.0, 1.0, 0.0, 0.0}; }) + dt * gradient[1];
  const Vector f2 = of_group([](std::size_t) { return Lanes{0.0, 0.0, 1.0, 0.0}; }) + dt * gradient[2];
  const std::array<Vector, 3> rows = {cross(f1, f2), cross(f2, f0), cross(f0, f1)};  // of the adjugate
  const Vector determinant = sum_of_three(f0 * rows[0]);
  // A deformation that large in a step has no meaningful inverse.
  const auto too_large = determinant <= 0.1;
  const Vector before = squared_norm(c), inverse = 1.0 / determinant;
  std::array<Vector, 3> carried;  // times the determinant
  for (std::size_t a = 0; a < 3; ++a) {
    carried[a] = lane(rows[0], a) * c[0] + lane(rows[1], a) * c[1] + lane(rows[2], a) * c[2];
  }
  const Vector after = squared_norm(carried);
  const Vector cap = root(before / after);  // 0/0 is not less than the inverse
  const Vector scale = cap < inverse ? cap : inverse;
  for (std::size_t a = 0; a < 3; ++a) c[a] = too_large ? c[a] : scale * carried[a];
  return too_large ? Vector{} : before - scale * scale * after;
}

/// Gathers from the nodes: `of` sums over the nodes of a group, of which it reads `Content`; `advance`, if
/// present, computes the new values of the points from the sums.
///
/// Velocity and affine field (4.3), transfer dissipation (4.5).
template <AffineField field>
struct TransferSums {
  using Content = grid::Node;
  using Sum = Moments<Vector>;
  using Result = Advance<Vector>;
  static constexpr bool affine = field != AffineField::none;
  double dt;

  template <class Points>
  WHIPPLE_INLINE static Vector velocity(const Points& points, const PointsOfGroup& p) {
    return of_group([&](std::size_t m) { return load_vector(points.velocity[p[m]].data()); });
  }
  template <class Points>
  WHIPPLE_INLINE static std::array<Vector, 3> affine_field(const Points& points, const PointsOfGroup& p) {
    std::array<Vector, 3> c{};
    if constexpr (affine) {
      // Lane 3 is that of the next column, or 0.
      c[0] = of_group([&](std::size_t m) { return load(points.affine_velocity[p[m]].data()); });
      c[1] = of_group([&](std::size_t m) { return load(points.affine_velocity[p[m]].data() + 3); });
      c[2] = of_group([&](std::size_t m) { return load_vector(points.affine_velocity[p[m]].data() + 6); });
    }
    return c;
  }

  template <class Points, class Group>
  WHIPPLE_INLINE Moments<Vector> of(const Points& points, const Group& group, double cell_size) const {
    return moments<affine>(group, cell_size, velocity(points, group.point),
                           affine_field(points, group.point));
  }
  template <class Shape, class Points>
  WHIPPLE_INLINE Advance<Vector> advance(const Points& points, const PointsOfGroup& p,
                                         const Moments<Vector>& sums, double cell_size) const {
    const Vector change = sums.change.value;
    std::array<Vector, 3> c = affine_field(points, p);
    Vector heat = 0.5 * (sums.loss - change * change);
    if constexpr (affine) {
      const double inertia = Shape::second_moment * cell_size * cell_size;  // sum N r r^T in one direction
      Vector per_inertia = of_group([&](std::size_t) { return broadcast(1.0 / inertia); });
      if constexpr (requires { points.unrelaxed; }) {  // some carry no affine field: theirs stays 0
        per_inertia *=
            of_group([&](std::size_t m) { return broadcast(p[m] < points.unrelaxed ? 0.0 : 1.0); });
      }
      for (std::size_t a = 0; a < 3; ++a) {
        const Vector change_of_field = per_inertia * sums.change.gradient[a];
        heat -= 0.5 * change_of_field * sums.change.gradient[a];
        c[a] += change_of_field;
      }
      heat = sum_of_three(heat);
      if constexpr (field == AffineField::deformed) {
        heat += 0.5 * inertia * advect_affine_field(c, sums.velocity.gradient, dt);
      }
    } else {
      heat = sum_of_three(heat);
    }
    return {sums.velocity, sums.increment, velocity(points, p) + change, c, heat};
  }
};
/// Value and gradient between the eight nodes of a cell, direction by direction.
/// @tparam Value  Lanes or Both
/// @param node    node(i, j, k)
template <class Value, class GetNode>
WHIPPLE_INLINE inline ValueAndGradient<Value> between_nodes(const std::array<Value, 3>& from_first,
                                                            const Value& per_cell, const GetNode& node) {
  struct Edge {
    Value value, along;
  };
  const auto between = [](const Value& f, const Value& before, const Value& behind) WHIPPLE_INLINE {
    const Value along = behind - before;
    return Edge{multiply_add(f, along, before), along};
  };
  struct Face {
    Edge y;
    Value z;
  };
  std::array<Face, 2> faces;
#pragma GCC unroll 2
  for (std::size_t i = 0; i < 2; ++i) {
    const Edge low = between(from_first[2], node(i, 0, 0), node(i, 0, 1)),
               high = between(from_first[2], node(i, 1, 0), node(i, 1, 1));
    faces[i] = {between(from_first[1], low.value, high.value),
                between(from_first[1], low.along, high.along).value};
  }
  const Edge x = between(from_first[0], faces[0].y.value, faces[1].y.value);
  return {x.value,
          {per_cell * x.along, per_cell * between(from_first[0], faces[0].y.along, faces[1].y.along).value,
           per_cell * between(from_first[0], faces[0].z, faces[1].z).value}};
}

/// New velocity of the grid, and what of it the step brought.
struct UpdateSums {
  using Content = grid::Node;
  template <class Stencil>
  WHIPPLE_INLINE static VelocityUpdate<> between(const grid::PlaceInStencil& place, double per_cell,
                                                 const Stencil& nodes) {
    const auto node = [&](auto... at) WHIPPLE_INLINE { return load_node(nodes(at...)); };
    const ValueAndGradient<Both> sums =
        between_nodes<Both>({spread_both(place.from_first(0)), spread_both(place.from_first(1)),
                             spread_both(place.from_first(2))},
                            spread_both(per_cell), node);
    VelocityUpdate<> update;
    update.increment = second_of(sums.value);
    update.after.value = first_of(sums.value) + update.increment;
    for (std::size_t a = 0; a < 3; ++a) {
      update.after.gradient[a] = first_of(sums.gradient[a]) + second_of(sums.gradient[a]);
    }
    return update;
  }
  template <class Points, class Group>
  WHIPPLE_INLINE VelocityUpdate<Vector> of(const Points&, const Group& group, double cell_size) const {
    const auto after = [&](auto... node) { return group.first(node...) + group.second(node...); };
    return {sums_of(group, cell_size, after),
            sums_of(group, cell_size, [&](auto... node) { return group.second(node...); }).value};
  }
};
/// Sums of the first registers.
struct FirstSums {
  using Content = Lanes;
  template <class Stencil>
  WHIPPLE_INLINE static ValueAndGradient<> between(const grid::PlaceInStencil& place, double per_cell,
                                                   const Stencil& nodes) {
    const auto node = [&](auto... at) WHIPPLE_INLINE { return Lanes(first_register(nodes(at...))); };
    return between_nodes<Lanes>(
        {broadcast(place.from_first(0)), broadcast(place.from_first(1)), broadcast(place.from_first(2))},
        broadcast(per_cell), node);
  }
  template <class Points, class Group>
  WHIPPLE_INLINE ValueAndGradient<Vector> of(const Points&, const Group& group, double cell_size) const {
    return sums_of(group, cell_size, [&](auto... node) { return group.first(node...); });
  }
};

WHIPPLE_INLINE inline ValueAndGradient<> part(const ValueAndGradient<Vector>& sums, std::size_t i) {
  return {part(sums.value, i),
          {part(sums.gradient[0], i), part(sums.gradient[1], i), part(sums.gradient[2], i)}};
}
WHIPPLE_INLINE inline Advance<> part(const Advance<Vector>& sums, std::size_t i) {
  return {part(sums.grid_velocity, i),
          part(sums.increment, i),
          part(sums.velocity, i),
          {part(sums.affine[0], i), part(sums.affine[1], i), part(sums.affine[2], i)},
          part(sums.heat, i)};
}
WHIPPLE_INLINE inline VelocityUpdate<> part(const VelocityUpdate<Vector>& sums, std::size_t i) {
  return {part(sums.after, i), part(sums.increment, i)};
}

constexpr std::size_t ahead = 8;

/// Calls f(points of a block, their weights) for a few points at a time: weights are a long chain of
/// dependent instructions, and too far from those of the next point for the processor to see.
/// @tparam with_weights  else they are left open
template <class Shape, bool with_weights = true, class Points, class Function>
WHIPPLE_INLINE inline void for_some(const Points& points, std::span<const grid::PlaceInStencil> places,
                                    double cell_size, std::span<const std::uint32_t> members, Function&& f) {
  std::array<Weights<Shape::count>, ahead> weights;
  for (std::size_t first = 0; first < members.size(); first += ahead) {
    const std::span<const std::uint32_t> some =
        members.subspan(first, std::min(ahead, members.size() - first));
    for (std::size_t m = 0; with_weights && m < some.size(); ++m) {
      weights[m] = weights_at<Shape>(points, some[m], places[some[m]], cell_size);
    }
    f(some, weights);
  }
}

/// Distributes contributions weighted with N, and contributions weighted with slopes, whose sum over the
/// nodes vanishes, to the nodes of one direction: of three nodes the middle one, with the largest N, receives
/// the remainder.
template <std::size_t n>
WHIPPLE_INLINE inline std::array<Both, n> shares(const std::array<Both, n>& weight,
                                                 const std::array<Both, n>& slope, const Both& whole,
                                                 const Both& of_slope) {
  std::array<Both, n> share;
  for (std::size_t k = 0; k < n; ++k) {
    if (n == 3 && k == 1) continue;
    share[k] = multiply_add(slope[k], of_slope, weight[k] * whole);
  }
  if constexpr (n == 3) share[1] = whole - (share[0] + share[2]);
  return share;
}
template <std::size_t n>
WHIPPLE_INLINE inline std::array<Both, n> shares(const std::array<Both, n>& weight, const Both& whole) {
  std::array<Both, n> share;
  for (std::size_t k = 0; k < n; ++k) {
    if (n == 3 && k == 1) continue;
    share[k] = weight[k] * whole;
  }
  if constexpr (n == 3) share[1] = whole - multiply_add(weight[2], whole, share[0]);
  return share;
}

/// Adds what a point brings to its nodes (equation 4.1 and the forces): node += N P_0 + sum over directions
/// of S_a P_a, with S_a = N r_a in the first register and dN/dx_a in the second.
template <class Shape, class Stencil>
WHIPPLE_INLINE inline void add_payload(const Payload& load, const Weights<Shape::count>& w,
                                       const Stencil& nodes) {
  constexpr std::size_t n = Shape::count;
  constexpr bool affine = CarriesAffineField<Shape>;  // else the first register takes no slopes
  struct Factors {
    std::array<Both, n> weight, slope;
  };
  const auto direction = [&](std::size_t a) WHIPPLE_INLINE {
    Factors along;
    for (std::size_t k = 0; k < n; ++k) {
      const double weight = w.weight[k][a];
      along.weight[k] = spread_both(weight);
      along.slope[k] = spread_both(affine ? weight * w.distance[k][a] : 0.0, w.derivative[k][a]);
    }
    return along;
  };
  const Factors x = direction(0), y = direction(1), z = direction(2);
  const auto planes = shares(x.weight, x.slope, both(load.a0, load.b0), both(load.ax, load.bx)),
             planes_y = shares(x.weight, both(load.ay, load.by)),
             planes_z = shares(x.weight, both(load.az, load.bz));
  for (std::size_t i = 0; i < n; ++i) {
    const auto rows = shares(y.weight, y.slope, planes[i], planes_y[i]),
               rows_z = shares(y.weight, planes_z[i]);
#pragma GCC unroll 4
    for (std::size_t j = 0; j < n; ++j) {
      if constexpr (Planar<Shape>) {
        grid::Node& node = nodes(i, j, 0);
        store_node(node, load_node(node) + rows[j]);
      } else {
        const auto share = shares(z.weight, z.slope, rows[j], rows_z[j]);
#pragma GCC unroll 4
        for (std::size_t k = 0; k < n; ++k) {
          grid::Node& node = nodes(i, j, k);
          store_node(node, load_node(node) + share[k]);
        }
      }
    }
  }
}
/// Adds mass and momentum only.
template <class Shape, class Stencil>
WHIPPLE_INLINE inline void add_payload(Lanes load, const Weights<Shape::count>& w, const Stencil& nodes) {
  constexpr std::size_t n = Shape::count;
  const std::array<Lanes, n> weight = of_direction(w.weight, 2);
#pragma GCC unroll 4
  for (std::size_t i = 0; i < n; ++i) {
    const Lanes a_x = broadcast(w.weight[i][0]) * load;
#pragma GCC unroll 4
    for (std::size_t j = 0; j < n; ++j) {
      const Lanes a = broadcast(w.weight[j][1]) * a_x;
#pragma GCC unroll 4
      for (std::size_t k = 0; k < count_z<Shape>; ++k) first_register(nodes(i, j, k)) += weight[k] * a;
    }
  }
}

/// Scatters the points of one cell to its eight nodes with linear functions, as long as they are contiguous:
/// the nodes themselves are accessed once for all of them.
/// @tparam Content  of the nodes: grid::Node takes everything, Lanes mass and momentum
template <class Content>
class NodesOfCell {
 public:
  WHIPPLE_INLINE void add(const Payload& load, const grid::PlaceInStencil& place, double per_cell) {
    const Weight x = weight(place, 0), y = weight(place, 1), z = weight(place, 2);
    const Lanes none{};
    const Both whole = both(load.a0, load.b0), of_x = both(none, per_cell * load.bx),
               of_y = both(none, per_cell * load.by);
    const Lanes of_z = per_cell * load.bz;
#pragma GCC unroll 2
    for (std::size_t i = 0; i < 2; ++i) {
      const Both across = spread_both(x[i]), from_x = across * whole,
                 plane = i == 0 ? from_x - of_x : from_x + of_x, plane_y = across * of_y;
      const Lanes plane_z = x[i] * of_z;
#pragma GCC unroll 2
      for (std::size_t j = 0; j < 2; ++j) {
        const Both from_y = spread_both(y[j]) * plane, row = j == 0 ? from_y - plane_y : from_y + plane_y;
        slope_[i][j] += y[j] * plane_z;
#pragma GCC unroll 2
        for (std::size_t k = 0; k < 2; ++k)
          sum_[i][j][k] = multiply_add(spread_both(z[k]), row, sum_[i][j][k]);
      }
    }
  }
  WHIPPLE_INLINE void add(const Lanes& load, const grid::PlaceInStencil& place, double) {
    const Weight x = weight(place, 0), y = weight(place, 1), z = weight(place, 2);
#pragma GCC unroll 2
    for (std::size_t i = 0; i < 2; ++i) {
      const Lanes plane = x[i] * load;
#pragma GCC unroll 2
      for (std::size_t j = 0; j < 2; ++j) {
        const Lanes row = y[j] * plane;
#pragma GCC unroll 2
        for (std::size_t k = 0; k < 2; ++k) sum_[i][j][k] += z[k] * row;
      }
    }
  }
  template <class Stencil>
  WHIPPLE_INLINE void hand_over(const Stencil& nodes) {
#pragma GCC unroll 2
    for (std::size_t i = 0; i < 2; ++i) {
#pragma GCC unroll 2
      for (std::size_t j = 0; j < 2; ++j) {
        if constexpr (takes_all) {
          const Both slope = both(Lanes{}, slope_[i][j]);
          grid::Node &before = nodes(i, j, 0), &behind = nodes(i, j, 1);
          store_node(before, load_node(before) + (sum_[i][j][0] - slope));
          store_node(behind, load_node(behind) + (sum_[i][j][1] + slope));
        } else {
#pragma GCC unroll 2
          for (std::size_t k = 0; k < 2; ++k) first_register(nodes(i, j, k)) += sum_[i][j][k];
        }
      }
    }
    *this = {};
  }

 private:
  static constexpr bool takes_all = std::is_same_v<Content, grid::Node>;
  using Sum = std::conditional_t<takes_all, Both, Lanes>;
  template <class T>
  using Pair = std::array<T, 2>;
  using Weight = Pair<double>;
  WHIPPLE_INLINE static Weight weight(const grid::PlaceInStencil& place, std::size_t direction) {
    const double f = place.from_first(direction);
    return {1.0 - f, f};
  }

  Pair<Pair<Pair<Sum>>> sum_{};
  Pair<Pair<Lanes>> slope_{};  // of the functions along z: what the second register of the node behind gets
                               // of it, the one before loses
};

/// The entries. Everything they call is inlined into them.
struct Kernels {
  template <AffineField field>
  using Transfer = TransferSums<field>;
  using Update = UpdateSums;
  using First = FirstSums;

  /// Calls take(place, point, what it gets) for the points of a slot; `place` counts along its list.
  /// @param sums  Transfer, Update or First
  template <class Shape, class Sums, class Points, class Take>
  WHIPPLE_WHOLE_KERNEL static void gather(const Points& points, grid::BlockGrid& grid,
                                          grid::BlockGrid::Points kind, std::size_t slot, const Sums& sums,
                                          const Take& take) {
    const double cell_size = grid.geometry().cell_size;
    const std::span<const grid::PlaceInStencil> places = grid.places(kind);
    const std::uint32_t* const list = grid.members(kind, slot).data();
    read_nodes<Shape, typename Sums::Content>(grid, kind, slot, [&](const auto& members, auto& access) {
      if constexpr (std::is_same_v<Shape, Linear> && !requires { typename Sums::Sum; }) {
        const double per_cell = 1.0 / cell_size;
        std::int32_t first_node = places[members.front()].first_node();
        auto stencil = access.stencil(first_node);
        for (const std::uint32_t& p : members) {
          if (const std::int32_t first = places[p].first_node(); first != first_node) {
            first_node = first;
            stencil = access.stencil(first);
          }
          take(static_cast<std::size_t>(&p - list), p, Sums::between(places[p], per_cell, stencil));
        }
        return;
      }
      constexpr bool with_weights = !std::is_same_v<typename AlongAxis<Shape>::type, QuadraticBSpline>;
      const auto gather_some = [&](const auto& some, const auto& weights) WHIPPLE_INLINE {
        using Group = Group<Shape, std::remove_reference_t<decltype(access)>>;
        const std::size_t groups = (some.size() + together - 1) / together;
        const auto group_at = [&](std::size_t g) WHIPPLE_INLINE {
          Group group;
          for (std::size_t i = 0; i < together; ++i) {
            const std::size_t at = std::min(g * together + i, some.size() - 1);
            group.point[i] = some[at];
            group.place[i] = &places[some[at]];
            group.weights[i] = &weights[at];
            group.stencil[i] = access.stencil(group.place[i]->first_node());
          }
          return group;
        };
        const auto give = [&](std::size_t g, const auto& result) WHIPPLE_INLINE {
          for (std::size_t i = 0, m = g * together; i < together && m < some.size(); ++i, ++m) {
            take(static_cast<std::size_t>(&some[m] - list), some[m], part(result, i));
          }
        };
        if constexpr (requires { typename Sums::Sum; }) {
          // Stage by stage: what becomes of the sums is another long chain.
          std::array<PointsOfGroup, ahead / together> point;
          std::array<typename Sums::Sum, ahead / together> sum;
          std::array<typename Sums::Result, ahead / together> result;
          for (std::size_t g = 0; g < groups; ++g) {
            const Group group = group_at(g);
            point[g] = group.point;
            sum[g] = sums.of(points, group, cell_size);
          }
          for (std::size_t g = 0; g < groups; ++g) {
            result[g] = sums.template advance<Shape>(points, point[g], sum[g], cell_size);
          }
          for (std::size_t g = 0; g < groups; ++g) give(g, result[g]);
        } else {
          for (std::size_t g = 0; g < groups; ++g) give(g, sums.of(points, group_at(g), cell_size));
        }
      };
      for_some<Shape, with_weights>(points, places, cell_size, members, gather_some);
    });
  }

  /// Adds what the points of a slot bring to the nodes.
  template <class Shape, class What>
  WHIPPLE_WHOLE_KERNEL static void scatter(const What& what, grid::BlockGrid& grid, std::size_t slot) {
    const double cell_size = grid.geometry().cell_size;
    const std::span<const grid::PlaceInStencil> places = grid.places(What::kind);
    const auto load = [&](std::size_t p) WHIPPLE_INLINE {
      if (prefetches(p)) {
        what.prefetch_from(p + prefetch_distance);
        prefetch(p + prefetch_distance, places);
      }
      return what.template load<CarriesAffineField<Shape>>(p);
    };
    add_to_nodes<Shape, typename What::Content>(
        grid, What::kind, slot, [&](const auto& members, auto& access) {
          if constexpr (std::is_same_v<Shape, Linear>) {
            const double per_cell = 1.0 / cell_size;
            NodesOfCell<typename What::Content> cell;
            std::int32_t first_node = places[members.front()].first_node();
            for (const std::uint32_t p : members) {
              if (const std::int32_t first = places[p].first_node(); first != first_node) {
                cell.hand_over(access.stencil(first_node));
                first_node = first;
              }
              cell.add(load(p), places[p], per_cell);
            }
            cell.hand_over(access.stencil(first_node));
          } else {
            for_some<Shape>(
                what.points, places, cell_size, members, [&](const auto& some, const auto& weights) {
                  for (std::size_t m = 0; m < some.size(); ++m) {
                    add_payload<Shape>(load(some[m]), weights[m], access.stencil(weights[m].first_node));
                  }
                });
          }
        });
  }
};
