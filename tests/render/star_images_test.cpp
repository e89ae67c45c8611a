#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "content/sky_map.h"
#include "kernels/geodesic/closed_form.h"
#include "kernels/geodesic/integration.h"
#include "kernels/launch/launch.h"
#include "kernels/shadow/critical_curve.h"
#include "render/lens/grid_builder.h"
#include "render/stars/star_pass.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

constexpr double pi = 3.14159265358979323846;
//! A pixel of a 4096² dome.
constexpr double fine_pixel = pi / 4096;

struct Place {
  double spin, r, theta, phi;
  ObserverMotion motion;
};

//! The cameras of the tests: a fast hole from its equator, near a photon orbit, and from high above in a falling frame.
const Place places[] = {{0.999, 5.0, pi / 2, 0.7, ObserverMotion::geodesic},
                        {0.5, 3.2, 1.2, -2.0, ObserverMotion::zamo},
                        {0.9, 12.0, 0.4, 4.0, ObserverMotion::rain}};

EyeCamera eye_at(const Place& place) {
  EyeCamera eye{place.spin, place.r, place.theta, place.phi, place.motion, {}, {}, place.r, place.theta};
  const double at_hole[3][3] = {{0, 0, 1}, {0, -1, 0}, {1, 0, 0}};
  std::copy(&at_hole[0][0], &at_hole[0][0] + 9, &eye.frame_from_view[0][0]);
  return eye;
}

