#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "content/camera/camera_path.h"
#include "content/show/show.h"
#include "render/eyes/narrowed_eyes.h"
#include "render/frame/cube_pictures.h"
#include "render/frame/eye_renderer.h"
#include "render/frame/view_projection.h"
#include "render/lens/omni_chooser.h"
#include "render/output/auto_exposure.h"
#include "render/passes/overlay/overlay_pass.h"
#include "render/passes/sky/show_sky.h"
#include "render/plan/frame_needs.h"

namespace ergodome {

//! Which image of a frame a picture is.
enum class FramePart { whole, left, right };

//! An image to show or to write: linear light, four floats a pixel.
struct FrameImage {
  FramePart part = FramePart::whole;
  Picture picture;
  std::optional<CubeFace> face{};  //!< which face of a cube it is, where each has a file
};

//! What a person may choose beside the show.
struct ViewChoice {
  ViewMode mode = ViewMode::sky;
  int size_px = 0;                      //!< width of one eye's image; 0: as the show says
  std::optional<TraceMethod> method{};  //!< of heat maps of steps and errors: how rays are followed
  std::optional<ViewRange> range{};     //!< of heat maps: in place of the usual one
  bool alpha = false;                   //!< pictures cover what their image covers, see set_image_alpha
};

//! What of a picture can be traded for time while a show goes on.
struct FrameQuality {
  double budget_px = 0.25;  //!< QualitySettings::budget_px, of the pictures that are drawn
  LensChoice lens = LensChoice::automatic;
  SkyFilter filter = SkyFilter::ewa;

  bool operator==(const FrameQuality&) const = default;
};

//! Pictures that stay in the backend's memory until the next.
struct EyesInPlace {
  PictureInPlace first;                 //!< the left one of two
  std::optional<PictureInPlace> right;  //!< where there are two
};

//! Renders the frames of a show.
class ShowRenderer {
 public:
  //! Loads the show's sky; animated numbers are those of time 0 at first. Throws Error when the sky cannot be read or the show asks for what is not there yet.
  //!
  //! `stream`: the show's own trajectory (see require_path_of), if there is one.
  ShowRenderer(const Show& show, Backend backend, LensChoice lens = LensChoice::automatic,
               std::shared_ptr<StationStream> stream = nullptr);

  //! Sentences about what the show names and nobody will see: a catalogue without stars, rows of it that are left out, maps' texels that are no light, traced objects within the horizon, letters without a font.
  [[nodiscard]] std::vector<std::string> notes() const;

  //! Gives the show's numbers the values of a show time, for all pictures until the next call; render() does it by itself. What has not
  //! changed costs nothing. Throws Error where a sky that turns cannot be read again.
  void apply(double time_s);

  //! Goes on with another show, at the time of the last: a file that has been edited. The sky is loaded anew only where it is another
  //! one. Throws Error for what cannot be read or drawn, and keeps the old show.
  //!
  //! `stream`: the new show's own trajectory, if there is one.
  void set_show(const Show& show, std::shared_ptr<StationStream> stream = nullptr);

  //! The images of one instant: one that the stereo layout makes of both eyes, or one of each where it keeps them apart; six of each where
  //! the faces of a cube have files of their own.
  std::vector<FrameImage> render(double time_s, const ViewChoice& choice);

  //! The picture of a window for a head at a pose: one eye, or both as the stereo layout has them (where it keeps them apart, side by side). `moment` says
  //! when in the show that is, for a camera on its path. Exposure follows by the clock.
  Picture render_window(const CameraPose& pose, const Projection& projection, ViewMode mode,
                        const ShowMoment& moment = {});

  //! The same, but that eyes which lie whole beside or above each other are not joined: two pictures, the left eye's first.
  std::vector<Picture> render_window_parts(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                           const ShowMoment& moment = {});

  //! One eye's picture. `eye_offset` in M to the right of the head.
  Picture render_eye(const CameraPose& pose, double eye_offset, const Projection& projection, ViewMode mode,
                     const ShowMoment& moment = {});

