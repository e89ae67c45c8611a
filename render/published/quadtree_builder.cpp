#include "render/published/quadtree_builder.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/launch/launch.h"
#include "kernels/spacetime/shadow/critical_curve.h"

namespace ergodome {

namespace {

constexpr int quadtree_step_limit = 100'000;

//! Returns the squared length of a cell's diagonal in (θ, φ). It is practically infinite if one end
//! of the diagonal is in the shadow.
double squared_diagonal(const SkyAngles& a, const SkyAngles& b) {
  if (in_shadow(a) || in_shadow(b)) {
    return 1e9;
  }
  const double theta = static_cast<double>(a.theta) - static_cast<double>(b.theta);
  const double phi = static_cast<double>(a.phi) - static_cast<double>(b.phi);
  return theta * theta + phi * phi;
}

}  // namespace

//! Builds a QuadtreeLens level by level, so that the rays of a level are traced as one batch.
class QuadtreeBuilder {
 public:
  QuadtreeBuilder(QuadtreeLens& lens, const CameraStation& camera, const QuadtreeSettings& settings)
      : lens_(lens), camera_(camera), settings_(settings) {}

  void build() {
    const int rows = 1 << settings_.finest_level;
    std::vector<QuadtreeCell> cells = {{0, 0, rows}, {0, rows, rows}};
    for (int level = 0; level <= settings_.finest_level && !cells.empty(); ++level) {
      trace_corners(cells);
      std::vector<QuadtreeCell> next;
      for (const QuadtreeCell& cell : cells) {
        if (level < settings_.finest_level && is_to_split(cell, level)) {
          split(cell, next);
        } else {
          leaves_.push_back(cell);
        }
      }
      trace_wanted();
      cells = std::move(next);
    }
    if (settings_.repair) {
      repair();
    }
  }

 private:
  [[nodiscard]] bool is_stored(const QuadtreeCell& cell) const {
    return !lens_.mirrored_ || cell.row < (1 << settings_.finest_level) / 2;
  }

  [[nodiscard]] bool is_to_split(const QuadtreeCell& cell, int level) const {
    const detail::QuadtreeCorners c = detail::corners_of(lens_.view(), cell);
    const bool dark =
        in_shadow(c.upper_left) && in_shadow(c.upper_right) && in_shadow(c.lower_left) && in_shadow(c.lower_right);
    if (level < settings_.coarsest_level) {
      // Cells of the first three levels are split even if all corners are dark, because a large
      // cell may contain sky all the same.
      return !dark || level < 3;
    }
    return !dark && std::max(squared_diagonal(c.upper_left, c.lower_right),
                             squared_diagonal(c.upper_right, c.lower_left)) > settings_.largest_diagonal_squared;
  }

  void want(int row, int column) {
    const int rows = 1 << settings_.finest_level;
    column %= 2 * rows;
    if (lens_.mirrored_ && row > rows / 2) {
      row = rows - row;
    }
    SkyAngles sky{};
    if (!find_vertex(lens_.view(), row, column, sky)) {
      lens_.insert(row, column, shadow_angles());
      wanted_.push_back({row, column, {}});
    }
  }

  void trace_corners(const std::vector<QuadtreeCell>& cells) {
    for (const QuadtreeCell& cell : cells) {
      for (const int down : {0, cell.width}) {
        for (const int across : {0, cell.width}) {
          want(cell.row + down, cell.column + across);
        }
      }
    }
    trace_wanted();
  }

  //! Adds the four children of a cell to `next`, or in a mirrored grid those in the upper half, and
  //! requests a ray at the middle of the cell, the corner that all children share.
  void split(const QuadtreeCell& cell, std::vector<QuadtreeCell>& next) {
    const int half = cell.width / 2;
    for (const int down : {0, half}) {
      for (const int across : {0, half}) {
        const QuadtreeCell child = {cell.row + down, cell.column + across, half};
        if (is_stored(child)) {
          next.push_back(child);
        }
      }
    }
    want(cell.row + half, cell.column + half);
  }

