#include "render/passes/overlay/caption_layer.h"

#include <algorithm>

#include "render/passes/overlay/overlay_pass.h"
#include "render/passes/overlay/overlay_position.h"

// Captions as a layer separate from the picture.
namespace ergodome {

std::vector<std::pair<const Caption*, double>> OverlayPass::seen_captions(std::optional<double> time_s) const {
  std::vector<std::pair<const Caption*, double>> seen;
  const auto add = [&](const Caption& caption, double opacity) {
    if (opacity > 0.0 && caption.letter_deg > 0.0 && !text_in(caption.text, language_).empty()) {
      seen.emplace_back(&caption, opacity);
    }
  };
  if (time_s && captions_shown_) {
    for (const Caption& caption : captions_) {
      add(caption, presence_at(caption.presence, *time_s));
    }
  }
  if (readout_ && captions_shown_) {
    add(*readout_, 1.0);
  }
  for (const Caption& caption : extra_) {
    add(caption, extra_opacity_);
  }
  return seen;
}

LaidCaptions OverlayPass::caption_layer(const Projection& projection, std::optional<double> time_s) {
  std::vector<std::pair<const Caption*, double>> seen = seen_captions(time_s);
  double maximum = 0.0;
  for (const auto& [caption, opacity] : seen) {
    maximum = std::max(maximum, opacity);
  }
  std::vector<LayerCaption> asked;
  for (auto& [caption, opacity] : seen) {
    opacity /= maximum;
    asked.push_back({text_in(caption->text, language_), caption->position, caption->letter_deg, caption->width_deg,
                     caption->color, opacity});
  }
  if (asked.empty()) {
    in_layer_.clear();
    layer_.reset();
    canvas_ = {};
  } else if (asked != in_layer_ || !layer_tiles_ || !layer_tiles_->are_of(projection)) {
    layer_ = draw_layer(projection, seen);
    in_layer_ = std::move(asked);
    layer_tiles_ = tiles_of(projection);
  }
  return {layer_, maximum};
}

std::shared_ptr<const CaptionLayer> OverlayPass::draw_layer(
    const Projection& projection, const std::vector<std::pair<const Caption*, double>>& captions) {
  const std::size_t row = 4 * static_cast<std::size_t>(projection.width_px);
  canvas_.resize(row * static_cast<std::size_t>(projection.height_px));
  ++drawn_;
  TileRows drawn;
  const OverlayTarget target = {Backend::cpu, canvas_.data(), {}, true};
  for (const auto& [caption, opacity] : captions) {
    const TileRows rows = draw_caption(target, projection, *caption, opacity);
    if (rows.first < rows.end) {
      drawn =
          drawn.first < drawn.end ? TileRows{std::min(drawn.first, rows.first), std::max(drawn.end, rows.end)} : rows;
    }
  }
  if (drawn.first >= drawn.end) {
    return nullptr;
  }
  CaptionLayer layer;
  layer.width = projection.width_px;
  layer.height = projection.height_px;
  layer.first_row = drawn.first * overlay_tile_px;
  layer.row_count = std::min(drawn.end * overlay_tile_px, projection.height_px) - layer.first_row;
  const auto begin = canvas_.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(layer.first_row));
  const auto end = begin + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(layer.row_count));
  layer.rgba.assign(begin, end);
  std::fill(begin, end, 0.0F);
  return std::make_shared<const CaptionLayer>(std::move(layer));
}

}  // namespace ergodome
