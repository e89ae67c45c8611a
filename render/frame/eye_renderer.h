#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "render/backend/buffer.h"
#include "render/passes/eye_picture.h"
#include "render/passes/pass.h"
#include "render/passes/sky/sky_pass.h"
#include "render/picture/picture.h"
#include "render/picture/picture_rows.h"

// Renders the pictures of one eye or two.

namespace ergodome {

//! Requests for the pictures of two eyes, which have the same size and the same lens channels.
struct EyePair {
  EyePicture first;
  EyePicture second;
};

//! Renders the pictures of eyes: the sky and, over it, the drawing passes in order. Renders a block
//! of rows at a time, which bounds memory for any picture size. Keeps its buffers for the next
//! picture.
class EyeRenderer {
 public:
  //! `stream`: baked stations of the show, if there are any.
  explicit EyeRenderer(Backend backend, std::shared_ptr<StationStream> stream = nullptr)
      : backend_(backend), sky_(backend, std::move(stream)) {}

  //! Replaces the stream of baked stations; nullptr stops streaming.
  void set_stream(std::shared_ptr<StationStream> stream) { sky_.set_stream(std::move(stream)); }

  [[nodiscard]] Backend backend() const { return backend_; }

  //! Returns the lens of a picture with these settings, using grids that are cached from earlier
  //! pictures.
  std::unique_ptr<LensSource> lens_for(const EyeCamera& eye, const Projection& projection,
                                       const PictureSettings& settings) {
    return sky_.lens_for(eye, projection, settings);
  }

  //! Returns the number of floats allocated for lens channels.
  [[nodiscard]] std::size_t lens_floats() const { return sky_.lens_floats(); }

  Picture render(const EyeCamera& eye, const Projection& projection, const SkyCube& sky,
                 const PictureSettings& settings);

  //! Renders both eyes' pictures. On the CPU, alternates between the eyes every few rows, so that
  //! sky texels that one eye has read are still in the cache for the other, unless a pass has
  //! PassKind::serves_one_picture.
  std::vector<Picture> render_pair(const EyePair& wanted, const SkyCube& sky);

  //! Draws passes over a whole picture in host memory, with the same result as if they had been
  //! drawn while it was rendered. The passes must draw in PassDrawing::finish(); others have no
  //! effect.
  static void finish(Picture& picture, const EyePicture& wanted);

  //! Renders a picture in one piece. The picture stays in the backend's memory until the next
  //! picture, and passes may draw on it.
  BackendPicture render_in_place(const EyeCamera& eye, const Projection& projection, const SkyCube& sky,
                                 const PictureSettings& settings);

  //! Keeps the last picture rendered in place while the next one is rendered, so that the pictures
  //! of two eyes exist at the same time.
  void set_aside() { std::swap(rgba_, aside_); }

 private:
  class Making;
  using Drawings = std::vector<std::unique_ptr<PassDrawing>>;

  //! Draws the passes of PassStage::near that draw in host memory, if there are any: copies the
  //! picture to the host and back.
  void finish_in_place(const EyePicture& wanted, const Drawings& drawings);

  //! Returns a buffer for `pixels` pixels in the backend's memory.
  float* room_for(std::size_t pixels);

  Backend backend_;
  SkyPass sky_;
  Buffer<float> rgba_;
  Buffer<float> aside_;  //!< a picture kept by set_aside()
};

}  // namespace ergodome