CameraStation camera_of(const EyeCamera& eye) {
  return make_camera_station(eye.spin, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
}

const BlackbodyColours& colours() {
  static const BlackbodyColours table(Backend::cpu);
  return table;
}

StarCatalogue brightest(std::size_t count) {
  Show show;
  show.sky.stars = "all_stars";
  StarCatalogue catalogue = load_stars(show);
  catalogue.stars.resize(count);
  return catalogue;
}

StarSettings settings_for(double faintest_mag) {
  StarSettings settings;
  settings.pixel = fine_pixel;
  settings.redshift = false;
  settings.faintest = static_cast<float>(illuminance_of_magnitude_0 * std::pow(10.0, -0.4 * faintest_mag));
  return settings;
}

std::vector<StarImage> images_of(const StarField& field, const EyeCamera& eye, const StarSettings& settings) {
  GridSettings grid;
  grid.pixel = settings.pixel;
  grid.budget_px = 1.0;
  grid.least_area_px = 4.0;
  grid.fine = false;
  grid.observer = aberration_to_rain(eye.spin, eye.r, eye.theta, eye.motion, eye.velocity);
  const LensStation station = build_lens_station(eye.spin, eye.r, eye.theta, grid);
  return find_star_images(field, colours().view(), eye, station,
                          star_patches(field, colours().view(), eye, station, settings), settings);
}

Vector3<double> widened(const Vector3<float>& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

Vector3<double> unit_of(const Vector3<double>& v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

//! The sky that the closed form sees in a direction.
Vector3<double> exact_sky(const CameraStation& camera, const Vector3<double>& n) {
  return turned_to_camera(camera, trace_closed_form(camera.spin, start_ray(camera, unit_of(n))).sky);
}

//! How far an image lies from where the closed form has it, and its exact magnification.
struct ImageError {
  double miss;  //!< [rad]
  double magnification;
};

ImageError error_of(const CameraStation& camera, const Vector3<double>& n, const Vector3<double>& star) {
  const Vector3<double> e1 =
      unit_of(cross(std::abs(n.z) < 0.9 ? Vector3<double>{0, 0, 1} : Vector3<double>{1, 0, 0}, n));
  const Vector3<double> e2 = cross(n, e1);
  const double h = 1e-6;
  const auto derivative = [&](const Vector3<double>& e) {
    return (0.5 / h) * (exact_sky(camera, n + h * e) - exact_sky(camera, n - h * e));
  };
  const Vector3<double> j1 = derivative(e1);
  const Vector3<double> j2 = derivative(e2);
  const Vector3<double> missing = star - exact_sky(camera, n);
  const double a = dot(j1, j1);
  const double b = dot(j1, j2);
  const double c = dot(j2, j2);
  const double determinant = a * c - b * b;
  const double x = (c * dot(j1, missing) - b * dot(j2, missing)) / determinant;
  const double y = (a * dot(j2, missing) - b * dot(j1, missing)) / determinant;
  return {std::hypot(x, y), 1.0 / std::sqrt(determinant)};
}

class StarImages : public testing::TestWithParam<Place> {};

TEST_P(StarImages, AreWhereTheClosedFormHasThem) {
  const EyeCamera eye = eye_at(GetParam());
  const CameraStation camera = camera_of(eye);
  const StarField field(brightest(test::sanitized ? 100 : 1000), glm::dmat3(1.0), colours().view());
  const auto images = images_of(field, eye, settings_for(8.0));
  double worst_px = 0.0;
  double worst_magnification = 0.0;
  for (const StarImage& image : images) {
    const ImageError error = error_of(camera, unit_of(widened(image.direction)),
                                      field.stars()[static_cast<std::size_t>(image.star)].direction);
    worst_px = std::max(worst_px, error.miss / fine_pixel);
    // What the precision of a direction in float leaves of a steep map.
    const double allowance = 1.0 + std::sqrt(error.magnification);
    worst_magnification =
        std::max(worst_magnification, std::abs(std::abs(image.magnification) / error.magnification - 1.0) / allowance);
  }
  EXPECT_GE(images.size(), 1.2 * static_cast<double>(field.stars().size()));
  EXPECT_LT(worst_px, 0.02);
  EXPECT_LT(worst_magnification, 5e-3);
}

//! An image as the reference search knows it.
struct FoundImage {
  double magnification;
  double from_edge;  //!< angle from the shadow's edge [rad]
};

//! The chart about a camera's shadow, in the observer's own frame.
class ShadowDistance {
 public:
  explicit ShadowDistance(const CameraStation& camera) : camera_(camera), chart_(make_shadow_chart(camera)) {}

  [[nodiscard]] const ShadowChart& chart() const { return chart_; }
  [[nodiscard]] double edge(double gamma) const { return edge_polar_angle(camera_, chart_, gamma); }

  //! Angle of a direction from the shadow's edge.
  [[nodiscard]] double of(const Vector3<double>& n) const {
    const double first = dot(n, chart_.first);
    const double second = dot(n, chart_.second);
    return std::atan2(std::hypot(first, second), dot(n, chart_.centre)) - edge(std::atan2(second, first));
  }

 private:
  CameraStation camera_;
  ShadowChart chart_;
};

//! Directions all over a camera's sky, from a distance of the shadow's edge on, with the sky that rays see there: a mesh of triangles.
class RayMesh {
 public:
  RayMesh(const EyeCamera& eye, double least_distance, int columns, int rows) : columns_(columns), rows_(rows) {
    const CameraStation camera = camera_of(eye);
    const ShadowDistance shadow(camera);
    const ShadowChart& chart = shadow.chart();
    std::vector<double> values[6];
    for (int column = 0; column < columns; ++column) {
      const double gamma = 2.0 * pi * column / columns;
      const double edge = shadow.edge(gamma);
      for (int row = 0; row <= rows; ++row) {
        const double from_edge =
            (pi - edge) * std::pow(least_distance / (pi - edge), 1.0 - static_cast<double>(row) / rows);
        const double alpha = edge + from_edge;
        const Vector3<double> n = std::cos(alpha) * chart.centre + (std::sin(alpha) * std::cos(gamma)) * chart.first +
                                  (std::sin(alpha) * std::sin(gamma)) * chart.second;
        const double parts[3] = {n.x, n.y, n.z};
        for (int i = 0; i < 3; ++i) {
          values[i].push_back(parts[i]);
        }
        from_edge_.push_back(from_edge);
      }
    }
    trace(camera, values);
  }

  //! The images of a star: the triangles that hold it.
  [[nodiscard]] std::vector<FoundImage> images(const Vector3<double>& star) const {
    std::vector<FoundImage> found;
    for (int column = 0; column < columns_; ++column) {
      for (int row = 0; row < rows_; ++row) {
        const std::size_t a = index(column, row);
        const std::size_t b = index(column + 1, row);
        const std::size_t c = index(column, row + 1);
        const std::size_t d = index(column + 1, row + 1);
        add(a, b, c, star, found);
        add(d, c, b, star, found);
      }
    }
    return found;
  }

 private:
  void trace(const CameraStation& camera, std::vector<double> (&values)[6]) {
    for (int i = 3; i < 6; ++i) {
      values[i].resize(values[0].size());
    }
    RayBatch<double> batch{};
    batch.camera = camera;
    batch.settings = {1e-9, 400, true};
    batch.method = TraceMethod::taylor;
    batch.count = static_cast<int>(values[0].size());
    for (int i = 0; i < 3; ++i) {
      batch.direction[i] = values[i].data();
      batch.sky[i] = values[3 + i].data();
    }
    trace_rays(Backend::cpu, batch);
    for (std::size_t i = 0; i < values[0].size(); ++i) {
      camera_.push_back({values[0][i], values[1][i], values[2][i]});
      sky_.push_back({values[3][i], values[4][i], values[5][i]});
    }
  }

  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(column % columns_) * static_cast<std::size_t>(rows_ + 1) +
           static_cast<std::size_t>(row);
  }

  void add(std::size_t a, std::size_t b, std::size_t c, const Vector3<double>& star,
           std::vector<FoundImage>& found) const {
    if (dot(sky_[a], star) < 0.0) {
      return;
    }
    const double first = dot(star, cross(sky_[a], sky_[b]));
    const double second = dot(star, cross(sky_[b], sky_[c]));
    const double third = dot(star, cross(sky_[c], sky_[a]));
    const bool inside = (first > 0.0 && second > 0.0 && third > 0.0) || (first < 0.0 && second < 0.0 && third < 0.0);
    if (inside) {
      const auto area = [](const Vector3<double>& p, const Vector3<double>& q, const Vector3<double>& r) {
        const Vector3<double> normal = cross(q - p, r - p);
        return std::sqrt(dot(normal, normal));
      };
      found.push_back({area(camera_[a], camera_[b], camera_[c]) / area(sky_[a], sky_[b], sky_[c]), from_edge_[a]});
    }
  }

  int columns_;
  int rows_;
  std::vector<double> from_edge_;
  std::vector<Vector3<double>> camera_;
  std::vector<Vector3<double>> sky_;
};

TEST_P(StarImages, AreAllThatASearchWithRaysFinds) {
  if (test::sanitized) {
    GTEST_SKIP() << "many rays";
  }
  const EyeCamera eye = eye_at(GetParam());
  const StarField field(brightest(300), glm::dmat3(1.0), colours().view());
  const double faintest = static_cast<double>(settings_for(8.0).faintest);
  // The grid ends half a pixel from the edge.
  const double distance = 0.75 * fine_pixel;
  const ShadowDistance shadow(camera_of(eye));
  std::map<int, std::size_t> by_star;
  for (const StarImage& image : images_of(field, eye, settings_for(8.0))) {
    by_star[image.star] += shadow.of(unit_of(widened(image.direction))) > distance ? 1U : 0U;
  }
  const RayMesh mesh(eye, 0.7 * distance, 1200, 900);
  std::size_t compared = 0;
  std::size_t different = 0;
  for (std::size_t i = 0; i < field.stars().size(); ++i) {
    // A triangle knows place and magnification roughly: what lies near a limit may be on either side of it.
    const double limit = faintest / static_cast<double>(field.stars()[i].illuminance);
    std::size_t least = 0;
    std::size_t most = 0;
    for (const FoundImage& image : mesh.images(field.stars()[i].direction)) {
      least += image.magnification > 1.15 * limit && image.from_edge > 1.1 * distance ? 1U : 0U;
      most += image.magnification > limit / 1.15 && image.from_edge > 0.9 * distance ? 1U : 0U;
    }
    const std::size_t found = by_star[static_cast<int>(i)];
    different += found < least || found > most ? 1U : 0U;
    compared += most;
  }
  // Next to a caustic the mesh's flat triangles count wrongly.
  EXPECT_LE(different, 2U);
  EXPECT_GT(compared, 400U);
}

TEST_P(StarImages, DoNotDependOnTheGrid) {
  // The same images from a grid four times as fine: none hangs on how cells happen to lie.
  const EyeCamera eye = eye_at(GetParam());
  const StarField field(brightest(test::sanitized ? 100 : 2000), glm::dmat3(1.0), colours().view());
  StarSettings settings = settings_for(9.0);
  const auto coarse = images_of(field, eye, settings);
  GridSettings grid;
  grid.pixel = settings.pixel;
  grid.budget_px = 0.25;
  grid.observer = aberration_to_rain(eye.spin, eye.r, eye.theta, eye.motion, eye.velocity);
  const LensStation station = build_lens_station(eye.spin, eye.r, eye.theta, grid);
  const auto fine = find_star_images(field, colours().view(), eye, station,
                                     star_patches(field, colours().view(), eye, station, settings), settings);
  EXPECT_NEAR(static_cast<double>(coarse.size()), static_cast<double>(fine.size()), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Cameras, StarImages, testing::ValuesIn(places));

TEST(StarImage, OfAFarCameraIsTheStarItself) {
  const EyeCamera eye = eye_at({0.9, 1e5, 1.0, 0.3, ObserverMotion::fixed});
  const StarField field(brightest(1000), glm::dmat3(1.0), colours().view());
  StarSettings settings = settings_for(12.0);
  settings.redshift = true;
  const auto images = images_of(field, eye, settings);
  std::vector<int> seen(field.stars().size());
  for (const StarImage& image : images) {
    const FieldStar& star = field.stars()[static_cast<std::size_t>(image.star)];
    if (std::abs(image.magnification) < 0.5F) {
      continue;
    }
    ++seen[static_cast<std::size_t>(image.star)];
    const float luminance =
        0.2126729F * image.illuminance.x + 0.7151522F * image.illuminance.y + 0.0721750F * image.illuminance.z;
    EXPECT_NEAR(-2.5 * std::log10(luminance / star.illuminance), 0.0, 2e-3) << star.number;
  }
  EXPECT_EQ(std::ranges::count(seen, 1), 1000);
}

TEST(StarImage, OnACausticStaysFinite) {
  // Exactly behind a hole without spin, and so near beside it that float cannot tell.
  for (const double beside : {0.0, 1e-12, 1e-8, 1e-6, 1e-4}) {
    const EyeCamera eye = eye_at({0.0, 8.0, pi / 2, 0.0, ObserverMotion::fixed});
    StarCatalogue catalogue;
    catalogue.stars.push_back({1, 180.0, beside * 180.0 / pi, 1.0F, 0.5F});
    const StarField field(catalogue, glm::dmat3(1.0), colours().view());
    const auto images = images_of(field, eye, settings_for(12.0));
    EXPECT_GE(images.size(), 2U) << beside;
    for (const StarImage& image : images) {
      EXPECT_TRUE(std::isfinite(image.magnification) && std::isfinite(image.illuminance.x)) << beside;
    }
  }
}

TEST(StarImage, NoStarsAndNoLightGiveNoImages) {
  const EyeCamera eye = eye_at(places[0]);
  EXPECT_TRUE(images_of(StarField({}, glm::dmat3(1.0), colours().view()), eye, settings_for(9.0)).empty());
  const StarField field(brightest(100), glm::dmat3(1.0), colours().view());
  EXPECT_TRUE(images_of(field, eye, settings_for(-20.0)).empty());
}

TEST(StarField, ConeSearchFindsAllThatItHolds) {
  const StarField field(brightest(20'000), glm::dmat3(1.0), colours().view());
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  for (int round = 0; round < 200; ++round) {
    const Vector3<double> axis = unit_of({normal(random), normal(random), normal(random)});
    const double half_angle = std::pow(uniform(random), 3.0);
    const float faintest =
        static_cast<float>(illuminance_of_magnitude_0 * std::pow(10.0, -0.4 * 9.0 * uniform(random)));
    std::vector<int> times(field.stars().size());
    field.search(axis, std::sin(half_angle), std::cos(half_angle), faintest, [&](int star) {
      ++times[static_cast<std::size_t>(star)];
      return true;
    });
    for (std::size_t i = 0; i < times.size(); ++i) {
      const FieldStar& star = field.stars()[i];
      ASSERT_LE(times[i], 1);
      if (dot(star.direction, axis) > std::cos(half_angle) && star.illuminance >= faintest) {
        ASSERT_EQ(times[i], 1) << star.number;
      }
    }
  }
}

TEST(BezierPatch, IsThePatchOfTheLensGrid) {
  GridSettings settings;
  settings.budget_px = 1.0;
  const LensStation station = build_lens_station(0.9, 6.0, 1.0, settings);
  const LensGrid grid = grid_view(station);
  const auto boxes = leaf_boxes(station);
  for (std::size_t leaf = 0; leaf < boxes.size(); leaf += 7) {
    const auto width = static_cast<float>(boxes[leaf].width_turns);
    const auto height = static_cast<float>(boxes[leaf].height);
    const BezierPatch patch = bezier_patch(grid, static_cast<int>(leaf), width, height);
    PlanePatch plane{};
    std::copy_n(patch.x, 16, plane.p);
    std::copy_n(patch.z, 16, plane.q);
    for (const auto& [u, v] : {std::pair{0.0F, 0.0F}, {0.3F, 0.8F}, {0.5F, 0.5F}, {1.0F, 0.2F}}) {
      const PatchValue read = patch_value(grid.nodes, grid.leaves + 4 * leaf, u, v, width, height);
      const PlaneValue value = evaluate(plane, u, v);
      EXPECT_NEAR(value.p, quad_part(read.sky, 0), 2e-6F);
      EXPECT_NEAR(value.q, quad_part(read.sky, 2), 2e-6F);
      EXPECT_NEAR(value.p_u, width * quad_part(read.along_gamma, 0), 2e-5F);
      EXPECT_NEAR(value.q_v, height * quad_part(read.along_s, 2), 2e-5F);
    }
  }
}

//! Illuminance of a picture's pixels [lx].
double light_of(const std::vector<float>& rgba, const Projection& projection) {
  using D = Dual<double>;
  double sum = 0.0;
  for (int y = 0; y < projection.height_px; ++y) {
    for (int x = 0; x < projection.width_px; ++x) {
      const Vector3<D> n = direction_from_pixel(projection, D(x + 0.5, 1.0, 0.0), D(y + 0.5, 0.0, 1.0));
      const Vector3<double> area = cross(Vector3<double>{n.x.along_x, n.y.along_x, n.z.along_x},
                                         Vector3<double>{n.x.along_y, n.y.along_y, n.z.along_y});
      const std::size_t i = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(projection.width_px) +
                                 static_cast<std::size_t>(x));
      sum += static_cast<double>(rgba[i + 1]) * std::sqrt(dot(area, area));
    }
  }
  return sum;
}

TEST(StarSplat, LightDoesNotDependOnSpreadNorResolution) {
  const EyeCamera eye = eye_at(places[0]);
  const StarField field(brightest(2000), glm::dmat3(1.0), colours().view());
  // Away from the rim, so that all of each image is in the picture.
  std::vector<StarImage> images = images_of(field, eye, settings_for(9.0));
  std::erase_if(images, [](const StarImage& image) { return image.direction.y > -0.15F; });
  double there = 0.0;
  for (const StarImage& image : images) {
    there += static_cast<double>(image.illuminance.y);
  }
  for (const int size : {256, 700, 1024}) {
    for (const double sigma_px : {0.0, 0.3, 0.5, 2.0}) {
      const Projection projection = make_dome_projection(size, pi, 0.0);
      std::vector<float> rgba(4 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
      splat_stars(images, eye, projection, {sigma_px, 1.0F}, 0, size, rgba.data());
      EXPECT_NEAR(light_of(rgba, projection) / there, 1.0, 0.01) << size << " " << sigma_px;
    }
  }
}

TEST(StarSplat, BlocksOfRowsMakeTheWholePicture) {
  const EyeCamera eye = eye_at(places[1]);
  const StarField field(brightest(2000), glm::dmat3(1.0), colours().view());
  const auto images = images_of(field, eye, settings_for(9.0));
  const Projection projection = make_equirectangular_projection(512, 256);
  std::vector<float> whole(4 * 512 * 256);
  std::vector<float> parts(4 * 512 * 256);
  splat_stars(images, eye, projection, {0.7, 1.0F}, 0, 256, whole.data());
  for (int row = 0; row < 256; row += 51) {
    splat_stars(images, eye, projection, {0.7, 1.0F}, row, std::min(51, 256 - row), parts.data() + 4L * 512 * row);
  }
  EXPECT_EQ(whole, parts);
}

TEST(Projection, PixelFromDirectionIsTheInverse) {
  for (const Projection& projection : {make_dome_projection(500, pi, 0.5), make_equirectangular_projection(600, 300),
                                       make_pinhole_projection(640, 360, 1.2)}) {
    for (double x = 3.3; x < projection.width_px; x += 41.0) {
      for (double y = 2.1; y < projection.height_px; y += 37.0) {
        double back_x = 0.0;
        double back_y = 0.0;
        ASSERT_TRUE(pixel_from_direction(projection, direction_from_pixel(projection, x, y), back_x, back_y));
        EXPECT_NEAR(back_x, x, 1e-9);
        EXPECT_NEAR(back_y, y, 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace ergodome
