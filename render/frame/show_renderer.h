#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "content/camera/camera_path.h"
#include "content/show/show.h"
#include "render/eyes/view_projection.h"
#include "render/frame/eye_renderer.h"
#include "render/frame/omni_eyes.h"
#include "render/frame/show_passes.h"
#include "render/output/tone_map.h"
#include "render/passes/objects/placed_meshes.h"
#include "render/passes/objects/polygons/object_outline.h"
#include "render/passes/overlay/overlay_pass.h"
#include "render/passes/sky/show_sky.h"
#include "render/picture/picture.h"
#include "render/stereo/reduced_baseline.h"

// Renders the frames of a show.

namespace ergodome {

//! Choices of the user that apply to the rendering but are not part of the show.
struct ViewChoice {
  ViewMode mode = ViewMode::sky;
  int size_px = 0;                      //!< width of one eye's picture; 0: the show's
  std::optional<TraceMethod> method{};  //!< integrator of the rays in heat maps of steps and errors
  std::optional<ViewRange> range{};     //!< replaces the default value range of heat maps
  //! Sets the alpha channel to the coverage of the image, see set_image_alpha().
  bool alpha = false;
};

//! Settings that trade picture quality for speed while a show plays.
struct FrameQuality {
  double budget_px = 0.25;  //!< QualitySettings::budget_px for the next pictures
  LensChoice lens = LensChoice::automatic;
  SkyFilter filter = SkyFilter::ewa;

  bool operator==(const FrameQuality&) const = default;
};

//! Pictures that stay in the backend's memory until the next picture is rendered.
struct BackendEyes {
  BackendPicture first;                 //!< the only picture, or that of the left eye
  std::optional<BackendPicture> right;  //!< picture of the right eye, if there is one
};

//! Renders the frames of a show.
class ShowRenderer {
 public:
  //! Loads the show's sky and the files that its passes draw, and applies the values of animated
  //! numbers at time 0. Throws Error if one cannot be read. missing_features(show) must be empty.
  //!
  //! `stream`: the show's own trajectory (see require_path_of), if there is one.
  ShowRenderer(const Show& show, Backend backend, LensChoice lens = LensChoice::automatic,
               std::shared_ptr<StationStream> stream = nullptr);

  //! Returns warnings about parts of the show that will not be visible: a catalog without stars,
  //! skipped rows of a catalog, texels with invalid light, traced objects inside the horizon,
  //! letters without a font.
  [[nodiscard]] std::vector<std::string> notes() const;

  //! Sets the show's animated numbers to their values at a show time, for all pictures until the
  //! next call. render_frame() calls it. Costs nothing for numbers that do not change. Throws Error
  //! if an animation rotates the sky's map, whose image is read again for that, and it cannot be
  //! read.
  void apply(double time_s);

  //! Replaces the show while it plays, for example after its file was edited; the show time stays
  //! the same. Loads the sky's map only if it or its settings differ. Throws Error if something
  //! cannot be read or drawn, and keeps the old show.
  //!
  //! `stream`: the new show's own trajectory, if there is one.
  void set_show(const Show& show, std::shared_ptr<StationStream> stream = nullptr);

  //! Renders the eyes of a frame at a show time: if there are two, the left one first, unless the
  //! show swaps eyes. Automatic exposure adapts over the show's time.
  std::vector<Picture> render_frame(double time_s, const ViewChoice& choice);

  //! Returns the projection of the eyes of a frame, with the show's numbers last applied.
  [[nodiscard]] Projection frame_projection(const ViewChoice& choice) const;

  //! Renders the images of a frame; see frame_images.
  std::vector<FrameImage> render(double time_s, const ViewChoice& choice);

  //! Renders a window's picture for a head at a pose: one eye, or both in the stereo layout (side
  //! by side if the layout stores them separately). `moment` contains the show time if the camera
  //! is on the show's path. Automatic exposure adapts over wall-clock time.
  Picture render_window(const CameraPose& pose, const Projection& projection, ViewMode mode,
                        const ShowMoment& moment = {});

  //! Like render_window(), but returns the pictures of two eyes separately if the layout shows eyes
  //! whole (shows_eyes_whole()): the left one first, unless the show swaps eyes.
  std::vector<Picture> render_window_parts(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                           const ShowMoment& moment = {});

  //! Renders the picture of an eye that sits `eye_offset` M to the right of the head, without the
  //! passes of PassStage::frame.
  Picture render_eye(const CameraPose& pose, double eye_offset, const Projection& projection, ViewMode mode,
                     const ShowMoment& moment = {});

  //! Like render_eye, but also draws the passes of PassStage::frame, and leaves the picture in the
  //! backend's memory until the next one.
  BackendPicture render_eye_in_place(const CameraPose& pose, double eye_offset, const Projection& projection,
                                     ViewMode mode, const ShowMoment& moment);

  //! Returns the counters of the stream of baked stations; nothing without a stream.
  [[nodiscard]] std::optional<StreamStatistics> stream_statistics() const;

  //! Renders a window's picture for one or two eyes and leaves it in the backend's memory.
  //! may_stay_in_place() must be true.
  BackendEyes render_eyes_in_place(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                   const ShowMoment& moment);

  //! Returns whether pictures of a view mode may stay in GPU memory; false on the CPU. They cannot
  //! with automatic exposure, bloom or a vignette. Two eyes cannot in heat maps, without cameras of
  //! their own, if they are tinted, or in layouts that do not show eyes whole.
  [[nodiscard]] bool may_stay_in_place(ViewMode mode) const;

