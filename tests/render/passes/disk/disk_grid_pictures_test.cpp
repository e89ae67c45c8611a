#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "kernels/projection/make_projection.h"
#include "kernels/projection/pixel_measure.h"
#include "render/passes/disk/disk_grids.h"
#include "render/passes/near_field/near_field.h"
#include "tests/render/eye_at.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using test::eye_at;

constexpr int pictured_px = test::sanitized ? 128 : 256;

//! A camera that faces a disk. Its pictures by a disk grid and by rays are compared.
struct PicturedDisk {
  const char* name;
  double spin;
  double r;
  double theta;
  double field_of_view;
  bool clouds = false;
  //! If true, the view points away from the hole.
  bool away = false;
  //! If true, there is a ball, half in front of the disk and half behind it, drawn by rays.
  bool ball = false;
};

Show pictured_show(const PicturedDisk& at) {
  Show show;
  show.spin = at.spin;
  show.disk.emplace();
  show.disk->temperature_k = 20000.0;
  show.disk->pattern = at.clouds ? DiskPattern::procedural : DiskPattern::none;
  show.effects.redshift = true;
  if (at.ball) {
    ObjectSettings& ball = show.objects.emplace_back();
    ball.form = ObjectForm::sphere;
    ball.method = ObjectMethod::trace;
    ball.position = {12.0, 4.0, 0.5};
    ball.size = 2.5;
  }
  return show;
}

//! Pictures of the same scene with the disk by rays, and by a grid.
struct TwoPictures {
  std::vector<float> by_rays;
  std::vector<float> by_grid;
};

TwoPictures draw_both(const PicturedDisk& at) {
  const Projection projection = make_pinhole_projection(pictured_px, pictured_px, at.field_of_view);
  EyeCamera eye = eye_at(at.spin, at.r, at.theta);
  if (at.away) {
    eye.frame_from_view[2][0] = -1.0;
    eye.frame_from_view[0][2] = -1.0;
  }
  const Show show = pictured_show(at);
  const DiskPass pass(show, Backend::cpu);
  const std::unique_ptr<TracedObjects> objects = traced_objects_of(show, Backend::cpu);
  DiskGrids grids;
  NearField near_field{&pass, nullptr, objects.get(), {}};
  TwoPictures pictures;
  for (std::vector<float>* rgba : {&pictures.by_rays, &pictures.by_grid}) {
    rgba->assign(4UL * pictured_px * pictured_px, 0.0F);
    draw_near_field(Backend::cpu, near_field, {eye, nullptr, projection, 0.02, 3.0}, {0, pictured_px}, rgba->data());
    near_field.disk_grid =
        grids.grid_for({eye, pass.look_at(3.0), pixel_angle(projection), 0.1, pictured_px * pictured_px, true});
  }
  return pictures;
}