  //! The same, left in the backend's memory until the next picture.
  PictureInPlace render_eye_in_place(const CameraPose& pose, double eye_offset, const Projection& projection,
                                     ViewMode mode, const ShowMoment& moment);

  //! What the stream of baked stations has done; nothing without one.
  [[nodiscard]] std::optional<StreamStatistics> stream_statistics() const;

  //! The picture of a window, one eye's or two, where they may stay in the backend's memory.
  EyesInPlace render_eyes_in_place(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                   const ShowMoment& moment);

  //! Whether pictures of a view may stay in a device's memory: they need no more than render_eyes_in_place does. Exposure that follows the light, bloom, eyes of
  //! the models `flat` and `omni`, tinted ones and such as are not shown whole do.
  [[nodiscard]] bool may_stay_in_place(ViewMode mode) const;

  //! What a person may turn while the show plays, until apply() animates it. Throws Error for what cannot be drawn, and keeps the old.
  void set_stereo(const StereoSettings& stereo);

  //! For all pictures from now on; set_show() brings its own budget and filter again. A filter by polygons stays, and none becomes one: they read another sky.
  void set_quality(const FrameQuality& quality);
  [[nodiscard]] FrameQuality quality() const;

  //! The lens that the head's picture is drawn through; see render_eye.
  std::unique_ptr<LensSource> lens_of(const CameraPose& pose, const Projection& projection,
                                      const ShowMoment& moment = {});

  //! Stops of exposure on top of the show's.
  void set_exposure(double stops) { exposure_stops_ = stops; }

  //! Stops of the last pictures' exposure where it follows the light; it goes on from stops that pictures at `clock_s` have had, whoever rendered them.
  [[nodiscard]] std::optional<double> followed_stops() const;
  void follow_from(double stops, double clock_s);

  //! How pictures are shown, but for exposure that follows the light.
  [[nodiscard]] Tone tone() const;

  //! Captions and images over the pictures: their language, and captions that do not come from the show. They are drawn in what is rendered next.
  [[nodiscard]] OverlayPass& overlays() { return overlays_; }

  //! Captions of a window's picture at a time of the show, on their own; see OverlayPass::set_captions_apart. They are on the dome or screen itself, where
  //! both eyes have them in one place. `projection`: one eye's, of any resolution.
  [[nodiscard]] LaidCaptions caption_layer(const Projection& projection, ViewMode mode, double time_s);

  //! Where in the depth of stereo pictures overlays appear [M]: 0 (as at first) on the dome or screen, infinity behind all.
  void set_overlay_distance(double distance) { overlay_distance_ = distance; }

  //! Who looks from now on; `velocity` in the ZAMO frame, for ObserverMotion::velocity. Lenses stay as they are: they serve every motion.
  void set_observer(ObserverMotion motion, const Vector3<double>& velocity);

  //! Whether the eyes of the last picture stood closer than the show asks, as more does not fit where the camera is.
  [[nodiscard]] const std::optional<NarrowedEyes>& narrowed_eyes() const { return narrowed_; }

  //! The show, with its numbers as they were last applied.
  [[nodiscard]] const Show& show() const { return show_; }
  [[nodiscard]] Backend backend() const { return renderer_.backend(); }

  //! The outlines of the show's objects at the time that its numbers are of: what they do to two eyes is read from these.
  [[nodiscard]] std::vector<PlacedOutline> object_outlines() const;

  //! The show's traced objects at that time, as they hide what is behind them. Those of more than a million triangles are left out on a GPU.
  [[nodiscard]] PlacedMeshes hiding_objects() const;

 private:
  //! One eye's picture, or both: left, right.
  std::vector<Picture> render_eyes(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                   const ShowMoment& moment);

