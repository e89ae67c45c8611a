#pragma once

#include "content/show/show.h"
#include "render/picture/picture.h"

// Combines two eyes' pictures into one image.

namespace ergodome {

//! Returns whether a layout keeps both eyes' pictures separate: as two files, or as two parts of
//! one file.
constexpr bool keeps_eyes_apart(StereoLayout layout) {
  return layout == StereoLayout::separate || layout == StereoLayout::multiview;
}

//! Returns whether each eye's picture fills the whole window: in its own buffer of the window, or
//! in every other row.
constexpr bool fills_window_by_eye(StereoLayout layout) {
  return layout == StereoLayout::quad_buffer || layout == StereoLayout::rows;
}

//! Returns whether both eyes' pictures keep their size: apart, beside or above each other, or each
//! filling the window (of `rows`, every other row is shown). Otherwise they are halved or mixed, or
//! only one is shown.
constexpr bool shows_eyes_whole(StereoLayout layout) {
  return keeps_eyes_apart(layout) || fills_window_by_eye(layout) || layout == StereoLayout::side_by_side ||
         layout == StereoLayout::top_bottom;
}

//! Size of an image [px].
struct ImageSize {
  int width;
  int height;

  bool operator==(const ImageSize&) const = default;
};

//! Returns the size of the image that a layout combines from two eyes' pictures of size `eye`. It
//! is `eye` itself for one picture in place of both (mono, rows, anaglyphs), and for layouts that
//! store the eyes separately (keeps_eyes_apart()). Halves are rounded up.
ImageSize layout_size(StereoLayout layout, ImageSize eye);

//! Returns the size of a layout's picture in a window. Eyes that the layout stores separately
//! (keeps_eyes_apart()) are put side by side. If each eye fills the window (fills_window_by_eye()),
//! the size is that of one eye's picture.
ImageSize window_picture_size(StereoLayout layout, ImageSize eye);

//! Arrangement of the eyes in a window's picture: one part for both, or two parts side by side or
//! one above the other.
struct EyeGrid {
  int columns = 1;
  int rows = 1;
  double across = 1.0;  //!< width of an eye's part, relative to the eye's own width
  double along = 1.0;   //!< height of an eye's part, relative to the eye's own height

  bool operator==(const EyeGrid&) const = default;
};
EyeGrid eye_grid(StereoLayout layout);

//! Combines two eyes' pictures of the same size into the image of a layout. Layouts that keep eyes
//! apart, and quad_buffer if it needs a single image, put them side by side; mono shows the left
//! eye.
//!
//! `half_side_by_side` and `half_top_bottom` average pairs of pixels (a single one at an odd end).
//! `rows` takes every other row of each eye, starting with the left eye.
//!
//! Anaglyphs are mixed from display light: the tone is applied first, and the result has none.
//! `anaglyph` shows the left eye's luminance in red and the right eye's colors in green and blue
//! ("half color", which causes less retinal rivalry than full color). `dubois` projects both eyes'
//! colors onto the light that the glasses transmit, by least squares in CIE XYZ. The matrices for
//! red and cyan are those of E. Dubois, Conversion of a Stereo Pair to Anaglyph with the
//! Least-Squares Projection Method (2009), after ICASSP 2001, p. 1661.
Picture joined_eyes(const Picture& left, const Picture& right, StereoLayout layout);

//! Copies a picture that both eyes see, for the second eye.
Picture copied_picture(const Picture& picture);

//! tint_left_eye() tints the left eye's picture red, tint_right_eye() the right eye's picture cyan,
//! so that viewers see which eye gets which.
void tint_left_eye(Picture& picture);
void tint_right_eye(Picture& picture);

}  // namespace ergodome
