#include "render/diagram/diagram_picture.h"

#include <algorithm>
#include <cmath>

#include "render/output/text_image.h"

namespace ergodome {

namespace {

//! Heights of the legend's and the labels' letters and of legend lines, the margin, and the width
//! of legend signs, as fractions of unit_height_px().
constexpr double letter_share = 0.019;
constexpr double label_share = 0.016;
constexpr double line_share = 0.031;
constexpr double margin_share = 0.022;
constexpr double sign_share = 0.045;

int share_px(double share, int width_px, int height_px) {
  return std::max(1, static_cast<int>(std::lround(share * unit_height_px(width_px, height_px))));
}

//! A picture in linear light on which texts are drawn.
struct Page {
  int width;
  int height;
  std::vector<float>& rgb;

  //! Converts a fraction of unit_height_px to pixels.
  [[nodiscard]] int pixels(double share) const { return share_px(share, width, height); }

  void ink(int x, int y, const Ink& color, float cover) const {
    if (x < 0 || y < 0 || x >= width || y >= height) {
      return;
    }
    float* const to = rgb.data() + 3 * (static_cast<long>(y) * width + x);
    for (std::size_t k = 0; k < 3; ++k) {
      to[k] += cover * (color[k] - to[k]);
    }
  }

  void fill(int left, int top, int across, int down, const Ink& color, float cover = 1.0F) const {
    for (int y = top; y < top + down; ++y) {
      for (int x = left; x < left + across; ++x) {
        ink(x, y, color, cover);
      }
    }
  }

  //! Draws a text whose left edge is at `left` and whose vertical center is at y.
  void write(const TextImage& letters, int left, int y, const Ink& color) const {
    for (int row = 0; row < letters.height; ++row) {
      for (int column = 0; column < letters.width; ++column) {
        ink(left + column, y - letters.height / 2 + row, color,
            letters.coverage[static_cast<std::size_t>(row) * static_cast<std::size_t>(letters.width) +
                             static_cast<std::size_t>(column)]);
      }
    }
  }
};

//! Returns the distance of the legend from the top of the picture [px].
int legend_top(std::size_t lines, int width_px, int height_px) {
  return height_px - share_px(margin_share + line_share * static_cast<double>(lines), width_px, height_px);
}

void write_legend(const Page& page, const std::vector<LegendLine>& legend) {
  const int line_px = page.pixels(line_share);
  const int sign_px = page.pixels(sign_share);
  const int margin_px = page.pixels(margin_share);
  const int thick_px = page.pixels(0.004);
  int y = legend_top(legend.size(), page.width, page.height) + line_px / 2;
  for (const LegendLine& line : legend) {
    if (line.sign == LegendLine::Sign::line) {
      page.fill(margin_px, y - thick_px / 2, sign_px, thick_px, line.ink);
    } else if (line.sign == LegendLine::Sign::field) {
      const int side = line_px / 2;
      page.fill(margin_px + (sign_px - side) / 2, y - side / 2, side, side, line.ink);
    }
    const int indent = line.sign == LegendLine::Sign::none ? 0 : sign_px + margin_px / 2;
    const TextImage letters = text_image(line.text, page.pixels(letter_share));
    // Blends the picture behind a text with the color of the paper.
    page.fill(margin_px + indent - margin_px / 4, y - line_px / 2, letters.width + margin_px / 2, line_px,
              diagram_inks::paper(), 0.85F);
    page.write(letters, margin_px + indent, y, diagram_inks::words());
    y += line_px;
  }
}

void write_labels(const Page& page, const DiagramScene& scene, const OutsideCamera& camera) {
  const int top_of_legend = legend_top(scene.legend.size(), page.width, page.height);
  const int font_px = page.pixels(label_share);
  for (const DiagramLabel& label : scene.labels) {
    const Vector3<double> at = camera.in_view(label.position);
    if (!(-at.z > camera.nearest)) {
      continue;
    }
    const double x = 0.5 * (1.0 - at.x / (at.z * camera.half_width)) * page.width;
    const double y = 0.5 * (1.0 + at.y / (at.z * camera.half_height)) * page.height;
    if (x > 0.0 && x < page.width && y > font_px && y < top_of_legend - font_px) {
      page.write(text_image(label.text, font_px), static_cast<int>(x) + font_px / 4, static_cast<int>(y),
                 diagram_inks::photon_sphere());
    }
  }
}

std::uint8_t display_byte(float light) {
  const double v = std::clamp(static_cast<double>(light), 0.0, 1.0);
  const double shown = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * shown));
}

}  // namespace

DiagramPicture::DiagramPicture(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {
  gl_.run([this] { drawing_ = std::make_unique<DiagramDrawing>(); });
}

DiagramPicture::~DiagramPicture() {
  gl_.run([this] { drawing_.reset(); });
}

OutsideCamera DiagramPicture::camera_for(const OutsideDirection& direction,
                                         const std::vector<Vector3<double>>& positions,
                                         std::size_t legend_lines) const {
  const double low = 1.0 - static_cast<double>(legend_top(legend_lines, width_px_, height_px_)) / height_px_;
  return outside_camera(direction, positions, static_cast<double>(width_px_) / height_px_, {std::min(low, 0.6), 1.0});
}

DiagramImage DiagramPicture::draw(const DiagramScene& scene, const OutsideCamera& camera) {
  std::vector<float> picture;
  gl_.run([&] { picture = drawing_->draw(scene, camera, width_px_, height_px_); });
  const Page page{width_px_, height_px_, picture};
  write_labels(page, scene, camera);
  write_legend(page, scene.legend);
  DiagramImage image{width_px_, height_px_, {}};
  image.rgb.reserve(picture.size());
  for (const float light : picture) {
    image.rgb.push_back(display_byte(light));
  }
  return image;
}

}  // namespace ergodome
