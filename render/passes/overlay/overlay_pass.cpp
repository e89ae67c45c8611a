#include "render/passes/overlay/overlay_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <set>

#include "content/show/show_errors.h"
#include "content/show/stereo_eyes.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/projection/pixel_measure.h"
#include "render/passes/overlay/camera_readout.h"
#include "render/passes/overlay/caption_notes.h"
#include "render/passes/overlay/overlay_position.h"

namespace ergodome {

namespace {

//! Range of the line heights in which letters are drawn, which are powers of two [px].
constexpr int smallest_line_px = 16;
constexpr int largest_line_px = 256;
//! Memory limits: for all images of a show, and for all cached texts.
constexpr long max_image_bytes = 4L << 30;
constexpr std::size_t max_caption_texels = 32UL << 20;
//! Maximum width of a flat image [deg]. Such an image already looks stretched; the width of its
//! plane would diverge at 180 degrees.
constexpr double widest_image_deg = 150.0;

//! Returns the key of the i-th overlay's image in a show.
std::string image_key(std::size_t i) { return fmt::format("overlay[{}].image", i); }

void check_overlay(const Overlay& overlay, const std::filesystem::path& path, int width, int height) {
  if (overlay.fisheye && width != height) {
    throw Error(path.string(), fmt::format("is {} x {} pixels, but a fisheye image must be square", width, height),
                "crop it, or place it as a flat image");
  }
  if (!overlay.fisheye && !(overlay.width_deg > 0.0 && overlay.width_deg <= widest_image_deg)) {
    throw Error(path.string(), fmt::format("has a width of {:.6g} degrees on the dome", overlay.width_deg),
                fmt::format("choose a width above 0 and up to {:.6g} degrees, or place it as a fisheye image",
                            widest_image_deg));
  }
  if (overlay.fisheye && !(overlay.fov_deg > 0.0 && overlay.fov_deg <= 360.0)) {
    throw Error(path.string(), fmt::format("has a field of view of {:.6g} degrees", overlay.fov_deg),
                "choose one above 0 and up to 360 degrees");
  }
}

//! Returns the surface on which a caption is drawn: bent on domes and spheres, plane on a flat
//! screen.
OverlaySurface caption_surface(const Projection& projection, const DomePosition& position, double across,
                               double upright) {
  return projection.kind == ProjectionKind::pinhole
             ? flat_surface(position, 2.0 * std::atan(0.5 * across), across / upright)
             : bent_surface(position, across, upright);
}

Error too_much(const std::string& folder) {
  return {folder, fmt::format("the images of its overlays need more than {} GiB", max_image_bytes >> 30),
          "use smaller or fewer images"};
}

}  // namespace

OverlayPass::OverlayPass(const Show& show) : captions_(show.timeline.captions), overlays_(show.timeline.overlays) {
  long bytes = 0;
  for (std::size_t i = 0; i < overlays_.size(); ++i) {
    const Overlay& overlay = overlays_[i];
    read_named(show, image_key(i), overlay.image, [&](const std::filesystem::path& path) {
      auto found = images_.find(overlay.image);
      if (found == images_.end()) {
        found = images_.emplace(overlay.image, texture_of(read_overlay_image(path), "overlay images")).first;
        bytes += static_cast<long>(found->second.host.size() * sizeof(std::uint16_t));
      }
      check_overlay(overlay, path, found->second.layout.width, found->second.layout.height);
    });
    if (bytes > max_image_bytes) {
      throw too_much(show.folder);
    }
  }
}

long OverlayPass::image_bytes(const Show& show) {
  std::set<std::string> seen;
  long bytes = 0;
  const std::vector<Overlay>& overlays = show.timeline.overlays;
  for (std::size_t i = 0; i < overlays.size(); ++i) {
    if (seen.insert(overlays[i].image).second) {
      const OverlaySize size = read_named(show, image_key(i), overlays[i].image, overlay_image_size);
      bytes += overlay_image_bytes(size.width, size.height);
    }
  }
  return bytes;
}

OverlayPass::Texture OverlayPass::texture_of(OverlayImage image, const char* name) {
  Texture texture;
  if (image.width > 0) {
    texture.host = Buffer<std::uint16_t>(Backend::cpu, image.texels, name);
  }
  image.texels = {};
  texture.layout = std::move(image);
  return texture;
}

std::unique_ptr<Pass> make_overlay_pass(const PassInput& input) { return std::make_unique<OverlayPass>(input.show); }

bool OverlayPass::take(Pass& next) {
  auto& made = static_cast<OverlayPass&>(next);
  captions_ = std::move(made.captions_);
  overlays_ = std::move(made.overlays_);
  images_ = std::move(made.images_);
  return true;
}

std::vector<std::string> OverlayPass::notes(const Show& show) const { return notes_of_captions(show); }

void OverlayPass::finish_frame(FinishedFrame& frame) {
  const Show& show = frame.show;
  const bool sky = frame.mode == ViewMode::sky;
  set_readout(sky && show.readout
                  ? std::optional(readout_caption(*show.readout, spacetime_of(show), frame.pose.r, frame.pose.theta))
                  : std::nullopt);
  const std::optional<double> time_s = sky ? frame.time_s : std::nullopt;
  for (const FinishedEye& eye : frame.eyes) {
    // Eyes with a camera per direction share one projection, so overlays are on the dome, at the
    // same position for both eyes.
    const double offset = has_camera_per_direction(show.stereo) ? 0.0 : eye.offset;
    draw({frame.backend, eye.rgba, frame.tone, !sky},
         overlay_projection(frame.projection, offset, show.stereo.convergence), time_s);
  }
}

void OverlayPass::set_extra(std::vector<Caption> captions, double opacity) {
  extra_ = std::move(captions);
  extra_opacity_ = opacity;
}

bool OverlayPass::draws_at(std::optional<double> time_s) const {
  const auto seen = [&](const Overlay& overlay) { return presence_at(overlay.presence, *time_s) > 0.0; };
  return (time_s && std::ranges::any_of(overlays_, seen)) || (!captions_apart_ && !seen_captions(time_s).empty());
}

void OverlayPass::draw(const OverlayTarget& target, const Projection& projection, std::optional<double> time_s) {
  if (!draws_at(time_s)) {
    return;
  }
  ++drawn_;
  if (time_s) {
    for (const Overlay& overlay : overlays_) {
      draw_image(target, projection, overlay, overlay.opacity * presence_at(overlay.presence, *time_s));
    }
  }
  if (!captions_apart_) {
    for (const auto& [caption, opacity] : seen_captions(time_s)) {
      draw_caption(target, projection, *caption, opacity);
    }
  }
}

void OverlayPass::draw_image(const OverlayTarget& target, const Projection& projection, const Overlay& overlay,
                             double opacity) {
  if (!(opacity > 0.0)) {
    return;
  }
  Texture& texture = images_.at(overlay.image);
  if (overlay.fisheye) {
    draw_surface(target, projection, texture, fisheye_surface(one_degree * overlay.fov_deg), opacity);
    return;
  }
  const double aspect = static_cast<double>(texture.layout.width) / texture.layout.height;
  const double width = one_degree * overlay.width_deg;
  const double height = 2.0 * std::atan(std::tan(0.5 * width) / aspect);
  const PlacedOverlay placed = placed_overlay(projection, overlay.position, width, height);
  if (placed.shown) {
    draw_surface(target, projection, texture, flat_surface(placed.position, placed.scale * width, aspect), opacity);
  }
}

OverlayPass::TileRows OverlayPass::draw_caption(const OverlayTarget& target, const Projection& projection,
                                                const Caption& caption, double opacity) {
  const std::string& text = text_in(caption.text, language_);
  if (!(opacity > 0.0) || !(caption.letter_deg > 0.0) || text.empty()) {
    return {};
  }
  const double width = std::min(one_degree * caption.width_deg, widest_bent_surface(caption.position));
  SetCaption& set = set_for(caption, text, width, pixel_angle(projection));
  if (set.texture.layout.width == 0) {
    return {};
  }
  const double angle = one_degree * caption.letter_deg / set.line_px;
  const double across = angle * set.texture.layout.width;
  const double upright = angle * set.texture.layout.height;
  const PlacedOverlay placed = placed_overlay(projection, caption.position, across, upright);
  if (!placed.shown) {
    return {};
  }
  return draw_surface(target, projection, set.texture,
                      caption_surface(projection, placed.position, placed.scale * across, placed.scale * upright),
                      opacity);
}

OverlayPass::SetCaption& OverlayPass::set_for(const Caption& caption, const std::string& text, double width,
                                              double angle_of_px) {
  const double letter = one_degree * caption.letter_deg;
  const double wished =
      std::clamp(letter / angle_of_px, static_cast<double>(smallest_line_px), static_cast<double>(largest_line_px));
  int line_px = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(wished))));
  const auto same = [&](const SetCaption& set) {
    return set.text == text && set.letter_deg == caption.letter_deg && set.width == width && set.color == caption.color;
  };
  if (const auto found = std::ranges::find_if(set_, same); found != set_.end()) {
    if (found->wished_px >= line_px) {
      found->last_drawn = drawn_;
      return *found;
    }
    set_.erase(found);
  }
  static WorkCounter counter("set_captions");
  const WorkScope work(counter, static_cast<long>(text.size()));
  const int wished_px = line_px;
  CaptionImage image;
  // A text that is too large for an image gets a lower resolution.
  do {
    image = set_caption(text, {line_px, width / letter * line_px, caption.color});
    line_px /= 2;
  } while (image.too_large && line_px >= 2);
  set_.push_back({text, caption.letter_deg, width, caption.color, 2 * line_px, wished_px,
                  texture_of(std::move(image.image), "captions"), drawn_});
  forget_old_captions();
  return set_.back();
}

