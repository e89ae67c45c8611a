#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "render/accuracy/lenses/pixel_lens.h"

// Measures the renderer's own lens sources (LensSource).

namespace ergodome {

//! Returns the sky direction that a pixel sees; nothing if the pixel is dark.
inline std::optional<Vector3<double>> seen_in(const LensPixels& pixels, std::int64_t pixel) {
  const Vector3<double> seen = {pixels.sky[0][pixel], pixels.sky[1][pixel], pixels.sky[2][pixel]};
  if (!(pixels.coverage[pixel] > 0.0F) || !(dot(seen, seen) > 0.0)) {
    return std::nullopt;
  }
  return seen;
}

//! Adapts one of the renderer's lens sources, on the CPU, to the interface of measured methods.
class SourcePixels : public PixelLens {
 public:
  //! `bytes`: memory of the prepared data. `disk_bytes` computes their size in a trajectory file.
  //! It is called on demand, because packing a station takes longer than building it.
  SourcePixels(LensScene& scene, std::unique_ptr<LensSource> source, std::size_t bytes = 0,
               std::function<std::size_t()> disk_bytes = {})
      : height_px_(scene.projection().height_px),
        pixels_(scene.pixels()),
        source_(std::move(source)),
        bytes_(bytes),
        disk_bytes_(std::move(disk_bytes)) {}

  void draw() override { source_->fill(0, height_px_, pixels_); }

  [[nodiscard]] std::optional<Vector3<double>> sky(std::int64_t pixel) const override {
    return seen_in(pixels_, pixel);
  }

  [[nodiscard]] std::size_t bytes() const override { return bytes_; }
  [[nodiscard]] std::optional<std::size_t> disk_bytes() const override {
    return disk_bytes_ ? std::optional(disk_bytes_()) : std::nullopt;
  }

 private:
  int height_px_;
  LensPixels pixels_;
  std::unique_ptr<LensSource> source_;
  std::size_t bytes_;
  std::function<std::size_t()> disk_bytes_;
};

}  // namespace ergodome
