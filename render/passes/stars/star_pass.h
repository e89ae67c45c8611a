#pragma once

#include <memory>
#include <optional>

#include "content/show/show.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/grid/grid_tracer.h"
#include "render/passes/effects/diffraction.h"
#include "render/passes/pass.h"
#include "render/passes/stars/camera_course.h"
#include "render/passes/stars/drawing/blackbody_colours.h"
#include "render/passes/stars/drawing/point_placer.h"
#include "render/passes/stars/drawing/star_splat.h"
#include "render/passes/stars/drawing/tiled_stars.h"
#include "render/passes/stars/gather/star_gather.h"
#include "render/passes/stars/position_cells.h"
#include "render/passes/stars/search/image_joiner.h"
#include "render/passes/stars/search/star_finder.h"
#include "render/passes/stars/star_image_cache.h"
#include "render/passes/stars/star_kind.h"

namespace ergodome {

//! Luminance of picture value 1 before exposure [cd/m²]. With it, the mean of the built-in Milky
//! Way over the sky equals the light of all faint stars (about 85 stars of magnitude 10 per square
//! degree); its brightest clouds have 20 mag per square arcsecond.
inline constexpr double luminance_of_white = 0.0114;

//! Which earlier results a picture may reuse: `exact` requires results for the same pixel size, so
//! that pictures do not depend on earlier ones; `about` also accepts a similar pixel size, so that
//! a window may be resized.
enum class PixelMatch { exact, about };

//! Points of light of a picture, in host memory or in the memory of the rendering backend.
struct FoundPoints {
  std::vector<StarPoint> in_host;
  PlacedPoints in_place;

  [[nodiscard]] bool empty() const { return in_host.empty() && in_place.count == 0; }
};

//! Draws the stars of a show. Caches the last inverted lens grids: a camera that rotates or moves
//! around the spin axis needs no new grid. If the camera only rotates, the images of the last
//! picture are used again, too. A camera that moves slowly uses one grid for a cell of positions
//! (PositionCells).
class StarPass : public Pass {
 public:
  //! Loads the catalog. Throws Error if it cannot be read. On a GPU backend, images are also sought
  //! on the GPU.
  explicit StarPass(const Show& show, Backend backend = Backend::cpu);

  [[nodiscard]] const PassKind& kind() const override { return star_kind; }
  std::unique_ptr<PassDrawing> prepare(const EyePicture& picture) override;
  void apply(const Show& show, const NumberChange& change) override;
  [[nodiscard]] bool serves(const Show& now, const Show& next) const override;
  [[nodiscard]] std::vector<std::string> notes(const Show& show) const override;

  //! Returns whether the catalog contains no star.
  [[nodiscard]] bool empty() const { return field_.stars().empty(); }

  //! Returns the rows of the catalog file that were skipped.
  [[nodiscard]] const std::vector<RowsLeftOut>& left_out() const { return left_out_; }

  //! Applies the animatable numbers of a show (content/show/animatable_number.h) except for the rotation
  //! of the sky. The show must differ from the first one in these numbers only.
  void set_numbers(const Show& show);

  //! Rotates the stars as `show` requires, which must differ from the first show in numbers only.
  //! Keeps lens grids and patches, because patches depend only on the brightness of the stars. The
  //! first call loads the catalog, which is then kept in memory.
  void turn_sky(const Show& show);

  //! Finds the star images of an eye, and their trails if there is a shutter. The images are exact,
  //! whatever lens method the map uses.
  std::vector<StarPoint> find(const StarEye& eye, const Projection& projection, const std::optional<Shutter>& shutter,
                              PixelMatch match = PixelMatch::exact, const CameraCourse& course = {});

  //! Finds the same images as find(), but leaves them in GPU memory if they are found there and
  //! have no trails. Results in GPU memory are valid until the next call.
  FoundPoints find_points(const StarEye& eye, const Projection& projection, const std::optional<Shutter>& shutter,
                          PixelMatch match, const CameraCourse& course);

