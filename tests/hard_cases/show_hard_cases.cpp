
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "kernels/core/angles.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "render/output/image_writer.h"
#include "tests/hard_cases/contact_sheets.h"
#include "tests/hard_cases/miss.h"
#include "tests/hard_cases/ray_sets.h"
#include "tests/hard_cases/sky_window.h"

// Creates the pictures and tables of content/docs/explanation/hard-cases.md. Usage: show_hard_cases
// FOLDER.
namespace ergodome::test {
namespace {

constexpr int panel_px = 300;

using Panel = std::vector<std::array<unsigned char, 3>>;

std::size_t pixel_at(int x, int y) { return static_cast<std::size_t>(y) * panel_px + static_cast<std::size_t>(x); }

//! Returns the color of a sky direction: a pattern of squares of 15 degrees, in a color for each
//! octant of the sky. The shadow is black; rays that a method did not resolve are magenta.
std::array<unsigned char, 3> colour_of(const SeenSky& seen, std::size_t i) {
  if (seen.status[i] == 1.0) {
    return {0, 0, 0};
  }
  const Vector3<double> sky = {seen.sky[0][i], seen.sky[1][i], seen.sky[2][i]};
  if (!(std::abs(dot(sky, sky) - 1.0) < 0.1)) {
    return {255, 0, 255};
  }
  const double step = pi / 12.0;
  const auto row = static_cast<int>(std::floor(std::acos(std::clamp(sky.z, -1.0, 1.0)) / step));
  const auto column = static_cast<int>(std::floor((std::atan2(sky.y, sky.x) + pi) / step));
  const bool light = (row + column) % 2 == 0;
  const auto part = [&](bool strong) { return static_cast<unsigned char>((light ? 245 : 150) - (strong ? 0 : 90)); };
  return {part(sky.x > 0.0), part(sky.y > 0.0), part(sky.z > 0.0)};
}

Panel panel_of(const SeenSky& seen) {
  Panel panel(seen.status.size());
  for (std::size_t i = 0; i < panel.size(); ++i) {
    panel[i] = colour_of(seen, i);
  }
  return panel;
}

//! Writes two panels next to each other as an image file.
void write_pair(const std::filesystem::path& file, const Panel& left, const Panel& right) {
  constexpr int gap = 8;
  constexpr int width = 2 * panel_px + gap;
  std::vector<std::uint8_t> pixels(3UL * width * panel_px, 255);
  const auto put = [&](const Panel& panel, int from) {
    for (int y = 0; y < panel_px; ++y) {
      for (int x = 0; x < panel_px; ++x) {
        const auto& colour = panel[pixel_at(x, y)];
        std::copy(colour.begin(), colour.end(), pixels.begin() + 3L * (y * width + from + x));
      }
    }
  };
  put(left, 0);
  put(right, panel_px + gap);
  write_png(file, pixels, width, panel_px);
}

void show_axis(const std::filesystem::path& folder) {
  const CameraState camera_state = {0.9, 6.0, 1e-4};
  const Directions rays = square_window({-1.0, 0.0, 0.0}, 2.4, panel_px);
  write_pair(folder / "hard-axis.png", panel_of(by_rays(camera_state, rays, TraceMethod::baseline_rk34, 1e-4)),
             panel_of(by_rays(camera_state, rays, TraceMethod::taylor, 1e-4)));
}

void show_edge(const std::filesystem::path& folder) {
  const CameraState camera_state = {0.9, 8.0, 1.3};
  const CameraStation camera = station_at(camera_state);
  const ShadowChart chart = make_shadow_chart(camera);
  const double gamma = 1.2;
  const double edge = edge_polar_angle(camera, chart, gamma) + 6e-6;
  const Directions rays =
      square_window(chart_direction<double>(chart, std::cos(edge), std::sin(edge), gamma), 1.6e-5, panel_px);
  write_pair(folder / "hard-edge.png", panel_of(by_float_rays(camera_state, rays, TraceMethod::taylor, 1e-6)),
             panel_of(by_rays(camera_state, rays, TraceMethod::taylor, 1e-9)));
}

void show_grids(const std::filesystem::path& folder) {
  const CameraState camera_state = {0.999, 5.0, 0.5 * pi, ObserverMotion::geodesic};
  const CameraStation camera = station_at(camera_state);
  const ShadowChart chart = make_shadow_chart(camera);
  const double edge = edge_polar_angle(camera, chart, 0.6) + 0.04;
  const Directions rays =
      square_window(chart_direction<double>(chart, std::cos(edge), std::sin(edge), 0.6), 0.25, panel_px);
  write_pair(folder / "hard-grids.png", panel_of(by_quadtree(camera_state, rays)),
             panel_of(by_live_grid(camera_state, rays, Nodes::in_double)));
}

void show_poles(const std::filesystem::path& folder) {
  const CameraState camera_state = {0.9, 6.0, 0.0};
  const Directions rays = square_window({-1.0, 0.0, 0.0}, 2.4, panel_px);
  write_pair(folder / "hard-poles.png", panel_of(by_quadtree(camera_state, rays)),
             panel_of(by_live_grid(camera_state, rays, Nodes::in_double)));
}

//! Compares the edge of the shadow by textbook formulas with our edge, for a tiny spin. The
//! textbook's impact parameters of photon orbits (Bardeen 1973), α = -ξ and β² = η for a distant
//! camera in the equatorial plane, divide by the spin and lose their digits.
void show_textbook(const std::filesystem::path& folder) {
  constexpr double spin = 1e-6;
  Panel naive(panel_px * panel_px, {250, 250, 250});
  Panel own = naive;
  const double scale = 0.5 * panel_px / 6.0;
  const auto put = [&](Panel& panel, double alpha, double beta) {
    const auto x = static_cast<int>(std::lround(0.5 * panel_px + scale * alpha));
    const auto y = static_cast<int>(std::lround(0.5 * panel_px - scale * beta));
    if (x > 0 && x < panel_px - 1 && y > 0 && y < panel_px - 1) {
      for (const int i : {0, 1, panel_px, panel_px + 1}) {
        panel[pixel_at(x, y) + static_cast<std::size_t>(i)] = {20, 20, 20};
      }
    }
  };
  const auto a = static_cast<float>(spin);
  const auto first = static_cast<float>(photon_orbit_radius(Spacetime{spin}, 1.0));
  const auto last = static_cast<float>(photon_orbit_radius(Spacetime{spin}, -1.0));
  for (int i = 0; i <= 2000; ++i) {
    const float r = first + (last - first) * static_cast<float>(i) / 2000.0F;
    const float xi = (r * r * (3.0F - r) - a * a * (r + 1.0F)) / (a * (r - 1.0F));
    const float eta = r * r * r * (4.0F * a * a - r * (r - 3.0F) * (r - 3.0F)) / (a * a * (r - 1.0F) * (r - 1.0F));
    if (eta >= 0.0F) {
      put(naive, static_cast<double>(-xi), static_cast<double>(std::sqrt(eta)));
      put(naive, static_cast<double>(-xi), -static_cast<double>(std::sqrt(eta)));
    }
  }
  constexpr double far = 1e5;
  const CameraStation camera = make_camera_station(Spacetime{spin}, far, 0.5 * pi, 0.0, ObserverMotion::zamo);
  const ShadowChart chart = make_shadow_chart(camera);
  for (int i = 0; i < 720; ++i) {
    const double gamma = 2.0 * pi * i / 720;
    const double alpha = edge_polar_angle(camera, chart, gamma);
    const Vector3<double> n = chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma);
    put(own, far * n.z, -far * n.y);
  }
  write_pair(folder / "hard-textbook.png", naive, own);
}

//! Prints a row of the table about rays in float: the fraction that is bright instead of dark or
//! dark instead of bright, the fraction that was not resolved, and the error of the others on the
//! screen.
void print_float(const std::string& what, const CameraState& camera_state, const Directions& rays) {
  const Misses misses = misses_of(exact_rays(station_at(camera_state), rays),
                                  by_float_rays(camera_state, rays, TraceMethod::taylor, 1e-6));
  const double part = 100.0 / static_cast<double>(rays.size());
  std::printf("| %s | %.1f %% | %.1f %% | ", what.c_str(), part * misses.wrong, part * misses.unresolved);
  if (misses.screen.empty()) {
    std::puts("- |");
  } else {
    std::printf("%.0e, %.0e |\n", misses.screen_at(0.5), misses.screen_at(0.99));
  }
}

void print_where_float_is_enough() {
  std::puts("| rays in float | wrong | gave up | displacement on the screen: median, p99 [rad] |\n|---|---|---|---|");
  const CameraState usual = {0.9, 8.0, 1.3};
  print_float("r = 8, whole sky", usual, whole_sky(station_at(usual)));
  for (int exponent = 1; exponent <= 8; ++exponent) {
    print_float("1e-" + std::to_string(exponent) + " rad from the edge", usual,
                beside_edge(station_at(usual), std::pow(10.0, -exponent)));
  }
  for (int exponent = 1; exponent <= 6; ++exponent) {
    const CameraState falling = {0.9, horizon_radius(Spacetime{0.9}) + std::pow(10.0, -exponent), 1.2,
                                 ObserverMotion::rain};
    print_float("in free fall, 1e-" + std::to_string(exponent) + " M above the horizon", falling,
                whole_sky(station_at(falling)));
  }
  for (const int exponent : {2, 4, 6}) {
    const CameraState far = {0.9, std::pow(10.0, exponent), 1.3};
    print_float("r = 1e" + std::to_string(exponent), far, whole_sky(station_at(far)));
  }
  for (const double beta : {0.9, 0.99, 0.999, 0.9999}) {
    CameraState fast = usual;
    fast.motion = ObserverMotion::velocity;
    fast.beta = {0.0, 0.0, beta};
    print_float("at " + std::to_string(beta) + " c", fast, whole_sky(station_at(fast)));
  }
}

//! Prints the errors of naive methods for a case, next to ours. The naive methods are the published
//! ray tracer, which uses polar angles, and the published grid. Errors are 99th percentiles.
void print_case(const HardCase& hard) {
  const Directions rays = hard.rays(station_at(hard.camera_state));
  const std::vector<ExactRay> exact = exact_rays(station_at(hard.camera_state), rays);
  const double part = 100.0 / static_cast<double>(rays.size());
  const auto print = [&](const SeenSky& seen, bool in_px) {
    const Misses misses = misses_of(exact, seen);
    const double miss = misses.screen_at(0.99) / (in_px ? dome_pixel : 1.0);
    if (misses.wrong + misses.unresolved > 0) {
      std::printf("%.0f %% %s", part * (misses.wrong + misses.unresolved),
                  misses.unresolved > misses.wrong ? "gave up" : "wrong");
    }
    if (!misses.screen.empty()) {
      std::printf(misses.wrong + misses.unresolved > 0 ? ", " : "");
      std::printf(in_px ? "%.2f px" : "%.0e", miss);
    } else if (misses.wrong + misses.unresolved == 0) {
      std::printf("winds");
    }
    std::printf(" | ");
  };
  std::printf("| %s | ", hard.name);
  print(by_rays(hard.camera_state, rays, TraceMethod::baseline_rk34, 1e-7), false);
  hard.allowed.quadtree_px == not_asked ? static_cast<void>(std::printf("- | "))
                                        : print(by_quadtree(hard.camera_state, rays), true);
  print(by_float_rays(hard.camera_state, rays, TraceMethod::taylor, 1e-6), false);
  print(by_rays(hard.camera_state, rays, TraceMethod::taylor, 1e-12), false);
  hard.allowed.grid_px == not_asked ? static_cast<void>(std::printf("- | "))
                                    : print(by_live_grid(hard.camera_state, rays, Nodes::in_double), true);
  std::puts("");
}

void print_cases() {
  std::puts(
      "| case | polar angles (`baseline_rk34`, double) | published grid | Taylor series, float | Taylor series, double "
      "| conforming grid |");
  std::puts("|---|---|---|---|---|---|");
  for (const HardCase& hard : hard_cases()) {
    print_case(hard);
  }
}

}  // namespace
}  // namespace ergodome::test

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "show_hard_cases FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  using namespace ergodome::test;
  show_axis(folder);
  show_edge(folder);
  show_grids(folder);
  show_poles(folder);
  show_textbook(folder);
  write_contact_sheets(folder);
  print_cases();
  std::puts("");
  print_where_float_is_enough();
  return 0;
}
