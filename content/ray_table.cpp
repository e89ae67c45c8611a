#include "content/ray_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::size_t longest_line = 65'536;
constexpr std::size_t most_rows = 50'000'000;

//! The next line, without its end. Of a line that is too long only the beginning comes: one character more than may be.
bool read_line(std::istream& stream, std::string& line) {
  line.resize(longest_line + 2);
  stream.getline(line.data(), static_cast<std::streamsize>(line.size()));
  const auto taken = static_cast<std::size_t>(stream.gcount());
  const bool cut = stream.fail() && taken == longest_line + 1;
  if (stream.fail() && !cut) {
    return false;
  }
  if (cut) {
    stream.clear();
  }
  line.resize(cut || stream.eof() ? taken : taken - 1);
  return true;
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    std::string_view cell = line.substr(0, comma);
    while (!cell.empty() && (cell.front() == ' ' || cell.front() == '"')) {
      cell.remove_prefix(1);
    }
    while (!cell.empty() && (cell.back() == ' ' || cell.back() == '"' || cell.back() == '\r')) {
      cell.remove_suffix(1);
    }
    cells.push_back(cell);
    if (comma == std::string_view::npos) {
      return cells;
    }
    line.remove_prefix(comma + 1);
  }
}

//! Column numbers by name.
class Header {
 public:
  Header(std::string_view line, std::string file) : file_(std::move(file)), names_(split(line).size()) {
    std::size_t i = 0;
    for (const std::string_view name : split(line)) {
      names_[i++] = name;
    }
  }

  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (names_[i] == name) {
        return i;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::size_t need(std::string_view name) const {
    const auto column = find(name);
    if (!column) {
      throw Error(file_ + ":1", fmt::format("has no column {}", name), "name the columns in the first line");
    }
    return *column;
  }

 private:
  std::string file_;
  std::vector<std::string> names_;
};

struct Columns {
  std::optional<std::size_t> id;
  std::size_t spin, r, theta, observer;
  std::optional<std::size_t> beta[3];
  std::optional<std::size_t> direction[3];
};

//! One line while it is taken apart.
struct Line {
  std::vector<std::string_view> cells;
  std::string place;

  [[nodiscard]] std::string_view cell(std::size_t column) const {
    return column < cells.size() ? cells[column] : std::string_view{};
  }

  [[nodiscard]] double number(std::size_t column, std::string_view name) const {
    std::string_view text = cell(column);
    if (!text.empty() && text.front() == '+') {
      text.remove_prefix(1);  // from_chars takes no plus sign
    }
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    // Numbers below the smallest double are zero for our purpose.
    const bool tiny = problem == std::errc::result_out_of_range && text.find("e-") != std::string_view::npos;
    if (tiny) {
      return 0.0;
    }
    if (problem != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
      throw Error(place, fmt::format("{} is \"{}\", not a number", name, text.substr(0, 40)), "write a finite number");
    }
    return value;
  }
};

ObserverMotion motion_of(const Line& line, std::string_view word) {
  constexpr std::pair<std::string_view, ObserverMotion> motions[] = {
      {"zamo", ObserverMotion::zamo},         {"static", ObserverMotion::fixed},
      {"geodesic", ObserverMotion::geodesic}, {"retrograde", ObserverMotion::retrograde},
      {"rain", ObserverMotion::rain},         {"boost", ObserverMotion::velocity}};
  for (const auto& [name, motion] : motions) {
    if (name == word) {
      return motion;
    }
  }
  throw Error(line.place, fmt::format("observer is \"{}\"", word.substr(0, 40)),
              "choose one of zamo, static, geodesic, retrograde, rain, boost");
}

Vector3<double> vector_of(const Line& line, const std::optional<std::size_t> (&columns)[3], std::string_view name) {
  Vector3<double> v{0.0, 0.0, 0.0};
  double* const parts[3] = {&v.x, &v.y, &v.z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (columns[i]) {
      *parts[i] = line.number(*columns[i], name);
    }
  }
  return v;
}

void check(const RayRow& row, const Line& line) {
  if (!(std::abs(row.spin) <= 1.0)) {
    throw Error(line.place, fmt::format("a is {}", row.spin), "choose a spin from -1 to 1");
  }
  if (!(row.r > horizon_radius(row.spin) && row.r <= 1e12)) {
    throw Error(line.place, fmt::format("r is {}", row.r),
                fmt::format("choose a radius above the horizon at {:.6g}, up to 1e12", horizon_radius(row.spin)));
  }
  if (!(row.theta >= 0.0 && row.theta <= 3.1415926535897936)) {
    throw Error(line.place, fmt::format("theta is {}", row.theta), "choose an angle from 0 to pi");
  }
  const Vector3<double> v = observer_velocity(row.motion, row.spin, row.r, row.theta, row.velocity);
  if (row.motion != ObserverMotion::rain && !(dot(v, v) < 1.0)) {
    throw Error(line.place, "its observer would outrun light there", "choose another observer or a larger radius");
  }
}

}  // namespace

std::vector<RayRow> read_ray_table(std::istream& stream, const std::string& file, bool need_directions) {
  std::string text;
  if (!read_line(stream, text) || text.size() > longest_line) {
    throw Error(file, "has no header line", "name the columns in the first line");
  }
  if (text.starts_with("\xEF\xBB\xBF")) {
    text.erase(0, 3);  // spreadsheets mark UTF-8 so
  }
  const Header header(text, file);
  Columns columns{header.find("id"),
                  header.need("a"),
                  header.need("r"),
                  header.need("theta"),
                  header.need("observer"),
                  {header.find("beta_r"), header.find("beta_theta"), header.find("beta_phi")},
                  {header.find("n_r"), header.find("n_theta"), header.find("n_phi")}};
  if (need_directions) {
    for (const std::string_view name : {"n_r", "n_theta", "n_phi"}) {
      static_cast<void>(header.need(name));
    }
  }
  std::vector<RayRow> rows;
  for (std::size_t number = 2; read_line(stream, text); ++number) {
    const std::string place = fmt::format("{}:{}", file, number);
    if (text.empty() || text == "\r") {
      continue;
    }
    if (text.size() > longest_line || rows.size() >= most_rows) {
      throw Error(place, "is too much for one table", "split the file; lines up to 64 KiB, 50 million rows");
    }
    const Line line{split(text), place};
    RayRow row;
    row.id = columns.id ? std::string(line.cell(*columns.id)) : std::to_string(rows.size());
    row.spin = line.number(columns.spin, "a");
    row.r = line.number(columns.r, "r");
    row.theta = line.number(columns.theta, "theta");
    row.motion = motion_of(line, line.cell(columns.observer));
    if (row.motion == ObserverMotion::velocity) {
      row.velocity = vector_of(line, columns.beta, "beta");
    }
    check(row, line);
    if (columns.direction[0] && columns.direction[1] && columns.direction[2]) {
      const Vector3<double> n = vector_of(line, columns.direction, "n");
      const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
      if (!(largest > 0.0)) {
        throw Error(place, "the direction n has no length", "write a direction that is not zero");
      }
      const Vector3<double> scaled = (1.0 / largest) * n;
      row.direction = (1.0 / std::sqrt(dot(scaled, scaled))) * scaled;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<RayRow> read_ray_table(const std::filesystem::path& path) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) {
    throw Error(path.string(), "is not a file that can be read", "give the path of a table of rays (.csv)");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw Error(path.string(), "cannot be read", "check its permissions");
  }
  return read_ray_table(stream, path.string());
}

}  // namespace ergodome
