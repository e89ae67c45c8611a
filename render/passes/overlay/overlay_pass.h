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
#include "render/passes/overlay/picture_tiles.h"

namespace ergodome {

//! A picture to draw overlays on, and how it will be shown.
struct OverlayTarget {
  Backend backend = Backend::cpu;  //!< where `rgba` lies
  float* rgba = nullptr;           //!< light and coverage of the whole picture
  Tone tone;
  bool display_colours = false;  //!< a heat map's, which no tone comes on
};

//! Draws captions and images over finished pictures, in the colours that they have on a display, whatever the exposure and the tone. In order: the
//! show's images, its captions, then captions that others give.
//!
//! Images are read once; a text is set when it is first seen, and again when pictures need finer letters. Where nothing is to be seen nothing is
//! done. All of it belongs to one thread at a time.
class OverlayPass {
 public:
  //! Reads the images of a show. Throws Error, with the show's line, where one is missing, too large, or no domemaster, or a number makes no
  //! sense.
  explicit OverlayPass(const Show& show);

  //! Goes on with another show, in the same language and with the same extra captions. Throws Error like the constructor, and keeps the old.
  void set_show(const Show& show);

  //! The language of captions, by its tag; empty: the show's own.
  void set_language(const std::string& language) { language_ = language; }

  //! Whether the show's captions are drawn. Images are, always.
  void set_captions(bool shown) { captions_shown_ = shown; }

  //! Captions that do not come from the show, in place of those given before: a greeting, help. Their presence does not count: they are there,
  //! with this opacity, until others are set.
  void set_extra(std::vector<Caption> captions, double opacity = 1.0);

  //! Sets the show's readout of the picture that is drawn next; none where it is not to be seen. It goes with the show's captions.
  void set_readout(std::optional<Caption> readout) { readout_ = std::move(readout); }

  //! Whether captions are left out of pictures, for whoever shows caption_layer() over them.
  void set_captions_apart(bool apart) { captions_apart_ = apart; }

  //! Whether there may be anything to draw. `time_s`: of the show; none: only what does not come from it.
  [[nodiscard]] bool draws_at(std::optional<double> time_s) const;

  //! Draws what is to be seen at a time. `projection`: overlay_projection() of the picture.
  void draw(const OverlayTarget& target, const Projection& projection, std::optional<double> time_s);

  //! Captions at a time, on nothing; none where there is nothing to see. The last layer is given again where it would be the same.
  LaidCaptions caption_layer(const Projection& projection, std::optional<double> time_s);

  //! Bytes that a show's images take, from their files' sizes alone. Throws Error like the constructor.
  static long image_bytes(const Show& show);

 private:
  //! An image where kernels reach it; on a device from when it is first drawn there.
  struct Texture {
    OverlayImage layout;  //!< without its texels
    Buffer<std::uint16_t> host;
    Buffer<std::uint16_t> device;
  };

  //! Rows of a picture's tiles, [first, end); none where these are equal.
  struct TileRows {
    int first = 0;
    int end = 0;
  };

  //! A text that has been set.
  struct SetCaption {
    std::string text;
    double letter_deg;
    double width;  //!< where its lines are broken [rad]
    std::array<double, 3> color;
    int line_px;      //!< height of its lines
    int wished_px;    //!< what that was to be
    Texture texture;  //!< of no width: nothing to see
    long last_drawn;
  };

  //! A caption as the last layer shows it, in its language.
  struct LayerCaption {
    std::string text;
    DomePlace place;
    double letter_deg;
    double width_deg;
    std::array<double, 3> color;
    double opacity;

    bool operator==(const LayerCaption&) const = default;
  };

  //! Captions that are seen at a time, with their opacity.
  [[nodiscard]] std::vector<std::pair<const Caption*, double>> seen_captions(std::optional<double> time_s) const;
  std::shared_ptr<const CaptionLayer> draw_layer(const Projection& projection,
                                                 const std::vector<std::pair<const Caption*, double>>& captions);

  static Texture texture_of(OverlayImage image, const char* name);
  void draw_image(const OverlayTarget& target, const Projection& projection, const Overlay& overlay, double opacity);
  TileRows draw_caption(const OverlayTarget& target, const Projection& projection, const Caption& caption,
                        double opacity);
  //! Returns the rows of tiles that it may have drawn on.
  TileRows draw_sheet(const OverlayTarget& target, const Projection& projection, Texture& texture, OverlaySheet sheet,
                      double opacity);

  //! The text of a caption, set finely enough for a picture.
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
  std::map<std::string, Texture> images_;  //!< by their names in the show
  std::vector<SetCaption> set_;
  std::vector<PictureTiles> tiles_;  //!< of the eyes' pictures
  Buffer<std::int32_t> tile_numbers_;
  long drawn_ = 0;  //!< pictures
  std::vector<LayerCaption> in_layer_;
  std::optional<PictureTiles> layer_tiles_;  //!< of the last layer's projection
  std::shared_ptr<const CaptionLayer> layer_;
  std::vector<float> canvas_;  //!< that layers are cut out of: nothing but while one is drawn
};

}  // namespace ergodome
