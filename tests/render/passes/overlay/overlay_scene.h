#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "render/output/image_writer.h"
#include "render/passes/overlay/overlay_pass.h"
#include "render/passes/overlay/overlay_position.h"
#include "tests/support/folder_test.h"

// Pictures and overlay passes for tests of overlays.
namespace ergodome::test {

inline constexpr Tone as_it_is = {ToneCurve::gamma, 1.0F, 1.0F, 1.0F};
inline constexpr Presence always = {-1e9, 1e9, 0.0, 0.0};

inline Picture even_picture(const Projection& projection, float light, const Tone& tone = as_it_is) {
  Picture picture;
  picture.width = projection.width_px;
  picture.height = projection.height_px;
  picture.tone = tone;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const auto covered = static_cast<float>(image_coverage(projection, x + 0.5, y + 0.5));
      picture.rgba.insert(picture.rgba.end(), {covered * light, covered * light, covered * light, covered});
    }
  }
  return picture;
}

//! Returns the overlay pass of a show that contains only a timeline.
inline OverlayPass pass_of(const Timeline& timeline, const std::string& folder = "") {
  Show show;
  show.timeline = timeline;
  show.folder = folder;
  return OverlayPass(show);
}

//! Draws the overlays that are visible at a time onto a picture.
inline void draw(OverlayPass& pass, Picture& picture, const Projection& projection, double time_s = 0.0) {
  pass.draw({Backend::cpu, picture.rgba.data(), picture.tone, picture.heat_range.has_value()},
            overlay_projection(projection), time_s);
}

inline Picture drawn(const Timeline& timeline, const std::string& folder, const Projection& projection,
                     float light = 0.0F, double time_s = 0.0) {
  OverlayPass pass = pass_of(timeline, folder);
  Picture picture = even_picture(projection, light);
  draw(pass, picture, projection, time_s);
  return picture;
}

inline Caption caption_of(const std::string& text, double azimuth_deg = 0.0, double elevation_deg = 20.0) {
  Caption caption;
  caption.presence = always;
  caption.position = {azimuth_deg, elevation_deg, 0.0};
  caption.letter_deg = 5.0;
  caption.text[""] = text;
  return caption;
}

inline Timeline captions_of(std::vector<Caption> captions) {
  Timeline timeline;
  timeline.captions = std::move(captions);
  return timeline;
}

inline double sum_of_light(const Picture& picture) {
  double sum = 0.0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    sum += static_cast<double>(picture.rgba[i]);
  }
  return sum;
}

struct Spot {
  double x_px;
  double y_px;
};

//! Returns the center of the light in a picture.
inline Spot middle_of(const Picture& picture) {
  double sum = 0.0;
  Spot middle{0.0, 0.0};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const auto light =
          static_cast<double>(picture.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                                static_cast<std::size_t>(x))]);
      sum += light;
      middle.x_px += light * (x + 0.5);
      middle.y_px += light * (y + 0.5);
    }
  }
  return {middle.x_px / sum, middle.y_px / sum};
}

class Overlays : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    write_png(folder_ / "white.png", std::vector<std::uint8_t>(3UL * 16 * 16, 255), 16, 16);
    write_png(folder_ / "grey.png", std::vector<std::uint8_t>(3UL * 16 * 16, 128), 16, 16);
  }

  [[nodiscard]] static Overlay image_at(const std::string& file, double azimuth_deg, double elevation_deg,
                                        double width_deg) {
    Overlay overlay;
    overlay.image = file;
    overlay.presence = always;
    overlay.position = {azimuth_deg, elevation_deg, 0.0};
    overlay.width_deg = width_deg;
    return overlay;
  }

  [[nodiscard]] Picture spot_of(const Projection& projection, double azimuth_deg, double elevation_deg) const {
    Timeline timeline;
    timeline.overlays = {image_at("white.png", azimuth_deg, elevation_deg, 1.0)};
    return drawn(timeline, folder_.string(), projection);
  }

  void expect_dot(const Projection& projection, double azimuth_deg, double elevation_deg, const Spot& expected) const {
    const Picture picture = spot_of(projection, azimuth_deg, elevation_deg);
    ASSERT_GT(sum_of_light(picture), 1.0);
    const Spot middle = middle_of(picture);
    EXPECT_NEAR(middle.x_px, expected.x_px, 0.05) << azimuth_deg << " " << elevation_deg;
    EXPECT_NEAR(middle.y_px, expected.y_px, 0.05) << azimuth_deg << " " << elevation_deg;
  }
};

}  // namespace ergodome::test
