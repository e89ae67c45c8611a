#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "content/show/disk.h"
#include "content/show/fall_settings.h"
#include "content/show/flight_settings.h"
#include "content/show/headset_settings.h"
#include "content/show/map_layout.h"
#include "content/show/object_settings.h"
#include "content/show/shells.h"
#include "content/timeline/timeline.h"
#include "kernels/image/tone_curve.h"
#include "kernels/projection/lens_law.h"
#include "kernels/sky/sky_sampling.h"
#include "kernels/spacetime/kerr/observer.h"

namespace ergodome {

class FreeFall;

//! The point or direction that the camera's view faces before yaw, pitch and roll.
struct LookTarget {
  enum class Kind { hole, away, direction };
  Kind kind = Kind::hole;
  //! Direction in (e_r, e_θ, e_φ), for Kind::direction; any nonzero length.
  Vector3<double> direction = {-1.0, 0.0, 0.0};
};

//! The camera at one instant of the show.
struct CameraKey {
  double time_s = 0.0;
  double r = 10.0;                        //!< Boyer-Lindquist radius [M]
  double theta = 1.57079632679489661923;  //!< polar angle [rad]
  double phi = 0.0;                       //!< azimuth [rad]; may exceed a full turn
  LookTarget look;
  double yaw = 0.0;          //!< rotation to the right [rad]
  double pitch = 0.0;        //!< rotation upward [rad]
  double roll = 0.0;         //!< clockwise rotation [rad]
  double hold_s = 0.0;       //!< the camera stays at this key for this time
  Ease ease = Ease::smooth;  //!< easing from here to the next key; cameras cannot use Ease::hold
  //! Velocity of the observer at this key in the ZAMO frame; absent: as CameraSettings defines.
  //! Either all keys have one or none.
  std::optional<Vector3<double>> velocity = std::nullopt;
};

struct CameraSettings {
  ObserverMotion motion = ObserverMotion::zamo;
  //! Velocity in the ZAMO frame, for ObserverMotion::velocity.
  Vector3<double> velocity = {0.0, 0.0, 0.0};
  std::vector<CameraKey> keys;       //!< in order of time, at least one
  std::optional<FallSettings> fall;  //!< absent: the keys define the camera's whole path
  //! The orbit of the fall, from follow_fall() in content/camera/camera_path.h. Keys during the
  //! fall only define where the camera looks.
  std::shared_ptr<const FreeFall> orbit;
  //! The camera's path after a fall that ends during the show, from keys_after_fall() in
  //! content/camera/camera_path.h. Otherwise empty.
  std::vector<CameraKey> after_fall;
};

//! How stars are found: every image by inverting the lens map, or, for comparison, by gathering the
//! stars within each pixel (Verbraeck & Eisemann 2021).
enum class StarMethod { inverse, gather };

struct SkySettings {
  std::string map = "milky_way";  //!< a built-in name, or a path relative to the show
  MapLayout map_layout;           //!< layout of the sky map, if `map` is a path
  std::string stars;              //!< a built-in name, a path, or empty for no stars
  StarMethod star_method = StarMethod::inverse;
  double faintest_mag = 10.0;       //!< star images that appear fainter than this are not drawn
  double spin_axis_ra_deg = 270.0;  //!< direction of the hole's spin axis, J2000
  double spin_axis_dec_deg = 66.6;
  double exposure = 1.0;  //!< factor on the light of map and stars
  SkyFilter filter = SkyFilter::ewa;
  SkyShift shift = SkyShift::luminance;  //!< effect of EffectSettings::redshift on the map; shows cannot use `none`
  //! Multiplies the map's light by the magnification, as Verbraeck & Eisemann do, although this
  //! violates the conservation of surface brightness.
  bool brightening = false;
};

//! The spot that an image of a star is drawn as. Sizes are in pixels for images up to 4k; on a
//! larger dome or full-sky image the spot keeps its angular size.
struct PointSpreadSettings {
  //! Standard deviation of the Gaussian spot. By default it is two pixels wide at half maximum, so
  //! that moving stars do not flicker. 0: a single pixel.
  double sigma_px = 0.85;
  double cutoff_px = 0.0;  //!< radius of the spot; 0: three times sigma_px
};

struct TrailSettings {
  double shutter_s = 0.02;
};

//! Diffraction spikes on bright stars.
struct DiffractionSettings {
  double brighter_than_mag = 2.0;  //!< star images at least this bright have spikes
  double strength = 0.3;           //!< fraction of a star's light that goes into the spikes
  std::string pattern;             //!< an image, as a path relative to the show; empty: computed from the aperture
  //! Number of aperture blades; this and the rest as in ApertureSettings
  //! (render/passes/effects/far_field.h).
  int blades = 6;
  int vanes = 0;
  double obstruction = 0.0;
  int size_px = 129;
  double scale = 1.0;
};

//! The halo of light that a lens or an eye scatters around bright sources.
struct BloomSettings {
  //! Fraction of the light that is scattered; clamped to [0, 1].
  double strength = 0.04;
  //! Root mean square distance of the scattered light from its source along one axis [px]; a faint
  //! tail reaches three times as far. 0 scatters nothing. Limited to the size of the image.
  double radius_px = 40.0;
};

//! Simulated effects; an absent one is not simulated. Stars always have a point spread.
struct EffectSettings {
  bool redshift = false;
  bool magnification = false;
  PointSpreadSettings psf;
  std::optional<TrailSettings> trails;
  std::optional<DiffractionSettings> diffraction;
  std::optional<BloomSettings> bloom;
};

enum class ViewProjection { dome, equirect, cube, cylinder, pinhole };

//! Names of ViewProjection, in its order.
inline constexpr std::array view_projection_names = {"dome", "equirect", "cube", "cylinder", "pinhole"};

//! Output of a cube view: one image of all faces, or a file per face
//! (kernels/projection/cube_faces.h).
enum class CubeFiles { cross, strip, faces };

//! Sides of an off-axis screen as angles from the view axis [deg]; left must be below right, and
//! down below up.
struct FrustumAngles {
  double left_deg = -30.0;
  double right_deg = 30.0;
  double up_deg = 30.0;
  double down_deg = -30.0;
};

//! Fractions of a domemaster's height that stay black.
struct DomeTruncation {
  double bottom = 0.0;
  double top = 0.0;
};

struct ViewSettings {
  ViewProjection projection = ViewProjection::dome;
  double field_of_view_deg = 180.0;
  double tilt_deg = 0.0;
  bool artistic_tilt = false;  //!< true: a dome setup does not override the tilt
  int size_px = 1024;          //!< width of one eye's image; of one face if each has a file
  double aspect = 1.0;         //!< width over height, for the pinhole view
  bool from_outside = false;   //!< mirrors the image
  double vignette = 0.0;       //!< fraction of the light that is lost at the edge of a dome's or pinhole's picture
  //! Lens of the dome view; the next three members are also for the dome view.
  LensLaw lens = LensLaw::equidistant;
  //! Coefficients of t, t³, t⁵ and t⁷ in the radius of LensLaw::polynomial [half widths of the
  //! image], where t is the angle from the lens axis [rad].
  std::array<double, 4> polynomial = {};
  DomeTruncation truncation;
  Vector3<double> viewer = {0.0, 0.0, 0.0};  //!< position relative to the dome's center: right, up, back; in dome radii
  CubeFiles cube_files = CubeFiles::cross;
  double height_deg = 90.0;  //!< vertical field of view of the cylinder
  //! Frustum of an asymmetric pinhole view; replaces field of view and aspect.
  std::optional<FrustumAngles> frustum;
};

//! How the renderings of the two eyes become output images (render/output/stereo_layout.h).
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

//! How the two eyes are placed: at separate events in spacetime; in the flat tangent space of the
//! head; or omnidirectionally (ODS), turning with the viewing azimuth.
enum class StereoModel { physical, flat, omni };
inline constexpr std::array stereo_model_names = {"physical", "flat", "omni"};

//! Minimum elevation range over which the baseline of StereoModel::omni fades [deg].
inline constexpr double min_fade_deg = 1.0;

struct StereoSettings {
  StereoLayout layout = StereoLayout::mono;
  StereoModel model = StereoModel::physical;
  double baseline = 0.0;        //!< interocular distance [M]
  double convergence = 0.0;     //!< distance of points without parallax [M]; 0: infinity
  double fade_from_deg = 60.0;  //!< elevation, up and down, from which the baseline of StereoModel::omni is reduced
  double fade_to_deg = 90.0;    //!< elevation, up and down, at which that baseline reaches 0
  double comfort_deg = 1.0;     //!< range of disparities that viewers fuse without effort
  bool swap_eyes = false;
  bool tint_eyes = false;  //!< tints the left eye's image red and the right eye's cyan