  //! Replaces the stereo settings while the show plays; apply() overwrites those that are animated.
  //! Throws Error if they cannot be drawn, and keeps the old ones.
  void set_stereo(const StereoSettings& stereo);

  //! Sets the quality of the following pictures; set_show() resets budget and filter. A filter
  //! cannot be changed from or to the polygon filter, which reads another form of the sky; such a
  //! change is ignored.
  void set_quality(const FrameQuality& quality);
  [[nodiscard]] FrameQuality quality() const;

  //! Returns the lens with which render_eye() draws the head's picture in ViewMode::sky.
  std::unique_ptr<LensSource> lens_of(const CameraPose& pose, const Projection& projection,
                                      const ShowMoment& moment = {});

  //! Lets the pictures that follow pass their stars apart (Picture::stars), for an output whose
  //! pixels have the angle `pixel` [rad]; 0: draws them. They are drawn in any case if they leave
  //! trails or have spikes, and under overlays, and if bloom, a vignette or automatic exposure
  //! needs their light.
  void set_stars_apart(double pixel) { star_pixel_ = pixel; }

  //! Sets exposure stops that are added to the show's.
  void set_exposure(double stops) { exposure_stops_ = stops; }

  //! followed_stops() returns the stops that automatic exposure applied to the last picture, or
  //! nothing without automatic exposure. follow_from() continues the adaptation from such stops,
  //! for pictures at the time `clock_s`; they may come from another renderer.
  [[nodiscard]] std::optional<double> followed_stops() const;
  void follow_from(double stops, double clock_s);
  //! Returns the light that automatic exposure measured in the last picture, or nothing without
  //! automatic exposure.
  [[nodiscard]] std::optional<double> metered_light() const;

  //! Returns the tone settings of pictures, without automatic exposure.
  [[nodiscard]] Tone tone() const;

  //! Returns the pass that draws captions and images over the pictures. It sets their language, and
  //! captions that are not part of the show. Changes apply to the next picture.
  [[nodiscard]] OverlayPass& overlays() { return *passes_.find<OverlayPass>(); }

  //! Returns the captions of a window's picture at a show time as a separate layer; see
  //! OverlayPass::set_captions_apart(). Captions in this layer lie on the dome or screen itself, so
  //! that both eyes see them at the same position. `projection`: one eye's, of any resolution.
  [[nodiscard]] LaidCaptions caption_layer(const Projection& projection, ViewMode mode, double time_s);

  //! Sets the observer; `velocity` is in the ZAMO frame, for ObserverMotion::velocity. Baked
  //! stations remain valid, because they can be used for every velocity.
  void set_observer(ObserverMotion motion, const Vector3<double>& velocity);

  //! Returns the reduced baseline of the last picture, if the show's baseline did not fit at the
  //! camera position.
  [[nodiscard]] const std::optional<ReducedBaseline>& reduced_baseline() const { return reduced_baseline_; }

  //! Returns the show with its animated numbers as last applied.
  [[nodiscard]] const Show& show() const { return show_; }
  [[nodiscard]] Backend backend() const { return renderer_.backend(); }

  //! Returns the outlines of the show's objects at the current time, for the measurement of
  //! disparities.
  [[nodiscard]] std::vector<PlacedOutline> object_outlines() const;

  //! Returns the meshes of the show's traced objects at the current time, for tests of what they
  //! hide. On a GPU, objects with more than a million triangles are left out.
  [[nodiscard]] PlacedMeshes hiding_objects() const;

 private:
  //! Renders one eye's picture, or both: left, right.
  std::vector<Picture> render_eyes(const CameraPose& pose, const Projection& projection, ViewMode mode,
                                   const ShowMoment& moment);

  //! Draws the passes of PassStage::frame and stores the resulting tone in the pictures, then tints
  //! and swaps eyes as the show requires. `clock_s`: time for automatic exposure.
  void finish_eyes(std::vector<Picture>& eyes, const CameraPose& pose, const Projection& projection, ViewMode mode,
                   const ShowMoment& moment, double clock_s);

  //! Stores the baseline of the current picture [M], and whether it is a reduced one.
  void note_baseline(const CameraPose& pose, double baseline);

  //! Returns the head's poses on the show's path while the shutter is open: an odd number, at equal
  //! intervals around `time_s`. `middle` is the pose at `time_s`; if it has no velocity, the
  //! results have none, and `middle` replaces those that are inside the horizon.
  [[nodiscard]] std::vector<CameraPose> shutter_poses(const CameraPose& middle, double time_s) const;
  //! Throws Error if the chosen integrator cannot trace the rays of a heat map from the camera's
  //! position.
  void require_rays_from(const CameraPose& pose) const;

  [[nodiscard]] PictureSettings picture_settings(const CameraPose& pose, ViewMode mode, const ShowMoment& moment,
                                                 double eye_offset) const;

  Show show_;
  LensChoice lens_;
  std::shared_ptr<StationStream> stream_;
  ShowSky sky_;
  ShowPasses passes_;
  EyeRenderer renderer_;
  OmniEyes omni_eyes_;
  double baseline_ = 0.0;  //!< baseline with which the last picture was rendered [M]
  std::optional<ReducedBaseline> reduced_baseline_;
  double exposure_stops_ = 0.0;
  double star_pixel_ = 0.0;            //!< set_stars_apart()
  double time_s_ = 0.0;                //!< show time of the current animated numbers
  std::optional<TraceMethod> method_;  //!< ViewChoice::method of the current pictures
  std::optional<ViewRange> range_;     //!< ViewChoice::range of the current pictures
};

}  // namespace ergodome