  void trace_wanted() {
    const std::size_t count = wanted_.size();
    std::vector<double> n[3];
    std::vector<double> sky[3];
    std::vector<double> status(count);
    for (int k = 0; k < 3; ++k) {
      n[k].resize(count);
      sky[k].resize(count);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3<double> v = quadtree_direction(settings_.finest_level, wanted_[i].row, wanted_[i].column);
      n[0][i] = v.x;
      n[1][i] = v.y;
      n[2][i] = v.z;
    }
    RayBatch<double> batch{};
    batch.camera = camera_;
    batch.settings = {settings_.tolerance, quadtree_step_limit};
    batch.method = settings_.method;
    batch.count = static_cast<int>(count);
    for (int k = 0; k < 3; ++k) {
      batch.direction[k] = n[k].data();
      batch.sky[k] = sky[k].data();
    }
    batch.status = status.data();
    launch(Backend::cpu, batch);
    for (std::size_t i = 0; i < count; ++i) {
      if (status[i] == 0.0) {
        const double azimuth = std::atan2(sky[1][i], sky[0][i]);
        set(wanted_[i].row, wanted_[i].column,
            {static_cast<float>(std::atan2(std::hypot(sky[0][i], sky[1][i]), sky[2][i])),
             static_cast<float>(azimuth < 0.0 ? azimuth + 2.0 * pi : azimuth)});
      }
    }
    wanted_.clear();
  }

  void set(int row, int column, const SkyAngles& sky) {
    std::uint32_t slot = quadtree_hash(row, column) & lens_.view().mask;
    while (lens_.slots_[slot].row != row || lens_.slots_[slot].column != column) {
      slot = (slot + 1) & lens_.view().mask;
    }
    lens_.slots_[slot].sky = sky;
  }

  //! Sets vertices inside the side of a larger cell to the values interpolated along that side (VE,
  //! end of section 4.3.2), starting with the largest cells.
  void repair() {
    const QuadtreeGrid grid = lens_.view();
    for (const QuadtreeCell& cell : leaves_) {
      for (const bool along_row : {true, false}) {
        for (const int far_side : {0, cell.width}) {
          repair_side(grid, cell, along_row, far_side);
        }
      }
    }
  }

  void repair_side(const QuadtreeGrid& grid, const QuadtreeCell& cell, bool along_row, int far_side) {
    const detail::SplineEnd end{grid};
    const auto position = [&](int along) {
      return along_row ? QuadtreeCell{cell.row + far_side, cell.column + along, 0}
                       : QuadtreeCell{cell.row + along, cell.column + far_side, 0};
    };
    const auto sky_at = [&](int along) { return end(position(along).row, position(along).column); };
    std::vector<std::pair<QuadtreeCell, SkyAngles>> mended;
    for (int along = 1; along < cell.width; ++along) {
      QuadtreeCell at = position(along);
      SkyAngles sky{};
      at.column %= 2 << settings_.finest_level;
      if (!is_stored({at.row - 1, 0, 0}) || !find_vertex(grid, at.row, at.column, sky) || in_shadow(sky)) {
        continue;
      }
      const SkyAngles value = detail::spline(sky_at(-cell.width), sky_at(0), sky_at(cell.width), sky_at(2 * cell.width),
                                             static_cast<float>(along) / static_cast<float>(cell.width));
      if (!in_shadow(value)) {
        mended.emplace_back(at, value);
      }
    }
    for (const auto& [at, value] : mended) {
      set(at.row, at.column, value);
    }
  }

