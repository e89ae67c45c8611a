#pragma once

#include <future>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "render/backend/buffer.h"
#include "render/lens/follow_lens.h"
#include "render/lens/lens_chooser.h"
#include "render/passes/disk/disk_grids.h"
#include "render/passes/disk/streamed_disk.h"
#include "render/passes/near_field/near_field.h"
#include "render/passes/objects/object_pass.h"
#include "render/passes/sky/polygon_filter.h"
#include "render/passes/sky/sky_cube.h"
#include "render/passes/stars/drawing/tiled_stars.h"
#include "render/passes/stars/star_pass.h"
#include "render/picture/picture.h"
#include "render/picture/picture_rows.h"

// Renders the pictures of one eye or two.

namespace ergodome {

//! How the view through the lens is turned into a picture.
struct PictureSettings {
  ViewMode mode = ViewMode::sky;
  SkyFilter filter = SkyFilter::ewa;
  SkyShift shift = SkyShift::none;
  bool brightening = false;                 //!< multiply the map's light by the magnification
  const PolygonFilter* polygons = nullptr;  //!< required by SkyFilter::polygon
  //! For SkyShift::blackbody_fit, in the backend's memory; the sky must be fitted.
  BlackbodyTable colours{};
  float exposure = 1.0F;
  //! The lens to use, instead of choosing one by `lens` and `accuracy`.
  const LensSource* given = nullptr;
  std::optional<FollowedRays> follow;  //!< heat maps: the rays to show, instead of those to the sky
  LensChoice lens = LensChoice::automatic;
  LensAccuracy accuracy{};
  ShowMoment moment{};
  GridScheme scheme = GridScheme::conforming;
  //! If given, stars are drawn on the sky's own view.
  StarPass* stars = nullptr;
  //! Sees stars and near field instead of the picture's eye.
  std::shared_ptr<const OmniEye> turning;
  std::shared_ptr<const TurningView> turning_view;  //!< sees `objects` instead of the picture's eye
  std::optional<Shutter> shutter;                   //!< if given, stars leave trails
  NearField near_field;                             //!< drawn over sky and stars
  ObjectPass* objects = nullptr;                    //!< if given, drawn over everything else
  double time_s = 0.0;                              //!< show time, for moving objects
  //! Stars or bloom may spread light beyond the image.
  bool clear_outside = false;
  //! For whole pictures only: render_in_place ignores it.
  std::optional<BloomSettings> bloom;
  //! Heat maps: replaces the default range; above 0 if colors are logarithmic.
  std::optional<ViewRange> range{};
};

//! Returns the range of a heat map's color bar with these settings.
HeatRange heat_range(const PictureSettings& settings);

//! Input for rendering an eye's picture.
struct EyePicture {
  EyeCamera eye;
  Projection projection;
  PictureSettings settings;
};

//! Two eyes' pictures with the same size and the same channels.
struct EyePair {
  EyePicture first;
  EyePicture second;
  bool one_projection;  //!< both have the same projection, as eyes that do not converge do
};

//! Renders eyes' pictures, a block of rows at a time, which bounds memory at any size. Keeps its
//! buffers for the next picture.
class EyeRenderer {
 public:
  //! `stream`: baked stations of the show, if there are any.
  explicit EyeRenderer(Backend backend, std::shared_ptr<StationStream> stream = nullptr)
      : backend_(backend), lenses_(backend, stream), streamed_disk_(std::move(stream)), tiled_stars_(backend) {}

  //! Replaces the stream of baked stations; nullptr stops streaming.
  void set_stream(std::shared_ptr<StationStream> stream) {
    lenses_.set_stream(stream);
    streamed_disk_ = StreamedDisk(std::move(stream));
  }

  [[nodiscard]] Backend backend() const { return backend_; }

  //! Returns the lens of a picture with these settings, using cached grids of earlier pictures.
  std::unique_ptr<LensSource> lens_for(const EyeCamera& eye, const Projection& projection,
                                       const PictureSettings& settings);

  //! Returns the floats allocated for lens channels.
  [[nodiscard]] std::size_t lens_floats() const { return lens_.size(); }

  Picture render(const EyeCamera& eye, const Projection& projection, const SkyCube& sky,
                 const PictureSettings& settings);

  //! Renders both eyes' pictures. On the CPU, alternates between them block by block: the sky that
  //! one eye has read is still in the cache for the other, and if both have grids and the same
  //! projection, each pixel is projected once.
  std::vector<Picture> render_pair(const EyePair& wanted, const SkyCube& sky);