  //! Finds the star images of an eye for an output that draws them (Picture::stars). `pixel`: angle
  //! of its pixels [rad].
  StarLights lights(const StarEye& eye, const Projection& projection, double pixel, PixelMatch match,
                    const CameraCourse& course);

  //! splat_for() returns how points are drawn for a projection. spikes() returns the pattern of
  //! spikes, nullptr if the show has none.
  [[nodiscard]] SplatSettings splat_for(const Projection& projection) const { return scaled_to(splat_, projection); }
  [[nodiscard]] const DiffractionPattern* spikes() const { return spikes_ ? &*spikes_ : nullptr; }

  //! Adds the points to rows of a picture in host memory. TiledStars draws in GPU memory.
  void draw(const std::vector<StarPoint>& points, const Projection& projection, int first_row, int row_count,
            float* rgba) const;

 private:
  class Drawing;
  class ApartDrawing;

  StarPass(const Show& show, Backend backend, const StarCatalogue& catalogue);

  //! Returns the search settings for a picture.
  [[nodiscard]] StarSettings settings_for(const StarEye& eye, const Projection& projection, bool leaves_trails,
                                          PixelMatch match, const CameraCourse& course) const;

  //! Returns whether each pixel gathers its stars: because the show requests it, or because the
  //! lens grid displaces the shadow's edge and thus the images beside it.
  [[nodiscard]] bool gathers(const StarEye& eye, double pixel);

  //! Returns the images that `settings` asks for, of the last pictures if possible. The reference is
  //! valid until the next call.
  const std::vector<StarImage>& images_of(const StarEye& eye, const Projection& projection,
                                          const StarSettings& settings);
  std::vector<StarImage> sought_images(const StarEye& eye, const StarSettings& settings);
  PlacedImages sought_in_place(const StarEye& eye, const StarSettings& settings);
  std::vector<StarImage> gathered_images(const StarEye& eye, const Projection& projection,
                                         const StarSettings& settings);
  void draw_spikes(const std::vector<StarPoint>& points, const Projection& projection, int first_row, int row_count,
                   float* rgba) const;

  void make_pattern(const Show& show);

  //! An inverted lens grid with the parameters for which it was computed.
  struct InvertedGrid {
    StarEye eye;
    double pixel;
    double min_cell_px;
    float faintest;  //!< threshold for which the patches were computed [lx]
    LensStation station;
    StarPatches patches;
    bool moved = false;  //!< the patches were moved from the middle of a cell
    std::unique_ptr<PlacedPatches> on_device{};
  };

  void place(InvertedGrid& turned) const;

  const InvertedGrid& patches_for(const StarEye& eye, const StarSettings& settings);

  void search_field();

  Backend backend_;
  BlackbodyColours colours_;
  std::optional<StarCatalogue> catalogue_;  //!< the catalog; loaded when the sky is first rotated
  std::vector<RowsLeftOut> left_out_;
  StarField field_;
  EdgeMiss edge_miss_;
  bool all_gathered_;                  //!< true if the show selects StarMethod::gather
  std::optional<StarTree> tree_;       //!< present if pixels gather stars
  std::optional<PatchSearch> search_;  //!< GPU search; set only on a GPU backend
  StarSettings settings_;
  PointOrder order_;  //!< order of the points that find() returns
  SplatSettings splat_;
  std::optional<DiffractionPattern> spikes_;    //!< present if the show has spikes at any time
  std::optional<DiffractionSettings> pattern_;  //!< settings from which `spikes_` was computed
  GridTracer<float> tracer_;
  std::vector<InvertedGrid> turned_;  //!< inverted grids of the last eyes, most recent first
  PositionCells cells_;
  PatchRoom room_;
  StarImageCache<std::vector<StarImage>> images_;
  StarImageCache<PlacedImages> images_in_place_;
  std::vector<StarImage> gathered_;  //!< images that pixels gathered, of the last picture
  //! Merges images that a GPU found; set only on a GPU backend.
  std::optional<ImageJoiner> joiner_;
  std::optional<PointPlacer> placer_;
  TiledStars tiled_;  //!< points of one picture; only on a GPU backend
};

}  // namespace ergodome
