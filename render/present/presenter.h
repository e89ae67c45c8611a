#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/frame/eye_renderer.h"
#include "render/output/stereo_layout.h"
#include "render/passes/overlay/caption_layer.h"

namespace ergodome {

//! A picture that is on the GPU: linear light, RGBA32F, its first row the top.
struct PresentedPicture {
  unsigned texture = 0;  //!< 0: none yet
  int width = 0;
  int height = 0;
  bool heat_map = false;  //!< colours already, to which no tone is given
  Tone tone;
  float light = 1.0F;  //!< factor on the display's light
  long version = 0;    //!< another for each picture that was handed over, or shown in another light
};

//! A picture that stayed in a GPU's memory: four floats a pixel.
struct DevicePicture {
  const float* rgba = nullptr;   //!< or the left eye's
  const float* right = nullptr;  //!< the right eye's, of the same size, where both are shown whole
  bool above = false;            //!< the left one above the right, not beside it
  int width_px = 0;              //!< of one eye's
  int height_px = 0;
  bool heat_map = false;
  Tone tone;
};

//! What of a picture is drawn: halves are those of eyes side by side. Of `halves_by_rows` each fills the framebuffer, whose rows take turns,
//! the top one the left half's.
enum class PicturePart { whole, left_half, right_half, halves_by_rows };

//! A part of a framebuffer [px], counted from its bottom left corner.
struct PictureArea {
  int left = 0;
  int bottom = 0;
  int width = 0;
  int height = 0;
};

//! Shows pictures in the current OpenGL context: uploads linear light, tone-maps and encodes it on the GPU, and fills the window with it,
//! black bars where the shapes differ. The shader computes what render/output/tone_map.h computes.
class Presenter {
 public:
  //! Needs a current OpenGL 4.5 core context, and keeps to it. Throws Error when the driver refuses the shader.
  Presenter();
  ~Presenter();
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  //! Hands over a picture from host memory; it stays until the next one.
  void upload(const Picture& picture);

  //! Hands over those of two eyes of one size, which fill one picture: beside each other, or the left one above the right.
  void upload_eyes(const Picture& left, const Picture& right, bool above);

  //! Hands over a picture from CUDA device memory, or those of two eyes, without a way through the host.
  void upload_from_device(const DevicePicture& picture);

  //! Factor on the display's light from now on, 0 to 1.
  void set_light(float light);

  //! Captions to lay over each eye of the pictures that are drawn whole, and over the halves of others; none where there is no layer. They are as sharp as the layer,
  //! whatever the picture's resolution.
  void lay_over(const LaidCaptions& captions, const EyeGrid& eyes);

  //! The picture that was handed over last. The texture is the presenter's, and valid until the next one.
  [[nodiscard]] PresentedPicture shown() const;

  //! Where a framebuffer of the given size shows the picture, or halves of it.
  [[nodiscard]] PictureArea area(int framebuffer_width, int framebuffer_height,
                                 PicturePart part = PicturePart::whole) const;

  //! Draws the picture, or halves of it, into the bound framebuffer of the given size.
  void draw(int framebuffer_width, int framebuffer_height, PicturePart part = PicturePart::whole);

  //! The bound framebuffer's pixels, RGB bytes, the top row first.
  static std::vector<std::uint8_t> read_back(int width, int height);

 private:
  struct State;
  void resize(int width, int height);
  //! Draws captions over each of the eyes that an area shows.
  void draw_captions(const PictureArea& shown, const EyeGrid& eyes);

  std::unique_ptr<State> state_;
};

}  // namespace ergodome
