#pragma once

#include <optional>

#include "app/budget/play_budget.h"
#include "app/player/player_session.h"
#include "app/player/renderers/picture_flow.h"
#include "app/player/renderers/scene_renderers.h"
#include "render/present/output.h"

namespace ergodome {

//! Requests the pictures of a session from its renderer, within a budget, and passes them to an
//! output. Rebuilds a renderer that hangs or keeps failing.
class SessionPictures {
 public:
  //! `make` makes the renderer of a show. `size_px` is the width of one eye's image while nothing
  //! moves. The output must outlive this.
  SessionPictures(const RendererLoader::Make& make, Output& output, int size_px, const std::optional<PlayPlan>& plan);

  //! Lets a gate decide when pictures are shown; see PictureFlow::set_gate().
  void set_gate(PictureGate* gate) { flow_.set_gate(gate); }

  [[nodiscard]] SceneRenderers& renderers() { return renderers_; }
  [[nodiscard]] const SceneRenderers& renderers() const { return renderers_; }
  [[nodiscard]] const PictureReport& report() const { return flow_.report(); }
  [[nodiscard]] const std::optional<PlayBudget>& budget() const { return budget_; }

  //! Takes a finished picture and requests the next one from the current renderer, which must
  //! exist; called once per frame. The renderer, the disparity and the settings of the budget in
  //! `wish` are chosen here. `changed`: the request differs from the last, besides session and
  //! output.
  PictureNews advance(const PlayerSession& session, PictureRequest wish, bool changed);

  //! Calls SceneRenderers::advance() for `show` and returns its result: whether another renderer is
  //! in use, or why there is none.
  SceneRenderers::News take_renderer(const Show& show);

  //! Returns whether to show the output now, at a factor on its light: always if a GPU renders and
  //! there is no frame rate to hold; otherwise for each new picture, each change of the light, and
  //! a tenth of a second after it was last shown, because texts may have changed.
  [[nodiscard]] bool shows_now(double now_s, double light);

 private:
  void add_budget(PictureRequest& wish, double now_s);
  void note_budget(double now_s);

  SceneRenderers renderers_;
  PictureFlow flow_;
  std::optional<PlayBudget> budget_;
  std::optional<ImageSize> window_;  //!< last size of the window
  //! The parts of a viewer's head that pictures depend on.
  struct PictureHead {
    explicit PictureHead(const ViewerHead& head)
        : turn(head.turn), offset_m(head.offset_m), eye_distance_m(head.eye_distance_m) {}
    bool operator==(const PictureHead&) const = default;
    glm::dquat turn;
    glm::dvec3 offset_m;
    double eye_distance_m;
  };
  std::optional<PictureHead> head_;  //!< of the last request
  int failures_ = 0;                 //!< consecutive pictures that failed
  long shown_pictures_ = -1;         //!< number of pictures when the output was last shown
  double shown_s_ = 0.0;             //!< when the output was last shown
  double shown_light_ = 1.0;         //!< factor on the light when it was last asked for
};

}  // namespace ergodome
