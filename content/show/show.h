#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "content/fall/fall_settings.h"
#include "content/objects/object_settings.h"
#include "content/show/disk.h"
#include "content/show/flight_settings.h"
#include "content/show/shells.h"
#include "content/sky/map_layout.h"
#include "content/timeline/timeline.h"
#include "kernels/image/tone_curve.h"
#include "kernels/projection/lens_law.h"
#include "kernels/sky/sky_look.h"
#include "kernels/spacetime/kerr/observer.h"

namespace ergodome {

class FreeFall;

//! Where the camera's view points before yaw, pitch and roll.
struct LookTarget {
  enum class Kind { hole, away, direction };
  Kind kind = Kind::hole;
  Vector3<double> direction = {-1.0, 0.0, 0.0};  //!< in (e_r, e_θ, e_φ), for Kind::direction; any length but 0
};

//! The camera at one instant of the show.
struct CameraKey {
  double time_s = 0.0;
  double r = 10.0;                        //!< Boyer-Lindquist radius [M]
  double theta = 1.57079632679489661923;  //!< polar angle [rad]
  double phi = 0.0;                       //!< azimuth [rad]; may run over many turns
  LookTarget look;
  double yaw = 0.0;          //!< to the right [rad]
  double pitch = 0.0;        //!< upwards [rad]
  double roll = 0.0;         //!< clockwise [rad]
  double hold_s = 0.0;       //!< the camera stays so long before it goes on
  Ease ease = Ease::smooth;  //!< on the way from here to the next key; Ease::hold is for numbers alone
  //! Of who looks from here, in the ZAMO frame; absent: as CameraSettings says. All keys have one, or none.
  std::optional<Vector3<double>> velocity = std::nullopt;
};

struct CameraSettings {
  ObserverMotion motion = ObserverMotion::zamo;
  Vector3<double> velocity = {0.0, 0.0, 0.0};  //!< in the ZAMO frame, for ObserverMotion::velocity
  std::vector<CameraKey> keys;                 //!< in order of time, at least one
  std::optional<FallSettings> fall;            //!< absent: the keys lead the camera to the end
  //! What the fall does to the camera: follow_fall() in content/camera_path.h. Keys between its beginning and its end say but where the camera looks.
  std::shared_ptr<const FreeFall> orbit;
  //! Where the keys lead a camera whose fall ends: keys_after_fall() in content/camera_path.h. Empty where it lasts to the show's end.
  std::vector<CameraKey> after_fall;
};

//! How stars are found: every image by inverting the lens, or by what each pixel covers (Verbraeck & Eisemann 2021), for comparison.
enum class StarMethod { inverse, gather };

struct SkySettings {
  std::string map = "milky_way";  //!< a built-in name, or a path relative to the show
  MapLayout map_layout;           //!< of a path's map
  std::string stars;              //!< a built-in name, a path, or empty: no stars
  StarMethod star_method = StarMethod::inverse;
  double faintest_mag = 10.0;       //!< images of stars fainter than this, as they are seen, are left out
  double spin_axis_ra_deg = 270.0;  //!< where the hole's spin axis points, J2000
  double spin_axis_dec_deg = 66.6;
  double exposure = 1.0;  //!< factor on the map's light
  SkyFilter filter = SkyFilter::ewa;
  SkyShift shift = SkyShift::luminance;  //!< what EffectSettings::redshift does to the map; `none` is not for shows
  //! The map's light is multiplied by the magnification, as Verbraeck & Eisemann do, against the conservation of surface brightness.
  bool brightening = false;
};

//! The spot that an image of a star is. Pixels are those of pictures up to 4k; in finer ones of a dome or a whole sky it keeps its angle.
struct PointSpreadSettings {
  //! Of a Gaussian that is two pixels wide at half its height, so that stars which move do not flicker. 0: one hard pixel.
  double sigma_px = 0.85;
  double cutoff_px = 0.0;  //!< where the spot ends; 0: three sigma
};

struct TrailSettings {
  double shutter_s = 0.02;
};

//! Spikes on bright stars, as an aperture makes them.
struct DiffractionSettings {
  double brighter_than_mag = 2.0;  //!< images as bright as this have spikes
  double strength = 0.3;           //!< part of a star's light that is in them
  std::string pattern;             //!< an image, as a path relative to the show; empty: that of the aperture
  int blades = 6;                  //!< as in ApertureSettings (render/effects/far_field.h), like the rest
  int vanes = 0;
  double obstruction = 0.0;
  int size_px = 129;
  double scale = 1.0;
};

//! The halo of bright light that a lens or an eye scatters.
struct BloomSettings {
  //! Part of the light that is scattered; taken as 0 below it and as 1 above.
  double strength = 0.04;
  //! Root mean square distance of the scattered light from its source along an axis [px]: most falls nearer, a faint tail reaches three
  //! times as far. 0 scatters nothing. More than the picture is large is taken as that.
  double radius_px = 40.0;
};

//! What is simulated; absent is not simulated. Stars always have a spread.
struct EffectSettings {
  bool redshift = false;
  bool magnification = false;
  PointSpreadSettings psf;
  std::optional<TrailSettings> trails;
  std::optional<DiffractionSettings> diffraction;
  std::optional<BloomSettings> bloom;
};

enum class ViewProjection { dome, equirect, cube, cylinder, pinhole };

//! What the picture of a cube is: one picture of all faces, or a file each (kernels/projection/cube_faces.h).
enum class CubeFiles { cross, strip, faces };

//! Sides of a screen off the axis, as angles from it [deg]: left below right, down below up.
struct FrustumAngles {
  double left_deg = -30.0;
  double right_deg = 30.0;
  double up_deg = 30.0;
  double down_deg = -30.0;
};

//! Parts of the height of a domemaster that stay black.
struct DomeTruncation {
  double bottom = 0.0;
  double top = 0.0;
};

struct ViewSettings {
  ViewProjection projection = ViewProjection::dome;
  double field_of_view_deg = 180.0;
  double tilt_deg = 0.0;
  bool artistic_tilt = false;           //!< the tilt stays whatever a dome setup says
  int size_px = 1024;                   //!< width of the image; of a face, where each has a file
  double aspect = 1.0;                  //!< width over height, for the pinhole
  bool from_outside = false;            //!< the mirror image
  LensLaw lens = LensLaw::equidistant;  //!< of the dome, as the next three
  std::array<double, 4> polynomial =
      {};  //!< for LensLaw::polynomial: of t, t³, t⁵, t⁷ [rad], in half widths of the picture
  DomeTruncation truncation;
  Vector3<double> viewer = {0.0, 0.0, 0.0};  //!< from the dome's middle: right, up, back; in radii of the dome
  CubeFiles cube_files = CubeFiles::cross;
  double height_deg = 90.0;              //!< vertical field of view of the cylinder
  std::optional<FrustumAngles> frustum;  //!< of a pinhole that is not symmetric, in place of field of view and aspect
};

//! How the pictures of two eyes become images (render/output/stereo_layout.h).
enum class StereoLayout {
  mono,
  side_by_side,
  top_bottom,
  separate,
  multiview,
  anaglyph,
  dubois,
  rows,
  quad_buffer,
  half_side_by_side,
  half_top_bottom
};
inline constexpr std::array stereo_layout_names = {"mono",        "side_by_side",      "top_bottom",     "separate",
                                                   "multiview",   "anaglyph",          "dubois",         "rows",
                                                   "quad_buffer", "half_side_by_side", "half_top_bottom"};

//! Where the two eyes are: at events of their own; in the head's flat tangent space; or turning with the azimuth one looks at.
enum class StereoModel { physical, flat, omni };
inline constexpr std::array stereo_model_names = {"physical", "flat", "omni"};

struct StereoSettings {
  StereoLayout layout = StereoLayout::mono;
  StereoModel model = StereoModel::physical;
  double baseline = 0.0;        //!< distance of the eyes [M]
  double convergence = 0.0;     //!< distance at which both eyes see things at one place of the image [M]; 0: infinity
  double fade_from_deg = 60.0;  //!< elevation, up and down, from which the baseline of StereoModel::omni gets smaller
  double fade_to_deg = 90.0;    //!< and at which it is gone
  double comfort_deg = 1.0;     //!< difference of disparities that a person fuses without effort
  bool swap_eyes = false;
  bool tint_eyes = false;  //!< the left eye's picture turns red, the right one's cyan