  bool operator==(const StereoSettings&) const = default;
};

//! Returns the number of eyes rendered per frame. All code must decide it by this function.
constexpr int eye_count(const StereoSettings& stereo) { return stereo.layout == StereoLayout::mono ? 1 : 2; }

//! Returns how many times StereoModel::flat renders the head's view: once for both eyes, or twice
//! if their frusta differ.
constexpr int flat_pictures(const StereoSettings& stereo) {
  return stereo.convergence > 0.0 && stereo.baseline > 0.0 ? 2 : 1;
}

//! Returns the number of lensed renderings per frame.
constexpr int drawn_pictures(const StereoSettings& stereo) {
  return eye_count(stereo) > 1 && stereo.model == StereoModel::flat ? flat_pictures(stereo) : eye_count(stereo);
}

//! Automatic exposure that adapts to the light as an eye does.
struct AutoExposureSettings {
  //! Mean display light after the adjustment: the geometric mean of the frame is adjusted to it.
  double target = 0.1;
  double least_stops = -4.0;  //!< limits of the adjustment [stops]
  double most_stops = 4.0;
  //! Time constant of the adaptation: after this time, 1/e of a change remains.
  double adapt_s = 1.0;
};

//! Names of the values of ToneCurve (kernels/image/tone_curve.h), in the same order.
inline constexpr std::array tone_curve_names = {"shoulder", "reinhard", "filmic", "gamma"};

struct ToneSettings {
  ToneCurve curve = ToneCurve::shoulder;
  double exposure_stops = 0.0;
  double white = 4.0;  //!< light that `reinhard` displays as white
  double gamma = 2.2;  //!< for the curve `gamma`: light is raised to the power 1 / gamma
  std::optional<AutoExposureSettings> automatic;
};

struct QualitySettings {
  double budget_px = 0.25;  //!< accepted directional error on the screen [px]
};

//! Layout of lens grids: the conforming chart, or, for comparison, the quadtree of Verbraeck &
//! Eisemann (2021).
enum class GridScheme { conforming, quadtree };

//! Settings from the command line that change a show before it is read, each as "hole.spin=0.5".
using ShowSettings = std::vector<std::string>;

//! The command-line option of these settings. Messages put the key after it: "--set hole.spin".
inline constexpr const char* show_setting_option = "--set";

//! The line number that Show::lines has for keys that were set on the command line.
inline constexpr int key_set_outside = 0;

//! Display of spin and camera position as a line of text on the dome.
struct ReadoutSettings {
  DomePosition position = {.elevation_deg = 8.0};
  double letter_deg = 2.0;  //!< height of a line
};

//! The content of a show file. Angles are in radians unless a name ends in `deg`.
struct Show {
  std::string name;                  //!< file name without folder and extension
  std::string folder;                //!< base of relative paths
  std::map<std::string, int> lines;  //!< line of each key in the file, by its path ("sky.stars")
  LocalText title;
  double duration_s = 0.0;
  double frame_rate_hz = 30.0;
  double spin = 0.0;
  CameraSettings camera;
  SkySettings sky;
  std::optional<DiskSettings> disk;  //!< absent: no disk
  std::vector<ObjectSettings> objects;
  std::optional<PointLight> light;  //!< illuminates objects that are lit
  std::vector<ShellSettings> shells;
  EffectSettings effects;
  ViewSettings view;
  StereoSettings stereo;
  ToneSettings tone;
  QualitySettings quality;
  GridScheme grid_scheme = GridScheme::conforming;
  std::optional<ReadoutSettings> readout;  //!< absent: not displayed
  Timeline timeline;
  FlightSettings flight;
  HeadsetSettings headset;
};

//! Returns the spacetime of Show::spin. If the spin is animated, that is the fixed number of the
//! file, or the value that animate() set last; spacetime_at() returns the one at a time.
inline Spacetime spacetime_of(const Show& show) { return Spacetime{show.spin}; }

//! Returns the default field of view of a projection [deg].
double usual_field_of_view_deg(ViewProjection projection);

//! Returns whether the picture shows every direction of the sky.
bool shows_whole_sky(const ViewSettings& view);

//! Returns the number of frames of the whole show; at least one.
int frame_count(const Show& show);

//! Returns the language tags of the show's captions, chapter titles and audio tracks, or those of
//! its own title if these have none.
std::vector<std::string> languages(const Show& show);

//! Returns the show time of a frame, counted from 0 [s].
double frame_time_s(const Show& show, int frame);

//! Returns true if the show has objects drawn by this method; all objects of a show use the same.
inline bool has_objects(const Show& show, ObjectMethod method) {
  return !show.objects.empty() && show.objects.front().method == method;
}

//! An unsupported combination of settings.
struct MissingFeature {
  std::string problem;
  std::string remedy;
};

//! Returns the unsupported combinations that the show uses.
std::vector<MissingFeature> missing_features(const Show& show);

}  // namespace ergodome
