#include "tests/kernels/reference_tables.h"

#include <cmath>

#include "tests/support/csv_table.h"

namespace ergodome::test {

namespace {

using Row = CsvRow;

std::vector<Row> read_table(const std::string& name) {
  return read_csv(std::string(ERGODOME_TEST_DATA_DIR) + "/" + name);
}

double number(const Row& row, const std::string& key, double otherwise = 0.0) {
  const std::string& text = row.at(key);
  return text.empty() ? otherwise : std::stod(text);
}

Vector3<double> vector(const Row& row, const std::string& x, const std::string& y, const std::string& z) {
  return {number(row, x), number(row, y), number(row, z)};
}

ObserverMotion motion_of(const std::string& name) {
  static const std::map<std::string, ObserverMotion> motions = {{"zamo", ObserverMotion::zamo},
                                                                {"static", ObserverMotion::fixed},
                                                                {"geodesic", ObserverMotion::geodesic},
                                                                {"retrograde", ObserverMotion::retrograde},
                                                                {"rain", ObserverMotion::rain},
                                                                {"boost", ObserverMotion::velocity},
                                                                {"rain_boost", ObserverMotion::rain_boost}};
  return motions.at(name);
}

template <class Item>
void fill_camera(Item& item, const Row& row) {
  item.a = number(row, "a");
  item.r = number(row, "r");
  item.theta = number(row, "theta");
  item.motion = motion_of(row.at("observer"));
  item.beta = vector(row, "beta_r", "beta_theta", "beta_phi");
  const Vector3<double> n = vector(row, "n_r", "n_theta", "n_phi");
  item.n = (1.0 / length(n)) * n;
}

//! Reads the columns that all tables of rays contain.
ReferenceRay ray_of(const Row& row) {
  ReferenceRay ray{};
  fill_camera(ray, row);
  ray.id = static_cast<int>(number(row, "id"));
  ray.status = row.at("status") == "escaped" ? LightEnd::sky : LightEnd::horizon;
  ray.sky = vector(row, "sky_x", "sky_y", "sky_z");
  ray.g = number(row, "g");
  return ray;
}

std::vector<ReferenceCrossing> crossings_of(const std::string& name) {
  std::vector<ReferenceCrossing> result;
  for (const Row& row : read_table(name)) {
    ReferenceCrossing crossing{};
    fill_camera(crossing, row);
    crossing.id = static_cast<int>(number(row, "id"));
    crossing.order = static_cast<int>(number(row, "order"));
    crossing.r_hit = number(row, "r_hit");
    crossing.phi_hit = number(row, "phi_hit");
    crossing.delay = number(row, "delay");
    crossing.g_kepler = number(row, "g_kepler");
    result.push_back(crossing);
  }
  return result;
}

}  // namespace

double length(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

double allowed_sky_error(const ReferenceRay& ray) { return 1e-10 + 1e-13 / std::abs(ray.edge_distance); }

const std::vector<ReferenceRay>& reference_rays() {
  static const std::vector<ReferenceRay> rays = [] {
    std::vector<ReferenceRay> result;
    for (const Row& row : read_table("rays.csv")) {
      ReferenceRay ray = ray_of(row);
      ray.kind = row.at("kind");
      ray.mino_time = number(row, "mino_time");
      ray.edge_distance = number(row, "edge_distance", -1.0);
      ray.magnification = number(row, "magnification");
      result.push_back(ray);
    }
    return result;
  }();
  return rays;
}

const std::vector<ReferenceRay>& reference_rays_within() {
  static const std::vector<ReferenceRay> rays = [] {
    std::vector<ReferenceRay> result;
    for (const Row& row : read_table("within_horizon.csv")) {
      result.push_back(ray_of(row));
    }
    return result;
  }();
  return rays;
}

const std::vector<ReferenceEdgePoint>& reference_edge() {
  static const std::vector<ReferenceEdgePoint> points = [] {
    std::vector<ReferenceEdgePoint> result;
    for (const Row& row : read_table("edge.csv")) {
      ReferenceEdgePoint point{};
      fill_camera(point, row);
      point.camera = static_cast<int>(number(row, "camera"));
      result.push_back(point);
    }
    return result;
  }();
  return points;
}

const std::vector<ReferenceCrossing>& reference_crossings() {
  static const std::vector<ReferenceCrossing> crossings = crossings_of("disk.csv");
  return crossings;
}

const std::vector<ReferenceCrossing>& reference_crossings_within() {
  static const std::vector<ReferenceCrossing> crossings = crossings_of("within_horizon_disk.csv");
  return crossings;
}

}  // namespace ergodome::test