  QuadtreeLens& lens_;
  const CameraStation& camera_;
  const QuadtreeSettings& settings_;
  std::vector<QuadtreeCell> leaves_;
  std::vector<QuadtreeCell> wanted_;
};

bool quadtree_is_mirrored(double theta, const Vector3<double>& velocity) {
  return std::abs(theta - 0.5 * pi) < 1e-9 && velocity.y == 0.0;
}

QuadtreeLens::QuadtreeLens(const CameraStation& camera, bool mirrored, const QuadtreeSettings& settings)
    : slots_(1U << 16U, QuadtreeVertex{-1, 0, {}}), level_(settings.finest_level), mirrored_(mirrored) {
  QuadtreeBuilder(*this, camera, settings).build();
}

QuadtreeGrid QuadtreeLens::view() const {
  return {slots_.data(), static_cast<std::uint32_t>(slots_.size() - 1), level_, mirrored_ ? 1 : 0};
}

void QuadtreeLens::insert(int row, int column, const SkyAngles& sky) {
  if (2 * static_cast<std::size_t>(++vertex_count_) > slots_.size()) {
    grow();
  }
  std::uint32_t slot = quadtree_hash(row, column) & view().mask;
  while (slots_[slot].row >= 0) {
    slot = (slot + 1) & view().mask;
  }
  slots_[slot] = {row, column, sky};
}

void QuadtreeLens::grow() {
  std::vector<QuadtreeVertex> old(2 * slots_.size(), QuadtreeVertex{-1, 0, {}});
  old.swap(slots_);
  for (const QuadtreeVertex& vertex : old) {
    if (vertex.row >= 0) {
      std::uint32_t slot = quadtree_hash(vertex.row, vertex.column) & view().mask;
      while (slots_[slot].row >= 0) {
        slot = (slot + 1) & view().mask;
      }
      slots_[slot] = vertex;
    }
  }
}

namespace {

constexpr int table_size = 1024;

struct EdgePoint {
  double row;
  double column;
};

//! Returns points on the shadow's edge in rows and columns of the grid, without a jump where the
//! columns wrap around.
std::vector<EdgePoint> edge_points_of(const CameraStation& camera, int level) {
  const ShadowChart chart = make_shadow_chart(camera);
  const double columns = 2 << level;
  std::vector<EdgePoint> points;
  for (int i = 0; i < table_size; ++i) {
    const double gamma = full_turn * i / table_size;
    const double alpha = edge_polar_angle(camera, chart, gamma);
    float row = 0.0F;
    float column = 0.0F;
    quadtree_position(level, chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma), row, column);
    EdgePoint point = {static_cast<double>(row), static_cast<double>(column)};
    if (!points.empty()) {
      point.column = points.back().column + std::remainder(point.column - points.back().column, columns);
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace

QuadtreeShadowTable::QuadtreeShadowTable(const CameraStation& camera, int level) : radius_(table_size, 0.0F) {
  const std::vector<EdgePoint> points = edge_points_of(camera, level);
  double row = 0.0;
  double column = 0.0;
  for (const EdgePoint& point : points) {
    row += point.row / table_size;
    column += point.column / table_size;
  }
  row_ = static_cast<float>(row);
  column_ = static_cast<float>(column);
  // Each direction from the center meets the edge once; between neighboring points the distance is
  // interpolated linearly in the angle.
  for (int i = 0; i < table_size; ++i) {
    const EdgePoint& a = points[static_cast<std::size_t>(i)];
    const EdgePoint& b = points[static_cast<std::size_t>((i + 1) % table_size)];
    const double from = std::atan2(a.row - row, a.column - column);
    const double turn = std::remainder(std::atan2(b.row - row, b.column - column) - from, full_turn);
    const double begin = std::hypot(a.row - row, a.column - column);
    const double end = std::hypot(b.row - row, b.column - column);
    const double low = std::min(from, from + turn) / full_turn * table_size;
    const double high = std::max(from, from + turn) / full_turn * table_size;
    for (int at = static_cast<int>(std::ceil(low)); at <= high; ++at) {
      const double t = std::abs(turn) > 0.0 ? (at * full_turn / table_size - from) / turn : 0.0;
      radius_[static_cast<std::size_t>((at % table_size + table_size) % table_size)] =
          static_cast<float>(begin + t * (end - begin));
    }
  }
}

QuadtreeShadow QuadtreeShadowTable::view() const { return {row_, column_, radius_.data(), table_size}; }

QuadtreeLookUp look_up_of(const QuadtreeGrid& grid, QuadtreeInterpolation how) { return {{grid, grid}, {}, 0.0F, how}; }

}  // namespace ergodome
