#pragma once

#include "content/show/show.h"
#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Whether the pictures of both eyes stay two: in files of their own, or as the parts of one.
constexpr bool keeps_eyes_apart(StereoLayout layout) {
  return layout == StereoLayout::separate || layout == StereoLayout::multiview;
}

//! Whether each eye's picture fills a window by itself: in a buffer of its own, or in every other of the window's rows.
constexpr bool fills_window_by_eye(StereoLayout layout) {
  return layout == StereoLayout::quad_buffer || layout == StereoLayout::rows;
}

//! Whether a window is given both eyes' pictures whole, beside or above each other.
constexpr bool shows_eyes_whole(StereoLayout layout) {
  return keeps_eyes_apart(layout) || fills_window_by_eye(layout) || layout == StereoLayout::side_by_side ||
         layout == StereoLayout::top_bottom;
}

//! Width and height of an image [px].
struct ImageSize {
  int width;
  int height;

  bool operator==(const ImageSize&) const = default;
};

//! Size of the image that a layout makes of eyes of a size; layouts that keep eyes apart leave it. Halves are rounded up.
ImageSize layout_size(StereoLayout layout, ImageSize eye);

//! The size of the picture that a window shows of a layout: eyes that stay apart are beside each other there, and those that fill
//! the window are as large as one.
ImageSize window_picture_size(StereoLayout layout, ImageSize eye);

//! How eyes share what a window shows: one for both, or beside or above each other.
struct EyeGrid {
  int columns = 1;
  int rows = 1;
  double across = 1.0;  //!< how wide an eye's picture is, of its own width
  double along = 1.0;   //!< and how high

  bool operator==(const EyeGrid&) const = default;
};
EyeGrid eye_grid(StereoLayout layout);

//! The image that a layout makes of two eyes' pictures of one size. Layouts whose eyes stay apart, and quad_buffer where it needs one
//! image, are put side by side; mono shows the left eye.
//!
//! The halves of `half_side_by_side` and `half_top_bottom` are means of two pixels each (of one at an odd end). `rows` takes every other
//! row of each eye, the left eye's first.
//!
//! Anaglyphs are mixed of light as a display shows it: the tone is applied before, and the result has none left. `anaglyph` gives red to
//! the left eye's luminance, green and blue to the right one's colours ("half colour": it fights less between the eyes than colour does).
//! `dubois` projects both eyes' colours on what glasses let through, by least squares in CIE XYZ; the matrices for red and cyan are those
//! of E. Dubois, Conversion of a Stereo Pair to Anaglyph with the Least-Squares Projection Method (2009), after ICASSP 2001, p. 1661.
Picture joined_eyes(const Picture& left, const Picture& right, StereoLayout layout);

//! The picture that both eyes see, for the other eye.
Picture copied_picture(const Picture& picture);

//! Turns the left eye's picture reddish or the right one's cyan, so that a person sees which eye gets which.
void tint_left_eye(Picture& picture);
void tint_right_eye(Picture& picture);

}  // namespace ergodome