  //! Finishes a picture as render() does: spreads light and blackens pixels outside the image, if
  //! the settings require it.
  static void finish(Picture& picture, const Projection& projection, const PictureSettings& settings);

  //! Renders a picture in one piece that stays in the backend's memory until the next picture and
  //! may be drawn on.
  PictureInPlace render_in_place(const EyeCamera& eye, const Projection& projection, const SkyCube& sky,
                                 const PictureSettings& settings);

  //! Keeps the last picture rendered in place while the next one is rendered, so that two eyes'
  //! pictures can stay.
  void set_aside() { std::swap(rgba_, aside_); }

 private:
  struct Making;

  //! Sets up a picture and its lens, without disk, shells and objects.
  void begin(Making& making, const SkyCube& sky);
  //! Makes the sky of rows, seen through the lens.
  void make_sky(Making& making, const RowBlock& rows);
  //! Makes the sky of both eyes, whose lenses share work.
  void make_sky_of_both(Making (&both)[2], const RowBlock& rows);
  //! Shades rows whose lens channels are filled.
  void light_sky(Making& making, const RowBlock& rows);
  //! Draws stars, disk, shells and objects.
  void draw_over(Making& making, const RowBlock& rows);
  //! Draws what needs the whole picture.
  static void end(Making& making);

  //! Returns the maximum number of pixels per block.
  [[nodiscard]] std::size_t block_pixels(const Projection& projection) const;
  template <class Visit>
  void visit_blocks(const Projection& projection, const Visit& visit) const;

  //! Allocates lens channels for `pixels` and sets up the shading, except for its output.
  ShadeBatch prepare(const Projection& projection, const SkyCube& sky, const PictureSettings& settings,
                     std::size_t pixels);

  //! Returns memory for `pixels` in the backend's memory.
  float* room_for(std::size_t pixels);

  //! Shades rows whose lens channels are filled. `polygons`: if the sky is filtered by polygons.
  void shade_rows(ShadeBatch& shade, const PolygonFilter* polygons, const RowBlock& rows);

  //! Starts the search for the images of stars in a picture. The arguments must outlive the search.
  std::future<FoundPoints> seek_stars(const EyeCamera& eye, const Projection& projection,
                                      const PictureSettings& settings) const;

  //! Copies stars to the memory in which the picture is made.
  void place_stars(const FoundPoints& stars, const Projection& projection, const PictureSettings& settings);

  //! Returns the near field of a picture, with a grid for its disk if that is worth building.
  NearField near_field_of(const EyeCamera& eye, const Projection& projection, const PictureSettings& settings);

  //! Draws the near field, if there is any, over rows of a picture in the backend's memory.
  void draw_near_rows(const EyeCamera& eye, const Projection& projection, const PictureSettings& settings,
                      const RowBlock& rows, float* rgba) const;

  //! Draws stars and near field over rows of the sky in rgba_ or, on the CPU, in `light`.
  void draw_over_rows(const EyeCamera& eye, const Projection& projection, const PictureSettings& settings,
                      const FoundPoints& stars, const RowBlock& rows, float* light);

  //! Counts rays that did not converge, from error estimates in the backend's memory.
  long count_unresolved(const float* estimates, std::size_t pixels) const;

  //! Draws objects over the whole of rgba_. They are rendered by another driver, and are composited
  //! in host memory.
  void draw_objects_in_place(const EyeCamera& eye, const Projection& projection, const PictureSettings& settings);

  //! Filters the map over the pixels' outlines, on the CPU: copies channels from the GPU and the
  //! light back.
  void filter_polygons(const ShadeBatch& shade, const PolygonFilter& polygons);

  //! Allocates only the channels that the picture needs. `second`: in addition to another eye's.
  LensPixels channels(std::size_t pixels, const PictureSettings& settings, bool second = false);

  Backend backend_;
  LensChooser lenses_;
  DiskGrids disk_grids_;
  StreamedDisk streamed_disk_;
  NearField near_field_;  //!< of the current picture
  TiledStars tiled_stars_;
  Buffer<float> lens_;
  Buffer<float> second_lens_;  //!< of the other eye, if both are read together
  Buffer<float> rgba_;
  Buffer<float> aside_;  //!< a picture to keep
};

}  // namespace ergodome
