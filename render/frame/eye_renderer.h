#pragma once

#include <future>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "render/backend/buffer.h"
#include "render/lens/follow_lens.h"
#include "render/lens/lens_chooser.h"
#include "render/output/tone.h"
#include "render/passes/disk/disk_grids.h"
#include "render/passes/disk/streamed_disk.h"
#include "render/passes/near_field/near_field.h"
#include "render/passes/objects/object_pass.h"
#include "render/passes/sky/polygon_filter.h"
#include "render/passes/sky/sky_cube.h"
#include "render/passes/stars/drawing/tiled_stars.h"
#include "render/passes/stars/star_pass.h"
#include "render/picture/pixel_values.h"

namespace ergodome {

//! Ends of a heat map's colours, as numbers that a person reads.
struct ViewRange {
  double low;
  double high;
};

//! How a picture is made of what the lens shows.
struct PictureSettings {
  ViewMode mode = ViewMode::sky;
  SkyFilter filter = SkyFilter::ewa;
  SkyShift shift = SkyShift::none;
  bool brightening = false;                 //!< the map's light is multiplied by the magnification
  const PolygonFilter* polygons = nullptr;  //!< for SkyFilter::polygon, which needs it
  BlackbodyTable colours{};  //!< for SkyShift::blackbody_fit, in the backend's memory; the sky must be fitted
  float exposure = 1.0F;
  const LensSource* given = nullptr;   //!< the lens itself, in place of what `lens` and `accuracy` ask for
  std::optional<FollowedRays> follow;  //!< of heat maps: which rays they show, in place of the sky's
  LensChoice lens = LensChoice::automatic;
  LensAccuracy accuracy{};
  ShowMoment moment{};
  GridScheme scheme = GridScheme::conforming;
  StarPass* stars = nullptr;                        //!< drawn where they are given, on the sky's own view
  std::shared_ptr<const OmniEye> turning;           //!< what sees them and the near field in place of the picture's eye
  std::shared_ptr<const TurningView> turning_view;  //!< the same for `objects`
  std::optional<Shutter> shutter;                   //!< stars leave trails
  NearField near_field;                             //!< drawn over sky and stars
  ObjectPass* objects = nullptr;                    //!< drawn where they are given, over all that
  double time_s = 0.0;                              //!< of the show, for what moves in it
  bool clear_outside = false;                       //!< stars or bloom may spread light beyond the image
  std::optional<BloomSettings> bloom;               //!< of whole pictures alone: render_in_place leaves it out
  std::optional<ViewRange> range{};  //!< of heat maps: in place of the usual one; above 0 where colours are logarithmic
};

//! Rows of a picture that are worked on at a time: memory stays bounded at any size.
int rows_of_a_block(Backend backend, int width_px, int height_px);
//! And of these, that are worked on at a time where both eyes' skies are made in turn.
int rows_of_a_strip(int width_px);

//! Ends of a heat map's colour bar, as numbers that a person reads, and whether it is logarithmic between them.
struct HeatRange {
  double low;
  double high;
  bool logarithmic;
};

//! A picture of one eye: linear light, four floats a pixel (red, green, blue, coverage), the top row first.
struct Picture {
  int width = 0;
  int height = 0;
  PixelValues rgba;
  const char* lens = "";       //!< where the lens came from: LensSource::name()
  bool behind = false;         //!< LensSource::behind()
  long unresolved_pixels = 0;  //!< rays that did not converge: shown as the mean of the sky
  std::optional<HeatRange> heat_range;
  Tone tone;  //!< how it is to be shown
};

//! A picture that stayed in the backend's memory: four floats a pixel.
struct PictureInPlace {
  float* rgba = nullptr;
  const char* lens = "";  //!< as in Picture
  bool behind = false;
};

//! A picture that an eye is to have.
struct EyePicture {
  EyeCamera eye;
  Projection projection;
  PictureSettings settings;
};

//! Pictures of two eyes, of one size and of the same channels.
struct EyePair {
  EyePicture first;
  EyePicture second;
  bool one_projection;  //!< both have: eyes that converge have not
};

//! Renders eyes, a block of rows at a time, so that memory stays bounded at any size. Keeps its buffers from picture to picture.
class EyeRenderer {
 public:
  //! `stream`: baked stations of the show that the pictures are of, if there are any.
  explicit EyeRenderer(Backend backend, std::shared_ptr<StationStream> stream = nullptr)
      : backend_(backend), lenses_(backend, stream), streamed_disk_(std::move(stream)), tiled_stars_(backend) {}

  //! Streams from other stations from now on, or from none.
  void set_stream(std::shared_ptr<StationStream> stream) {
    lenses_.set_stream(stream);
    streamed_disk_ = StreamedDisk(std::move(stream));
  }

  [[nodiscard]] Backend backend() const { return backend_; }

  //! The lens that a picture with these settings is drawn through; with the grids that earlier pictures left.
  std::unique_ptr<LensSource> lens_for(const EyeCamera& eye, const Projection& projection,
                                       const PictureSettings& settings);

