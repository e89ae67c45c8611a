#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "kernels/image/shade_pixels.h"
#include "kernels/image/tone_curve.h"
#include "kernels/projection/projection.h"
#include "render/backend/cached_memory.h"

// The pictures that renderers produce and outputs show or write.

namespace ergodome {

//! Ends of a heat map's color bar, in the units that are displayed.
struct ViewRange {
  double low;
  double high;
};

//! Ends of a heat map's color bar, in the units that are displayed, and whether it is logarithmic.
struct HeatRange {
  double low;
  double high;
  bool logarithmic;
};

//! Returns the default range of a heat map's color bar. It is linear for image orders and, unless
//! `logarithmic_steps` is set, for numbers of steps; otherwise logarithmic.
HeatRange heat_range(ViewMode mode, bool logarithmic_steps = false);

//! Light of a star's image, as an eye sees it.
struct StarLight {
  Vector3<float> direction;  //!< unit vector in the picture's view axes (x right, y up, z back)
  //! Linear light in units of the picture's light times a solid angle [sr].
  Vector3<float> light;
};

//! Stars that an output draws, because its pixels or view directions are not those of the picture.
struct StarLights {
  double pixel = 0.0;      //!< angle of the output's pixels, for which images are sought [rad]
  double sigma_px = 0.0;   //!< standard deviation of their spots in the output's pixels
  double cutoff_px = 0.0;  //!< radius at which spots end
  std::vector<StarLight> stars{};
};

//! One eye's picture: linear light, four floats per pixel (red, green, blue, coverage), top row
//! first.
struct Picture {
  int width = 0;
  int height = 0;
  PixelValues rgba;
  const char* lens = "";  //!< source of the lens: LensSource::name()
  //! True if the lens is that of an earlier camera position (LensSource::behind()).
  bool behind = false;
  //! Number of pixels whose rays did not converge; they show the mean of the sky.
  long unresolved_pixels = 0;
  std::optional<HeatRange> heat_range;
  Tone tone;  //!< tone settings with which the picture is to be displayed
  //! Stars that are not in the picture. If given, the fourth channel is not coverage but opacity:
  //! the fraction of the stars' light that is covered.
  std::shared_ptr<const StarLights> stars{};
};

//! A picture in the backend's memory: four floats per pixel.
struct BackendPicture {
  float* rgba = nullptr;
  const char* lens = "";  //!< source of the lens: LensSource::name()
  bool behind = false;
  std::shared_ptr<const StarLights> stars{};  //!< as in Picture
};

//! Whether an image is the whole frame or that of one eye.
enum class FramePart { whole, left, right };

//! An image to show or to write: linear light, four floats per pixel.
struct FrameImage {
  FramePart part = FramePart::whole;
  Picture picture;
  //! The face that the image shows, if each face of a cube has its own file.
  std::optional<CubeFace> face{};
};

//! Sets a picture's alpha channel to the coverage of its image: 1 inside a dome's circle, 0
//! outside, a fraction on the rim. The hole's shadow is opaque like the rest. `projection`: the
//! picture's own.
void set_image_alpha(const Projection& projection, Picture& picture);

//! A picture in GPU memory: four floats per pixel.
struct DevicePicture {
  const float* rgba = nullptr;  //!< the only picture, or the left eye's
  //! Picture of the right eye, of the same size, if both eyes' pictures are shown whole.
  const float* right = nullptr;
  //! True: the left eye's picture is above the right eye's, instead of beside it.
  bool above = false;
  int width_px = 0;  //!< width of one eye's picture
  int height_px = 0;
  bool heat_map = false;
  Tone tone;
  //! As in Picture, for both pictures.
  std::shared_ptr<const StarLights> stars{};
  std::shared_ptr<const StarLights> right_stars{};
};

}  // namespace ergodome
