#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "content/show/show.h"
#include "kernels/launch/launch.h"
#include "kernels/overlay/draw_overlay.h"
#include "render/backend/buffer.h"
#include "render/passes/overlay/caption_image.h"
#include "render/passes/overlay/caption_layer.h"
#include "render/passes/overlay/overlay_kind.h"
#include "render/passes/overlay/picture_tiles.h"
#include "render/passes/pass.h"

namespace ergodome {

//! A picture to draw overlays on, and how it will be displayed.
struct OverlayTarget {
  Backend backend = Backend::cpu;  //!< memory of `rgba`
  float* rgba = nullptr;           //!< light and coverage of the whole picture
  Tone tone;
  bool display_colours = false;  //!< true for heat maps, to which no tone is applied
};

//! Draws captions and images over finished pictures, in their display colors regardless of exposure
//! and tone. The order is: the show's images, the show's captions, its readout, captions that are
//! not part of the show.
//!
//! Reads each image once. Draws the letters of a caption when it is first visible, and again when
//! pictures need a higher resolution. Does nothing if no overlay is visible. Not thread-safe.
class OverlayPass : public Pass {
 public:
  //! Reads the images of a show. Throws Error with the show's line if one is missing or too large,
  //! a fisheye image is not square, or its width or field of view is out of range. Also throws if
  //! all images together exceed a memory limit.
  explicit OverlayPass(const Show& show);

  [[nodiscard]] const PassKind& kind() const override { return overlay_kind; }
  //! Draws the show's overlays over pictures of the sky, and other captions over all pictures.
  void finish_frame(FinishedFrame& frame) override;
  //! Images are read again, as their files may have changed.
  [[nodiscard]] bool serves(const Show& /*now*/, const Show& /*next*/) const override { return false; }
  //! Takes the captions, overlays and images of the show of `next`. Keeps the language, the
  //! captions that are not part of a show, and the texts that have been drawn to images.
  bool take(Pass& next) override;
  [[nodiscard]] std::vector<std::string> notes(const Show& show) const override;

  //! Sets the language of captions by its tag; empty: the show's default.
  void set_language(const std::string& language) { language_ = language; }

  //! Sets whether the show's captions are drawn. The show's images are always drawn.
  void set_captions(bool shown) { captions_shown_ = shown; }

  //! Replaces the captions that are not part of the show, such as a greeting or help.
  //! Caption::presence is ignored: they stay visible with this opacity until replaced.
  void set_extra(std::vector<Caption> captions, double opacity = 1.0);

  //! Sets the readout that the next picture shows; nullopt hides it. The readout is drawn only if
  //! the show's captions are drawn.
  void set_readout(std::optional<Caption> readout) { readout_ = std::move(readout); }

  //! Sets whether captions are omitted from pictures, for callers that composite caption_layer()
  //! over them.
  void set_captions_apart(bool apart) { captions_apart_ = apart; }

  //! Returns whether there may be anything to draw. `time_s`: show time; nullopt: only the readout
  //! and captions that are not part of the show are drawn.
  [[nodiscard]] bool draws_at(std::optional<double> time_s) const;

  //! Draws the overlays that are visible at a time. `projection`: overlay_projection() of the
  //! picture.
  void draw(const OverlayTarget& target, const Projection& projection, std::optional<double> time_s);

  //! Returns the captions at a time on a transparent layer; the layer is null if no caption is
  //! visible. Returns the same layer as the last call if the captions have not changed.
  LaidCaptions caption_layer(const Projection& projection, std::optional<double> time_s);

  //! Returns the memory that a show's images take [bytes], reading only their sizes. Throws Error
  //! like the constructor.
  static long image_bytes(const Show& show);

 private:
  //! An image in host memory. When the GPU first draws it, it is copied to GPU memory too.
  struct Texture {
    OverlayImage layout;  //!< size and mip levels of the image, without its texels
    Buffer<std::uint16_t> host;
    Buffer<std::uint16_t> device;
  };

  //! A range of rows of a picture's tiles, [first, end); empty if both are equal.
  struct TileRows {
    int first = 0;
    int end = 0;
  };

  //! A text whose letters have been drawn to an image.
  struct SetCaption {
    std::string text;
    double letter_deg;
    double width;  //!< angular width at which its lines break [rad]
    std::array<double, 3> color;
    int line_px;      //!< height of a line in the image [px]
    int wished_px;    //!< height of a line that was requested; `line_px` may be smaller [px]
    Texture texture;  //!< the image; width 0 if it shows nothing
    long last_drawn;
  };

  //! A caption of the layer that caption_layer() drew last, with its text in the language in which
  //! it was drawn.
  struct LayerCaption {
    std::string text;
    DomePosition position;
    double letter_deg;
    double width_deg;
    std::array<double, 3> color;
    double opacity;

    bool operator==(const LayerCaption&) const = default;
  };

  //! Returns the captions that are visible at a time, each with its opacity.
  [[nodiscard]] std::vector<std::pair<const Caption*, double>> seen_captions(std::optional<double> time_s) const;
  std::shared_ptr<const CaptionLayer> draw_layer(const Projection& projection,
                                                 const std::vector<std::pair<const Caption*, double>>& captions);

  static Texture texture_of(OverlayImage image, const char* name);
  void draw_image(const OverlayTarget& target, const Projection& projection, const Overlay& overlay, double opacity);
  TileRows draw_caption(const OverlayTarget& target, const Projection& projection, const Caption& caption,
                        double opacity);
  //! Draws one overlay and returns the rows of tiles on which it may have drawn. `surface`: the
  //! overlay's position, shape and size; its bounding cone is computed here.
  TileRows draw_surface(const OverlayTarget& target, const Projection& projection, Texture& texture,
                        OverlaySurface surface, double opacity);

  //! Returns the image of a caption's text, with a resolution that is sufficient for a picture
  //! unless the text is too large. It is valid until the next call. `width` is where lines break
  //! [rad]. `angle_of_px` is in radians.
  SetCaption& set_for(const Caption& caption, const std::string& text, double width, double angle_of_px);
  void forget_old_captions();
  const PictureTiles& tiles_of(const Projection& projection);

  std::vector<Caption> captions_;
  std::vector<Overlay> overlays_;
  std::optional<Caption> readout_;
  std::vector<Caption> extra_;
  double extra_opacity_ = 0.0;
  std::string language_;
  bool captions_shown_ = true;
  bool captions_apart_ = false;
  std::map<std::string, Texture> images_;  //!< the show's images, by their names in the show
  std::vector<SetCaption> set_;
  std::vector<PictureTiles> tiles_;  //!< tiles of the pictures, for the last two projections
  Buffer<std::int32_t> tile_numbers_;
  long drawn_ = 0;  //!< number of pictures drawn so far
  std::vector<LayerCaption> in_layer_;
  //! Tiles of the projection for which `layer_` was drawn.
  std::optional<PictureTiles> layer_tiles_;
  std::shared_ptr<const CaptionLayer> layer_;
  std::vector<float> canvas_;  //!< buffer in which layers are drawn; cleared after each layer
};

}  // namespace ergodome
