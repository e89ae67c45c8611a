#include "content/tables/ray_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "content/tables/number_table.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! A number whose column has one of two names.
struct EitherColumn {
  std::size_t column;
  std::string_view name;
  bool second;  //!< true if it has the second name
};

struct Columns {
  std::optional<std::size_t> id;
  EitherColumn spin;
  std::size_t r;
  EitherColumn theta;
  std::size_t observer;
  std::optional<std::size_t> beta[3];
  std::optional<std::size_t> direction[3];
};

//! Finds the column that has one of two names. Throws Error if the table has neither or both.
EitherColumn either(const NumberTable& table, const std::string& file, std::string_view first,
                    std::string_view second) {
  const auto one = table.find(first);
  const auto other = table.find(second);
  if (one && other) {
    throw Error(file + ":1", fmt::format("has both columns {} and {}", first, second), "remove one of them");
  }
  if (!one && !other) {
    throw Error(file + ":1", fmt::format("has no column {} (nor {})", first, second),
                "name the columns in the first line");
  }
  return one ? EitherColumn{*one, first, false} : EitherColumn{*other, second, true};
}

//! Reads the polar angle, from 0 to pi [rad].
double theta_of(const TableLine& line, const EitherColumn& theta) {
  const double angle = line.number(theta.column, theta.name);
  const double maximum = theta.second ? 180.0 : 3.1415926535897936;
  if (!(angle >= 0.0 && angle <= maximum)) {
    throw Error(
        line.location(), fmt::format("{} is {}, out of range", theta.name, angle),
        theta.second ? "choose an angle from 0 to 180" : "choose an angle from 0 to pi, or name the column theta_deg");
  }
  return theta.second ? angle * one_degree : angle;
}

ObserverMotion motion_of(const TableLine& line, std::string_view word) {
  constexpr std::pair<std::string_view, ObserverMotion> motions[] = {{"zamo", ObserverMotion::zamo},
                                                                     {"static", ObserverMotion::fixed},
                                                                     {"geodesic", ObserverMotion::geodesic},
                                                                     {"retrograde", ObserverMotion::retrograde},
                                                                     {"rain", ObserverMotion::rain},
                                                                     {"boost", ObserverMotion::velocity},
                                                                     {"rain_boost", ObserverMotion::rain_boost}};
  for (const auto& [name, motion] : motions) {
    if (name == word) {
      return motion;
    }
  }
  throw Error(line.location(), fmt::format("observer is \"{}\", which does not exist", word.substr(0, 40)),
              "choose one of zamo, static, geodesic, retrograde, rain, boost, rain_boost");
}

Vector3<double> vector_of(const TableLine& line, const std::optional<std::size_t> (&columns)[3],
                          const std::string& name) {
  constexpr const char* axes[3] = {"_r", "_theta", "_phi"};
  Vector3<double> v{0.0, 0.0, 0.0};
  double* const parts[3] = {&v.x, &v.y, &v.z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (columns[i]) {
      *parts[i] = line.number(*columns[i], name + axes[i]);
    }
  }
  return v;
}

void check(const RayCamera& camera, const TableLine& line, std::string_view spin_name) {
  if (!(std::abs(camera.spacetime.spin) <= 1.0)) {
    throw Error(line.location(), fmt::format("{} is {}, outside -1 to 1", spin_name, camera.spacetime.spin),
                "choose a spin in that range");
  }
  const double horizon = horizon_radius(camera.spacetime);
  const bool falls = camera.motion == ObserverMotion::rain || camera.motion == ObserverMotion::rain_boost;
  const double minimum = falls ? std::min(min_interior_radius(camera.spacetime), horizon) : horizon;
  if (!(camera.r > minimum && camera.r <= 1e12)) {
    throw Error(
        line.location(), fmt::format("r is {}, out of range for this observer", camera.r),
        falls || !(camera.r > min_interior_radius(camera.spacetime))
            ? fmt::format("choose a radius above {:.6g} and up to 1e12", minimum)
            : fmt::format(
                  "choose a radius above the horizon at {:.6g} and up to 1e12, or the observer rain or rain_boost",
                  horizon));
  }
  const Vector3<double> v =
      camera.motion == ObserverMotion::rain_boost
          ? camera.velocity
          : observer_velocity(camera.motion, camera.spacetime, camera.r, camera.theta, camera.velocity);
  if (camera.motion != ObserverMotion::rain && !(dot(v, v) < 1.0)) {
    throw Error(line.location(), "this observer would have to move faster than light at this radius",
                "choose another observer or a larger radius");
  }
}

//! Throws Error unless the table has the three columns of a velocity: a component with a misspelled
//! name would count as 0.
void need_velocity(const TableLine& line, const Columns& columns) {
  constexpr std::string_view names[3] = {"beta_r", "beta_theta", "beta_phi"};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!columns.beta[i]) {
      throw Error(line.location(),
                  fmt::format("observer is {}, but the table has no column {}", line.cell(columns.observer), names[i]),
                  "name beta_r, beta_theta and beta_phi in the first line");
    }
  }
}