  bool operator==(const StereoSettings&) const = default;
};

//! How many eyes a frame is made for: the one place that decides it.
constexpr int eye_count(const StereoSettings& stereo) { return stereo.layout == StereoLayout::mono ? 1 : 2; }

//! How many times the model `flat` draws the head's picture: once for both eyes, unless they look through different frusta.
constexpr int flat_pictures(const StereoSettings& stereo) {
  return stereo.convergence > 0.0 && stereo.baseline > 0.0 ? 2 : 1;
}

//! How many pictures of a frame are drawn through a lens.
constexpr int drawn_pictures(const StereoSettings& stereo) {
  return eye_count(stereo) > 1 && stereo.model == StereoModel::flat ? flat_pictures(stereo) : eye_count(stereo);
}

//! Exposure that follows the light, as an eye does.
struct AutoExposureSettings {
  double target = 0.1;        //!< the display light that the picture's middle light is brought to
  double least_stops = -4.0;  //!< limits of what that may change
  double most_stops = 4.0;
  double adapt_s = 1.0;  //!< time in which all but 1/e of a change is followed
};

//! Of ToneCurve (kernels/image/tone_curve.h), in its order.
inline constexpr std::array tone_curve_names = {"shoulder", "reinhard", "filmic", "gamma"};

struct ToneSettings {
  ToneCurve curve = ToneCurve::shoulder;
  double exposure_stops = 0.0;
  double white = 4.0;  //!< light that `reinhard` shows as white
  double gamma = 2.2;  //!< exponent that `gamma` lifts dark light by
  std::optional<AutoExposureSettings> automatic;
};

struct QualitySettings {
  double budget_px = 0.25;  //!< error of a direction on the screen that is accepted [px]
};

//! How lens grids are laid out: the conforming chart, or the quadtree of Verbraeck & Eisemann (2021), for comparison.
enum class GridScheme { conforming, quadtree };

//! Keys and values of the command line that change a show before it is read, each as "hole.spin=0.5".
using ShowSettings = std::vector<std::string>;

//! The option that gives them, by which messages name them: "--set hole.spin".
inline constexpr const char* show_setting_option = "--set";

//! The line of a key that is not in the show's file but was set on the command line.
inline constexpr int key_set_outside = 0;

//! Spin and camera position in the picture, as a line of text.
struct ReadoutSettings {
  DomePlace place = {.elevation_deg = 8.0};
  double letter_deg = 2.0;  //!< height of a line
};

//! A show as its file tells it; angles in radians but where a name says degrees.
struct Show {
  std::string name;                  //!< file name without folder and ending
  std::string folder;                //!< where relative paths start
  std::map<std::string, int> lines;  //!< of each key in the file, by its path ("sky.stars")
  LocalText title;
  double duration_s = 0.0;
  double frame_rate_hz = 30.0;
  double spin = 0.0;
  CameraSettings camera;
  SkySettings sky;
  std::optional<DiskSettings> disk;  //!< absent: none is traced
  std::vector<ObjectSettings> objects;
  std::optional<PointLight> light;  //!< for objects that are lit
  std::vector<ShellSettings> shells;
  EffectSettings effects;
  ViewSettings view;
  StereoSettings stereo;
  ToneSettings tone;
  QualitySettings quality;
  GridScheme grid_scheme = GridScheme::conforming;
  std::optional<ReadoutSettings> readout;  //!< absent: not shown
  Timeline timeline;
  FlightSettings flight;
};

//! The field of view that a projection has unless the show says otherwise [deg].
double usual_field_of_view_deg(ViewProjection projection);

//! Number of frames of the whole show; at least one.
int frame_count(const Show& show);

//! Tags of the languages that a show has captions, chapters or narration in; where it has none, those of its title.
std::vector<std::string> languages(const Show& show);

//! Show time of a frame, counted from 0 [s].
double frame_time_s(const Show& show, int frame);

//! Whether the show has objects, and draws them by this method: all by the same.
inline bool has_objects(const Show& show, ObjectMethod method) {
  return !show.objects.empty() && show.objects.front().method == method;
}

//! A combination of settings that cannot be drawn.
struct MissingFeature {
  std::string problem;
  std::string remedy;
};

//! Returns the unsupported combinations that the show asks for.
std::vector<MissingFeature> missing_features(const Show& show);

}  // namespace ergodome
