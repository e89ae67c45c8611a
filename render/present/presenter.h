#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/output/stereo_layout.h"
#include "render/passes/overlay/caption_layer.h"
#include "render/picture/picture.h"

// Shows pictures in an OpenGL window.

namespace ergodome {

//! A picture on the GPU: linear light, RGBA32F, top row first. Not for a presenter that encodes
//! pictures before they are uploaded.
struct PresentedPicture {
  unsigned texture = 0;  //!< 0: none yet
  int width = 0;
  int height = 0;
  bool heat_map = false;  //!< true: values are display colors, to which no tone is applied
  Tone tone;
  float light = 1.0F;  //!< factor on the display's light
  long version = 0;    //!< number that changes with each picture and each change of the light
};

//! The part of a picture to draw. `left_half` and `right_half` are eyes in a picture that has them
//! side by side. With `halves_by_rows`, both halves fill the whole framebuffer in alternate rows.
//! The top row is the left half's.
enum class PicturePart { whole, left_half, right_half, halves_by_rows };

//! A part of a framebuffer [px], from its bottom left corner.
struct PictureArea {
  int left = 0;
  int bottom = 0;
  int width = 0;
  int height = 0;
};

//! Shows pictures in the current OpenGL context: uploads linear light, tone-maps and encodes it on
//! the GPU, and fits it into the window with black bars. The shader computes the same values as
//! render/output/tone_map.h, except where a presenter encodes pictures before they are uploaded.
class Presenter {
 public:
  //! Uses the OpenGL 4.5 core context that is current. Throws Error if the driver rejects the
  //! shader.
  Presenter();
  ~Presenter();
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  //! Lets the CPU tone-map and encode pictures from host memory before they are uploaded. For drivers
  //! that draw in software, whose shaders take several times as long. If a picture is not as wide
  //! as the window, encoded values are interpolated instead of light.
  void encode_before_upload();

  //! Uploads a picture from host memory. It is shown until the next one is uploaded.
  void upload(const Picture& picture);

  //! Uploads two eyes' pictures of the same size as one picture: side by side, or the left one
  //! above the right one.
  void upload_eyes(const Picture& left, const Picture& right, bool above);

  //! Copies a picture, or two eyes' pictures, from CUDA memory without a copy through the host.
  //! Throws Error if CUDA fails.
  void upload_from_device(const DevicePicture& picture);

  //! Sets the factor on the display's light, 0 to 1.
  void set_light(float light);

  //! Sets the captions that are drawn over each eye, as arranged by `eyes` in pictures that are
  //! drawn whole, and over each half of other pictures. Without a layer, removes them. Captions
  //! have the layer's resolution, whatever the picture's.
  void lay_over(const LaidCaptions& captions, const EyeGrid& eyes);

  //! Returns the last picture. The presenter owns the texture, which is valid until the next
  //! picture.
  [[nodiscard]] PresentedPicture shown() const;

  //! Returns the area of a framebuffer of the given size in which the picture, or halves of it, are
  //! shown; 0 x 0 before the first picture.
  [[nodiscard]] PictureArea area(int framebuffer_width, int framebuffer_height,
                                 PicturePart part = PicturePart::whole) const;

  //! Draws the picture, or halves of it, into the bound framebuffer of the given size.
  void draw(int framebuffer_width, int framebuffer_height, PicturePart part = PicturePart::whole);

 private:
  struct State;
  void resize(int width, int height, bool encoded);
  //! Draws captions over each eye in an area.
  void draw_captions(const PictureArea& shown, const EyeGrid& eyes);

  std::unique_ptr<State> state_;
};

}  // namespace ergodome