//! Throws Error if a row gives a velocity that differs from that of its named observer. Empty cells
//! and zeros are ignored.
void check_velocity(const RayCamera& camera, const TableLine& line, const Columns& columns) {
  constexpr double same = 1e-6;
  if (camera.motion == ObserverMotion::velocity || camera.motion == ObserverMotion::rain_boost) {
    return;
  }
  const Vector3<double> v = observer_velocity(camera.motion, camera.spacetime, camera.r, camera.theta, camera.velocity);
  const double own[3] = {v.x, v.y, v.z};
  for (std::size_t i = 0; i < 3; ++i) {
    const bool given = columns.beta[i] && !line.cell(*columns.beta[i]).empty();
    const double beta = given ? line.number(*columns.beta[i], "beta") : 0.0;
    if (beta != 0.0 && !(std::abs(beta - own[i]) < same)) {
      throw Error(line.location(),
                  fmt::format("has a velocity that differs from that of the observer {} ({:.6g}, {:.6g}, {:.6g})",
                              line.cell(columns.observer), own[0], own[1], own[2]),
                  "write the observer \"boost\", or leave the beta_* cells empty");
    }
  }
}

//! Reads and checks a row's camera.
RayCamera ray_camera_of(const TableLine& line, const Columns& columns) {
  RayCamera camera;
  camera.spacetime = Spacetime{line.number(columns.spin.column, columns.spin.name)};
  camera.r = line.number(columns.r, "r");
  camera.theta = theta_of(line, columns.theta);
  camera.motion = motion_of(line, line.cell(columns.observer));
  if (camera.motion == ObserverMotion::velocity || camera.motion == ObserverMotion::rain_boost) {
    need_velocity(line, columns);
    camera.velocity = vector_of(line, columns.beta, "beta");
  }
  check(camera, line, columns.spin.name);
  check_velocity(camera, line, columns);
  return camera;
}

Vector3<double> ray_direction_of(const TableLine& line, const Columns& columns) {
  const Vector3<double> n = vector_of(line, columns.direction, "n");
  const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
  if (!(largest > 0.0)) {
    throw Error(line.location(), "n_r, n_theta and n_phi are all 0, so the direction is undefined",
                "write a vector of any length that points to where the light seems to come from");
  }
  const Vector3<double> scaled = (1.0 / largest) * n;
  return (1.0 / std::sqrt(dot(scaled, scaled))) * scaled;
}

//! The cells of the last line that define its camera. Most successive rays share their camera,
//! which is then read and checked once.
class CameraCells {
 public:
  explicit CameraCells(const Columns& columns)
      : columns_{columns.spin.column, columns.r, columns.theta.column, columns.observer} {
    for (const auto& column : columns.beta) {
      if (column) {
        columns_.push_back(*column);
      }
    }
    texts_.resize(columns_.size());
  }

  //! Returns true if these cells of a line are the same as in the line before.
  bool are_repeated(const TableLine& line) {
    bool repeated = !first_;
    first_ = false;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (const std::string_view cell = line.cell(columns_[i]); texts_[i] != cell) {
        texts_[i] = cell;
        repeated = false;
      }
    }
    return repeated;
  }

 private:
  std::vector<std::size_t> columns_;
  std::vector<std::string> texts_;
  bool first_ = true;
};

}  // namespace

std::string RayTable::id_of(const RayRow& row) const {
  if (id_ends.empty()) {
    return std::to_string(row.number);
  }
  const std::size_t begin = row.number == 0 ? 0 : id_ends[row.number - 1];
  return {ids.data() + begin, id_ends[row.number] - begin};
}

RayTable read_ray_table(std::istream& stream, const std::string& file, bool need_directions,
                        std::size_t expected_rows) {
  NumberTable table(stream, file);
  Columns columns{table.find("id"),
                  either(table, file, "a", "spin"),
                  table.need("r"),
                  either(table, file, "theta", "theta_deg"),
                  table.need("observer"),
                  {table.find("beta_r"), table.find("beta_theta"), table.find("beta_phi")},
                  {table.find("n_r"), table.find("n_theta"), table.find("n_phi")}};
  if (need_directions) {
    for (const std::string_view name : {"n_r", "n_theta", "n_phi"}) {
      static_cast<void>(table.need(name));
    }
  }
  RayTable rays;
  rays.rows.reserve(expected_rows);
  CameraCells camera_cells(columns);
  for (TableLine line; table.next(line);) {
    if (!camera_cells.are_repeated(line)) {
      rays.cameras.push_back(ray_camera_of(line, columns));
    }
    const auto number = static_cast<std::uint32_t>(rays.rows.size());
    RayRow row{{}, static_cast<std::uint32_t>(rays.cameras.size() - 1), number};
    if (columns.id) {
      rays.ids += line.cell(*columns.id);
      rays.id_ends.push_back(rays.ids.size());
    }
    if (columns.direction[0] && columns.direction[1] && columns.direction[2]) {
      row.direction = ray_direction_of(line, columns);
    }
    rays.rows.push_back(row);
  }
  return rays;
}

RayTable read_ray_table(const std::filesystem::path& path) {
  // Rows that are reserved but not used cost only address space. A table with shorter lines is copied while it grows.
  constexpr std::uintmax_t short_line_bytes = 24;
  constexpr std::uintmax_t most_reserved = 4'000'000;
  std::ifstream stream = open_table(path, "a table of rays");
  std::error_code problem;
  const std::uintmax_t bytes = std::filesystem::file_size(path, problem);
  return read_ray_table(stream, path.string(), true,
                        problem ? 0 : static_cast<std::size_t>(std::min(bytes / short_line_bytes, most_reserved)));
}

}  // namespace ergodome