  //! Floats that are kept for the lens of pictures: what their channels take.
  [[nodiscard]] std::size_t lens_floats() const { return lens_.size(); }

  Picture render(const EyeCamera& eye, const Projection& projection, const SkyCube& sky,
                 const PictureSettings& settings);

  //! Both eyes' pictures. On the processor they are made block by block in turn: what the projection does to each pixel is done once where both
  //! have a grid and one projection, and the sky that one eye has read is still near for the other.
  std::vector<Picture> render_pair(const EyePair& wanted, const SkyCube& sky);

  //! Spreads light and blackens what is outside the image as far as the settings say so: the end of render().
  static void finish(Picture& picture, const Projection& projection, const PictureSettings& settings);

  //! The same in one piece that stays in the backend's memory until the next picture, and may be drawn on.
  PictureInPlace render_in_place(const EyeCamera& eye, const Projection& projection, const SkyCube& sky,
                                 const PictureSettings& settings);

  //! Keeps the picture that was rendered in place until the one after the next: two eyes' may stay.
  void set_aside() { std::swap(rgba_, aside_); }

 private:
  struct Making;

  //! Sets a picture up, its lens and all, but for what stands near the hole.
  void begin(Making& making, const SkyCube& sky);
  //! The sky of rows, through the lens.
  void make_sky(Making& making, const RowBlock& rows);
  //! The same for both eyes, where their lenses share work.
  void make_sky_of_both(Making (&both)[2], const RowBlock& rows);
  //! What comes after the lens.
  void light_sky(Making& making, const RowBlock& rows);
  //! Stars, and what stands near the hole.
  void draw_over(Making& making, const RowBlock& rows);
  //! Draws what is drawn on whole pictures.
  static void end(Making& making);

  //! Pixels that are worked on at a time, at the most.
  [[nodiscard]] std::size_t block_pixels(const Projection& projection) const;
  template <class Visit>
  void visit_blocks(const Projection& projection, const Visit& visit) const;

  //! Makes room for the lens of `pixels` and sets up the shading, but for where the light goes.
  ShadeBatch prepare(const Projection& projection, const SkyCube& sky, const PictureSettings& settings,
                     std::size_t pixels);

  //! Room for `pixels` in the backend's memory.
  float* room_for(std::size_t pixels);

  //! Turns rows whose lens is there into light. `polygons`: where the sky is filtered by them.
  void shade_rows(ShadeBatch& shade, const PolygonFilter* polygons, const RowBlock& rows);

  //! Seeks the images of stars that a picture shows. What is given has to outlive the search.
  std::future<FoundPoints> seek_stars(const EyeCamera& eye, const Projection& projection,
                                      const PictureSettings& settings) const;

  //! Brings stars to where the picture is made.
  void place_stars(const FoundPoints& stars, const Projection& projection, const PictureSettings& settings);

  //! What stands near the hole in a picture, with the grid that its disk is read from where that is worth its while.
  NearField near_field_of(const EyeCamera& eye, const Projection& projection, const PictureSettings& settings);

  //! Draws what stands near the hole over rows of a picture in the backend's memory, where it has any.
  void draw_near_rows(const EyeCamera& eye, const Projection& projection, const PictureSettings& settings,
                      const RowBlock& rows, float* rgba) const;

  //! Draws stars and what stands near the hole over rows whose sky is in rgba_, or on the processor in `light`: there they end up.
  void draw_over_rows(const EyeCamera& eye, const Projection& projection, const PictureSettings& settings,
                      const FoundPoints& stars, const RowBlock& rows, float* light);

  //! Rays that did not converge, by what the backend's memory says of errors.
  long count_unresolved(const float* estimates, std::size_t pixels) const;

  //! Draws objects over the whole of rgba_; they come from another driver than the picture, and lie over it in host memory.
  void draw_objects_in_place(const EyeCamera& eye, const Projection& projection, const PictureSettings& settings);

  //! Filters the map over the pixels' outlines, on the processor: channels of a GPU come over, and the light goes back.
  void filter_polygons(const ShadeBatch& shade, const PolygonFilter& polygons);

  //! Makes room for the channels that the picture calls for, and no others; `second`: beside another eye's.
  LensPixels channels(std::size_t pixels, const PictureSettings& settings, bool second = false);

  Backend backend_;
  LensChooser lenses_;
  DiskGrids disk_grids_;
  StreamedDisk streamed_disk_;
  NearField near_field_;  //!< of the picture in hand
  TiledStars tiled_stars_;
  Buffer<float> lens_;
  Buffer<float> second_lens_;  //!< of the other eye, where both are read at once
  Buffer<float> rgba_;
  Buffer<float> aside_;  //!< a picture that stays
};

//! The range of a heat map's colour bar; of steps, for ways to follow rays that differ by orders of magnitude, a logarithmic one.
HeatRange heat_range(ViewMode mode, bool logarithmic_steps = false);
HeatRange heat_range(const PictureSettings& settings);

}  // namespace ergodome