void OverlayPass::forget_old_captions() {
  const auto texels = [&] {
    std::size_t sum = 0;
    for (const SetCaption& set : set_) {
      sum += set.texture.host.size() / 4;
    }
    return sum;
  };
  while (set_.size() > 1 && texels() > max_caption_texels) {
    const auto oldest = std::ranges::min_element(set_.begin(), set_.end() - 1, {}, &SetCaption::last_drawn);
    set_.erase(oldest);
  }
}

const PictureTiles& OverlayPass::tiles_of(const Projection& projection) {
  constexpr std::size_t max_kept = 2;
  const auto found = std::ranges::find_if(tiles_, [&](const PictureTiles& tiles) { return tiles.are_of(projection); });
  if (found != tiles_.end()) {
    return *found;
  }
  if (tiles_.size() == max_kept) {
    tiles_.erase(tiles_.begin());
  }
  return tiles_.emplace_back(projection);
}

OverlayPass::TileRows OverlayPass::draw_surface(const OverlayTarget& target, const Projection& projection,
                                                Texture& texture, OverlaySurface surface, double opacity) {
  bound_surface(surface, 2.0 * largest_pixel_angle(projection));
  const PictureTiles& tiles = tiles_of(projection);
  const std::vector<std::int32_t> numbers = tiles.within(surface);
  if (numbers.empty()) {
    return {};
  }
  const bool on_device = target.backend == Backend::cuda;
  if (on_device && texture.device.size() == 0) {
    texture.device = Buffer<std::uint16_t>(target.backend, texture.host.size(), "overlays on the GPU");
    texture.device.write(texture.host.data(), texture.host.size());
  }
  if (on_device && tile_numbers_.size() < numbers.size()) {
    tile_numbers_ = Buffer<std::int32_t>(target.backend, numbers.size(), "overlay tiles");
  }
  if (on_device) {
    tile_numbers_.write(numbers.data(), numbers.size());
  }
  launch(target.backend,
         OverlayBatch{target.rgba, converted_projection<float>(projection),
                      texture.layout.view(on_device ? texture.device.data() : texture.host.data()), surface,
                      static_cast<float>(std::clamp(opacity, 0.0, 1.0)), target.tone, target.display_colours,
                      on_device ? tile_numbers_.data() : numbers.data(), tiles.columns(),
                      static_cast<int>(numbers.size()) * overlay_tile_px * overlay_tile_px});
  return {numbers.front() / tiles.columns(), numbers.back() / tiles.columns() + 1};
}

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
