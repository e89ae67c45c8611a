#pragma once

#include <memory>
#include <optional>

#include "content/show/show.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/grid/grid_tracer.h"
#include "render/passes/effects/diffraction.h"
#include "render/passes/stars/drawing/blackbody_colours.h"
#include "render/passes/stars/drawing/point_placer.h"
#include "render/passes/stars/drawing/star_splat.h"
#include "render/passes/stars/kept_star_images.h"
#include "render/passes/stars/search/image_joiner.h"
#include "render/passes/stars/search/star_finder.h"
#include "render/passes/stars/star_gather.h"

namespace ergodome {

//! Luminance that a picture value of 1 stands for, before exposure [cd/m²]: the built-in Milky Way, whose mean over the sky is then the
//! light of all faint stars together (some 85 stars of magnitude 10 a square degree), its brightest clouds 20 mag a square arcsecond.
inline constexpr double luminance_of_white = 0.0114;

//! What pictures before may lend one: what was found for its own pixels, so that it hangs on none of them, or for about such pixels, so that a window may
//! change its size.
enum class PixelMatch { exact, about };

//! Points that a picture shows: in host memory, or in place on the device where it is made.
struct FoundPoints {
  std::vector<StarPoint> in_host;
  PlacedPoints in_place;

  [[nodiscard]] bool empty() const { return in_host.empty() && in_place.count == 0; }
};

//! Draws the stars of a show. Keeps the last lens grids turned round: a camera that turns, moves otherwise or goes round the axis needs
//! no new one. One that only turns has the images of the last picture, too.
class StarPass {
 public:
  //! Loads the catalogue. Throws Error when it cannot be read. Where pictures are made on a device, it seeks images too.
  explicit StarPass(const Show& show, Backend backend = Backend::cpu);

  //! Whether the catalogue holds no star.
  [[nodiscard]] bool empty() const { return field_.stars().empty(); }

  //! Rows of the catalogue's file of which no star was made.
  [[nodiscard]] const std::vector<RowsLeftOut>& left_out() const { return left_out_; }

  //! Takes the numbers of a show that differs from the first in these alone (content/animatable_number.h), and not in its sky's turn.
  void set_numbers(const Show& show);

  //! Turns the stars as a show does that differs from the first in numbers alone. Grids and patches stay: these tell stars by their light. From the first
  //! time on the catalogue is kept.
  void turn_sky(const Show& show);

  //! Finds the images for an eye, and with a shutter their trails; they are exact whatever the map's lens is.
  std::vector<StarPoint> find(const StarEye& eye, const Projection& projection, const std::optional<Shutter>& shutter,
                              PixelMatch match = PixelMatch::exact);

  //! The same, in place where images are sought on a device and leave no trails. What is in place is there until the next call.
  FoundPoints find_points(const StarEye& eye, const Projection& projection, const std::optional<Shutter>& shutter,
                          PixelMatch match);

  //! How they are drawn on a picture's pixels, and what spikes look like: nullptr where the show has none.
  [[nodiscard]] SplatSettings splat_for(const Projection& projection) const { return scaled_to(splat_, projection); }
  [[nodiscard]] const DiffractionPattern* spikes() const { return spikes_ ? &*spikes_ : nullptr; }

  //! Adds them to rows of a picture in host memory; TiledStars draws them elsewhere.
  void draw(const std::vector<StarPoint>& points, const Projection& projection, int first_row, int row_count,
            float* rgba) const;

 private:
  StarPass(const Show& show, Backend backend, const StarCatalogue& catalogue);

  //! What is asked of a search for a picture.
  [[nodiscard]] StarSettings settings_for(const StarEye& eye, const Projection& projection, bool leaves_trails,
                                          PixelMatch match) const;

  //! Whether stars are gathered by pixels: where the show asks for it, and where grids have the shadow wrong, and with it what lies beside it.
  [[nodiscard]] bool gathers(const StarEye& eye, double pixel);

  std::vector<StarImage> sought_images(const StarEye& eye, const StarSettings& settings);
  PlacedImages sought_in_place(const StarEye& eye, const StarSettings& settings);
  std::vector<StarImage> gathered_images(const StarEye& eye, const Projection& projection,
                                         const StarSettings& settings);
  void draw_spikes(const std::vector<StarPoint>& points, const Projection& projection, int first_row, int row_count,
                   float* rgba) const;

  void make_pattern(const Show& show);

  //! A grid that was turned round.
  struct Turned {
    StarEye eye;
    double pixel;
    double least_cell_px;
    float faintest;  //!< that the patches were made for
    LensStation station;
    StarPatches patches;
    std::unique_ptr<PlacedPatches> on_device;
  };

  void place(Turned& turned) const;

  const Turned& patches_for(const StarEye& eye, const StarSettings& settings);

  void search_field();

  Backend backend_;
  BlackbodyColours colours_;
  std::optional<StarCatalogue> catalogue_;  //!< once the sky has turned
  std::vector<RowsLeftOut> left_out_;
  StarField field_;
  EdgeMiss edge_miss_;
  bool all_gathered_;                  //!< as the show has it
  std::optional<StarTree> tree_;       //!< where pixels gather stars
  std::optional<PatchSearch> search_;  //!< on a device
  StarSettings settings_;
  PointOrder order_;  //!< of the points that are found
  SplatSettings splat_;
  std::optional<DiffractionPattern> spikes_;    //!< where the show ever has any
  std::optional<DiffractionSettings> pattern_;  //!< of these spikes
  GridTracer<float> tracer_;
  std::vector<Turned> turned_;  //!< of the last eyes
  PatchRoom room_;
  KeptStarImages<std::vector<StarImage>> images_;
  KeptStarImages<PlacedImages> images_in_place_;
  std::optional<ImageJoiner> joiner_;  //!< on a device
  std::optional<PointPlacer> placer_;
};

}  // namespace ergodome