  //! Both eyes from one lens, the head's: what is infinitely far is where the head has it, and the shadow where flat space would.
  std::vector<Picture> render_flat_eyes(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                        const ShowMoment& moment);
  //! The grid that a disk is read from in pictures of such eyes, where that is worth its while.
  std::optional<DiskGrid> flat_disk(const EyeCamera& head, const Projection& projection,
                                    const PictureSettings& settings);
  //! Both eyes, each direction of the view from a camera of its own.
  std::vector<Picture> render_omni_eyes(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                        const ShowMoment& moment);

  //! Sets the tone of pictures that are shown together, at a time of some clock.
  void expose(std::span<Picture> eyes, double clock_s);

  //! What is laid over finished pictures of a view: the show's in its pictures of the sky, and what others give in all.
  void draw_overlays(const OverlayTarget& target, const CameraPose& pose, const Projection& projection,
                     double eye_offset, ViewMode mode, const ShowMoment& moment);

  //! Exposes, draws overlays, tints and swaps as the show says.
  void finish_eyes(std::vector<Picture>& eyes, const CameraPose& pose, const Projection& projection, ViewMode mode,
                   const ShowMoment& moment, double clock_s);

  //! The cameras of the eyes that turn with the direction, at a pose, `baseline` M apart; cameras may be off by `tolerance` [rad].
  [[nodiscard]] std::shared_ptr<const OmniCamera> omni_cameras(const CameraPose& pose, double baseline,
                                                               double tolerance) const;
  //! Such eyes as far apart as the show asks, or as fits: notes which. Throws Error where not even one fits.
  OmniPair fitting_omni_pair(const CameraPose& pose, double tolerance);
  //! The cameras at a pose while the shutter is open, as far apart as fits there.
  [[nodiscard]] std::shared_ptr<const OmniCamera> fitting_omni_cameras(const CameraPose& pose, double tolerance) const;

  //! Notes how far the eyes of the picture at hand are apart [M].
  void note_baseline(const CameraPose& pose, double baseline);

  //! Where the head is while the shutter is open about a time of the show: an odd number of poses.
  [[nodiscard]] std::vector<CameraPose> shutter_poses(const CameraPose& middle, double time_s) const;
  //! Throws Error where rays of a heat map cannot be followed by the method that was chosen from where the camera is.
  void require_rays_from(const CameraPose& pose) const;

  [[nodiscard]] PictureSettings picture_settings(const CameraPose& pose, ViewMode mode, const ShowMoment& moment,
                                                 double eye_offset) const;

  Show show_;
  LensChoice lens_;
  std::shared_ptr<StationStream> stream_;
  ShowSky sky_;
  std::unique_ptr<StarPass> stars_;                //!< where the show has any
  std::unique_ptr<DiskPass> disk_;                 //!< where the show has one
  std::unique_ptr<ShellPass> shells_;              //!< where the show has any
  std::unique_ptr<TracedObjects> traced_objects_;  //!< where it has any that are traced
  std::unique_ptr<ObjectPass> objects_;            //!< where it has any that are polygons
  EyeRenderer renderer_;
  OmniChooser omni_lenses_;
  DiskGrids flat_disks_;     //!< of heads whose eyes see through one lens
  Buffer<float> flat_rows_;  //!< of pictures of such eyes on their way through a GPU
  std::optional<AutoExposure> exposure_;
  OverlayPass overlays_;
  double overlay_distance_ = 0.0;
  double baseline_ = 0.0;  //!< of the eyes of the last picture [M]
  std::optional<NarrowedEyes> narrowed_;
  double exposure_stops_ = 0.0;
  double last_clock_s_ = 0.0;
  double time_s_ = 0.0;                //!< that the numbers are of
  std::optional<TraceMethod> method_;  //!< ViewChoice::method, of the pictures that are drawn
  std::optional<ViewRange> range_;     //!< ViewChoice::range, of the same
};

//! Throws Error unless a trajectory was baked along the show's camera path, for its hole.
void require_path_of(const Show& show, const TrajectoryReader& trajectory);

}  // namespace ergodome
