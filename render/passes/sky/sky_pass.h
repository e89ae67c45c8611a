#pragma once

#include <memory>
#include <optional>

#include "kernels/image/shade_pixels.h"
#include "render/backend/buffer.h"
#include "render/lens/lens_chooser.h"
#include "render/passes/eye_picture.h"
#include "render/picture/picture.h"
#include "render/picture/picture_rows.h"

namespace ergodome {

//! Draws the first layer of every picture: the sky, or a heat map of the lens. Owns the lens
//! channels, and caches lenses for the next picture.
class SkyPass {
 public:
  SkyPass(Backend backend, std::shared_ptr<StationStream> stream)
      : backend_(backend), lenses_(backend, std::move(stream)) {}

  //! Replaces the stream of baked stations; nullptr stops streaming.
  void set_stream(std::shared_ptr<StationStream> stream) { lenses_.set_stream(std::move(stream)); }

  //! Returns the lens of a picture, using grids cached from earlier pictures.
  std::unique_ptr<LensSource> lens_for(const EyeCamera& eye, const Projection& projection,
                                       const PictureSettings& settings);

  //! Returns the number of floats allocated for lens channels.
  [[nodiscard]] std::size_t lens_floats() const { return lens_.size(); }

 private:
  friend class SkyDrawing;

  //! Returns pointers to the channels that a picture needs; the others are null.
  LensPixels channels(std::size_t pixels, const PictureSettings& settings);

  Backend backend_;
  LensChooser lenses_;
  Buffer<float> lens_;
};

//! Draws the sky of one picture.
class SkyDrawing {
 public:
  //! Chooses the lens of the picture, and makes room for the channels of `max_rows` rows. The
  //! arguments must outlive the drawing.
  SkyDrawing(SkyPass& pass, const EyePicture& picture, const SkyCube& sky, int max_rows);

  [[nodiscard]] const LensSource& lens() const { return *lens_; }
  //! Renders rows of the picture into the backend's memory: four floats per pixel.
  void draw(const RowBlock& rows, float* rgba);

  //! Returns the number of rays of the last drawn rows that did not converge.
  [[nodiscard]] long count_unresolved() const;

 private:
  //! Selects the rows that are shaded next, and their memory.
  void aim(const RowBlock& rows, float* rgba);
  //! Shades the selected rows, whose lens channels are filled.
  void shade();
  //! Filters the map over the outlines of pixels, on the CPU. For a GPU backend, copies the
  //! channels to the host, and the resulting light back.
  void filter_polygons(const PolygonFilter& polygons) const;

  SkyPass& pass_;
  const EyePicture& picture_;
  int max_rows_;
  ShadeBatch shade_;
  std::unique_ptr<LensSource> chosen_;
  const LensSource* lens_;
  bool shaded_by_lens_ = false;  //!< LensSource::shade() drew the last rows
};

//! Returns the value range of a heat map's color bar for a picture's settings.
HeatRange heat_range(const PictureSettings& settings);

}  // namespace ergodome