//! Returns the difference of each pixel that the disk covers in either picture: the maximum over
//! the color channels.
std::vector<float> differences(const TwoPictures& pictures) {
  std::vector<float> found;
  for (std::size_t i = 0; i < pictures.by_rays.size(); i += 4) {
    const float* const a = pictures.by_rays.data() + i;
    const float* const b = pictures.by_grid.data() + i;
    if (a[3] > 0.0F || b[3] > 0.0F) {
      float worst = 0.0F;
      for (int c = 0; c < 4; ++c) {
        worst = std::max(worst, std::abs(std::min(a[c], 1.0F) - std::min(b[c], 1.0F)));
      }
      found.push_back(worst);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

double sum_of(const std::vector<float>& rgba) {
  double sum = 0.0;
  for (const float part : rgba) {
    sum += static_cast<double>(std::min(part, 1.0F));
  }
  return sum;
}

TEST(DiskGridPictures, AreThoseOfRays) {
  for (const PicturedDisk& at :
       std::vector<PicturedDisk>{{"no spin", 0.0, 30.0, 1.4, 1.4},
                                 {"clouds", 0.9, 30.0, 1.4, 1.4, true},
                                 {"fast, clouds", 0.999, 30.0, 1.4, 1.4, true},
                                 {"extremal", 1.0, 30.0, 1.4, 1.4},
                                 {"against the hole", -1.0, 30.0, 1.4, 1.4, true},
                                 {"from its edge", 0.9, 30.0, 0.5 * pi, 1.4, true},
                                 {"from next to its edge", 0.9, 30.0, 0.5 * pi - 0.01, 1.4},
                                 {"from the axis", 0.9, 30.0, 0.0, 1.4, true},
                                 {"from far", 0.9, 1e3, 1.3, 0.05, true},
                                 {"from within", 0.9, 8.0, 1.2, 1.6, true},
                                 {"next to the horizon", 0.9, 1.5, 1.2, 2.0, true, true},
                                 {"round a ball", 0.9, 30.0, 1.4, 1.4, false, false, true},
                                 {"clouds round a ball", 0.9, 30.0, 1.4, 1.4, true, false, true}}) {
    SCOPED_TRACE(at.name);
    const TwoPictures pictures = draw_both(at);
    const std::vector<float> found = differences(pictures);
    ASSERT_GT(found.size(), pictured_px * pictured_px / 22U);
    // The coverage of pixels at the edges of the disk follows from the derivative of 1/r per pixel
    // at the center of the pixel. Where it changes fast, the two coverages differ slightly.
    EXPECT_LT(found[found.size() / 2], 1e-3F);
    EXPECT_LT(found[found.size() * 99 / 100], 0.04F);
    EXPECT_LT(found[found.size() * 999 / 1000], 0.12F);
    EXPECT_NEAR(sum_of(pictures.by_grid) / sum_of(pictures.by_rays), 1.0, 3e-3);
  }
}

TEST(DiskGridPictures, LeavePixelsThatShowObjectsToRays) {
  // The disk gives no light but hides what is behind it, so only the visible parts of the ball are
  // colored.
  const PicturedDisk at = {"dark, round a ball", 0.9, 30.0, 1.4, 1.4, false, false, true};
  const auto coloured = [&](bool by_grid) {
    Show show = pictured_show(at);
    show.disk->exposure = 0.0;
    const DiskPass pass(show, Backend::cpu);
    const std::unique_ptr<TracedObjects> objects = traced_objects_of(show, Backend::cpu);
    const Projection projection = make_pinhole_projection(pictured_px, pictured_px, at.field_of_view);
    const EyeCamera eye = eye_at(at.spin, at.r, at.theta);
    DiskGrids grids;
    NearField near_field{&pass, nullptr, objects.get(), {}};
    if (by_grid) {
      near_field.disk_grid =
          grids.grid_for({eye, pass.look_at(3.0), pixel_angle(projection), 0.1, pictured_px * pictured_px, true});
      EXPECT_TRUE(near_field.disk_grid);
    }
    std::vector<float> rgba(4UL * pictured_px * pictured_px);
    draw_near_field(Backend::cpu, near_field, {eye, nullptr, projection, 0.02, 3.0}, {0, pictured_px}, rgba.data());
    std::vector<std::array<float, 4>> pixels;
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
      if (rgba[i] > 0.0F) {
        pixels.push_back({static_cast<float>(i), rgba[i], rgba[i + 1], rgba[i + 3]});
      }
    }
    return pixels;
  };
  const auto by_rays = coloured(false);
  EXPECT_GT(by_rays.size(), pictured_px * pictured_px / 656U);
  EXPECT_EQ(coloured(true), by_rays);
}

TEST(DiskGridPictures, TakeAGridFromPictureToPictureAtOnePlace) {
  const PicturedDisk at = {"any", 0.9, 30.0, 1.4, 1.4};
  const DiskPass pass(pictured_show(at), Backend::cpu);
  const DiskAppearance disk = pass.look_at(0.0);
  DiskGrids grids;
  EyeCamera eye = eye_at(at.spin, at.r, at.theta);
  EXPECT_FALSE(grids.grid_for({eye, disk, 1e-3, 0.25, 1e4, false}));
  const std::optional<DiskGrid> first = grids.grid_for({eye, disk, 1e-3, 0.25, 1e6, false});
  ASSERT_TRUE(first);
  eye.phi = 1.0;
  EXPECT_EQ(grids.grid_for({eye, disk, 1e-3, 0.25, 1e6, false})->nodes[0], first->nodes[0]);
  EXPECT_EQ(grids.built(), 1);
  eye.r = 31.0;
  grids.grid_for({eye, disk, 1e-3, 0.25, 1e6, false});
  EXPECT_EQ(grids.built(), 2);
}

TEST(DiskGridPictures, HaveNoGridForMatterThatFalls) {
  Show show = pictured_show({"any", 0.5, 30.0, 1.4, 1.4});
  show.disk->profile = DiskProfile::uniform;
  show.disk->plunging = true;
  const DiskPass pass(show, Backend::cpu);
  DiskGrids grids;
  const EyeCamera eye = eye_at(0.5, 30.0, 1.4);
  EXPECT_FALSE(grids.grid_for({eye, pass.look_at(0.0), 1e-3, 0.25, 1e6, true}));
  EXPECT_EQ(grids.built(), 0);
}

}  // namespace
}  // namespace ergodome
