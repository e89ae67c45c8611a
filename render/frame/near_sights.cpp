#include "render/frame/near_sights.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/find_root.h"
#include "kernels/mesh/path_step.h"
#include "kernels/near_field/near_pixels.h"
#include "render/disk/disk_pass.h"
#include "render/lens/direct_lens.h"

namespace ergodome {

namespace {

constexpr double ray_tolerance = 1e-7;
constexpr int most_steps = 2000;
//! Nearer to the horizon than this share of its radius nothing is looked for.
constexpr double horizon_margin = 1e-6;

using Step = PathStep<near_order, NearParts::azimuth_and_distance, double>;

//! Follows light backwards from a direction of a head's view as long as it may come between the radii: visit(step).
template <class Visit>
void follow(const EyeCamera& head, const Vector3<double>& view, const RadialBounds& bounds, Visit&& visit) {
  const CameraStation camera = station_of(head);
  const double(&m)[3][3] = head.frame_from_view;
  const auto row = [&](int i) { return m[i][0] * view.x + m[i][1] * view.y + m[i][2] * view.z; };
  const RadialBounds outside = {std::max(bounds.least, camera.horizon_r * (1.0 + horizon_margin)),
                                std::max(bounds.greatest, 1.01 * camera.horizon_r)};
  follow_path<near_order, NearParts::azimuth_and_distance>(
      camera.spin, camera.cosine_phi, camera.sine_phi, start_near_ray(camera, Vector3<double>{row(0), row(1), row(2)}),
      outside, MeshLimits{ray_tolerance, most_steps}, true, [&](int, const Step& step) {
        visit(step);
        return false;
      });
}

//! Finds where a function of the way changes its sign within a step; one that does so twice within a half of it goes by.
template <class Function, class Found>
void find_crossings(const Step& step, Function&& function, Found&& found) {
  const double at[3] = {0.0, 0.5 * step.length, step.length};
  const double value[3] = {function(at[0]), function(at[1]), function(at[2])};
  for (int i = 0; i < 2; ++i) {
    if ((value[i] < 0.0) != (value[i + 1] < 0.0)) {
      const double side = value[i] < 0.0 ? 1.0 : -1.0;
      found(find_root(at[i], at[i + 1], [&](double h) { return side * function(h); }));
    }
  }
}

//! Gathers what a way meets of one thing.
class Meetings {
 public:
  explicit Meetings(std::vector<NearSight>& all) : all_(all) {}

  //! A place counts between radii; where the way begins, nothing is met.
  void add(const Step& step, double h, double least_r, double greatest_r) {
    const Vector3<double> place = step.point(h);
    const double r = std::sqrt(dot(place, place));
    const double distance = step.distance(h);
    if (!(distance > 1e-9 * r)) {
      return;
    }
    if (r >= least_r && r <= greatest_r) {
      all_.push_back({place, distance, !any_});
    }
    any_ = true;
  }

 private:
  std::vector<NearSight>& all_;
  bool any_ = false;
};

}  // namespace

std::vector<NearSight> near_sights(const Show& show, const EyeCamera& head, const Vector3<double>& view) {
  std::vector<NearSight> sights;
  if (show.disk && show.disk->opacity > 0.0) {
    const double inner = inner_edge(*show.disk, show.spin);
    const double outer = show.disk->outer;
    Meetings disk(sights);
    // Where light went through the plane beside the disk counts, too: after that it comes the long way round.
    follow(head, view, {inner, std::max(outer, 1.01 * head.r)}, [&](const Step& step) {
      find_crossings(
          step, [&](double h) { return step.point(h).z; }, [&](double h) { disk.add(step, h, inner, outer); });
    });
  }
  for (const ShellSettings& shell : show.shells) {
    if (!is_visible(shell)) {
      continue;
    }
    constexpr double beside = 1e-6;
    Meetings sphere(sights);
    const double least = (1.0 - beside) * shell.radius;
    const double greatest = (1.0 + beside) * shell.radius;
    follow(head, view, {least, greatest}, [&](const Step& step) {
      find_crossings(
          step, [&](double h) { return series_value(step.series.u, h) - 1.0 / shell.radius; },
          [&](double h) { sphere.add(step, h, least, greatest); });
    });
  }
  return sights;
}

std::optional<double> distance_of_place(const EyeCamera& head, const Vector3<double>& view,
                                        const Vector3<double>& place) {
  const double r = std::sqrt(dot(place, place));
  double least_off = 1e-3 * r;
  std::optional<double> distance;
  follow(head, view, {0.999 * r, 1.001 * r}, [&](const Step& step) {
    find_crossings(
        step, [&](double h) { return series_value(step.series.u, h) - 1.0 / r; },
        [&](double h) {
          const Vector3<double> aside = step.point(h) - place;
          const double off = std::sqrt(dot(aside, aside));
          if (off < least_off) {
            least_off = off;
            distance = step.distance(h);
          }
        });
  });
  return distance;
}

}  // namespace ergodome
