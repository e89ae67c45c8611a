#include "render/present/projectors/projector_windows.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "kernels/core/error.h"
#include "render/opengl/gl_program.h"
#include "render/opengl/headless_context.h"
#include "render/output/image_writer.h"
#include "render/present/caption_texture.h"
#include "render/present/projectors/projector_drawing.h"
#include "render/present/projectors/projector_outputs.h"
#include "render/present/projectors/projector_window.h"
#include "render/present/projectors/raster_texture.h"
#include "render/present/projectors/software_projectors.h"
#include "render/present/text_panel.h"

namespace ergodome {

namespace {

//! A projector's window and its drawing objects. Its context must be current when any of them is
//! destroyed.
struct Screen {
  std::unique_ptr<ProjectorWindow> window;
  std::unique_ptr<ProjectorDrawing> drawing;
  std::unique_ptr<TextPanel> panel;
  std::unique_ptr<Presenter> raster;    //!< shows a raster instead of the projector's image, if set
  std::unique_ptr<RasterTexture> sent;  //!< the image that kernels drew, if OpenGL does not draw it
  //! True if the warp was changed since the windows were opened, or may be (WarpUse::adjusted). It
  //! is then drawn by OpenGL, because kernels need a second of CPU time to prepare a warp.
  bool changed = false;
};

//! Copies a domemaster from the GPU to host memory. With software OpenGL, this is an ordinary copy.
Picture brought_back(const PresentedPicture& shown) {
  Picture picture;
  picture.width = shown.width;
  picture.height = shown.height;
  picture.tone = shown.tone;
  if (shown.heat_map) {
    picture.heat_range.emplace();
  }
  picture.rgba.assign(4 * static_cast<std::size_t>(shown.width) * static_cast<std::size_t>(shown.height), 0.0F);
  glGetTextureImage(shown.texture, 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(picture.rgba.size() * sizeof(float)),
                    picture.rgba.data());
  return picture;
}

//! Moves the control window out from under the projectors' windows on its monitor, if there is
//! room.
void uncover(Window& control, const DomeSetup& setup) {
  if (const auto position = rectangle_beside_projectors(control.rectangle(), setup, connected_monitors())) {
    control.move_to(*position);
  }
}

}  // namespace

struct ProjectorWindows::State {
  Window& control;
  std::unique_ptr<DisplayLight> light;
  std::vector<Screen> screens;
  std::vector<ProjectorPicture> pictures;
  //! draws on the CPU; set if OpenGL has no GPU and warps are fixed
  std::unique_ptr<SoftwareProjectors> software;
  //! Draws with CUDA; set when CUDA has rendered a picture.
  std::unique_ptr<SoftwareProjectors> cuda;
  //! True if the light of the current picture was computed by CUDA.
  bool in_cuda = false;
  bool cuda_fails = false;
  //! Number of successive pictures whose size is not that of CUDA's warps.
  int of_another_size = 0;
  bool control_shown = true;
  long version = -1;        //!< version of the last domemaster that was drawn
  long light_version = -1;  //!< version of the last domemaster whose display light OpenGL computed
  float dimmed = 1.0F;      //!< factor on the display's light
  //! Captions that are drawn over the domemaster.
  std::unique_ptr<CaptionTexture> captions = std::make_unique<CaptionTexture>();
};

ProjectorWindows::ProjectorWindows(Window& control, const DomeSetup& setup,
                                   const std::vector<ProjectorPicture>& pictures, bool hide_control, WarpUse use)
    : state_(std::make_unique<State>(State{control, nullptr, {}, pictures, nullptr, nullptr})) {
  require_outputs(setup, connected_monitors());
  const int monitor = free_monitor(setup);
  state_->control_shown = !hide_control && monitor >= 0;
  if (state_->control_shown) {
    control.move_to_monitor(monitor);
  } else {
    control.hide();
  }
  control.make_current();
  if (!pictures.empty()) {
    // The first projector's window waits for its display instead.
    control.swap_at_once();
  }
  state_->light = std::make_unique<DisplayLight>();
  if (draws_in_software() && use == WarpUse::fixed) {
    state_->software = std::make_unique<SoftwareProjectors>(pictures);
  }
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    Screen screen;
    screen.window = std::make_unique<ProjectorWindow>(control, setup.projectors[i],
                                                      i == 0 ? SwapTiming::in_step : SwapTiming::at_once);
    screen.drawing = std::make_unique<ProjectorDrawing>(pictures[i]);
    screen.panel = std::make_unique<TextPanel>();
    screen.changed = use == WarpUse::adjusted;
    state_->screens.push_back(std::move(screen));
  }
  control.make_current();
  if (state_->control_shown) {
    uncover(control, setup);
    control.keep_in_front();
  }
}

ProjectorWindows::~ProjectorWindows() {
  for (Screen& screen : state_->screens) {
    screen.window->make_current();
    screen.sent.reset();
    screen.raster.reset();
    screen.panel.reset();
    screen.drawing.reset();
    screen.window.reset();
  }
  state_->control.make_current();
  state_->light.reset();
  state_->captions.reset();
}

void ProjectorWindows::draw(std::size_t projector) {
  Screen& screen = state_->screens[projector];
  screen.window->make_current();
  int width = 0;
  int height = 0;
  screen.window->framebuffer_size(width, height);
  if (screen.raster) {
    screen.raster->draw(width, height);
  } else if (screen.sent) {
    screen.sent->draw();
  } else {
    screen.drawing->draw(*state_->light, width, height);
  }
  if (!screen.raster) {
    screen.drawing->draw_captions(*state_->captions, state_->dimmed, *state_->light, width, height);
  }
  screen.panel->draw(width, height);
}

void ProjectorWindows::take(const DevicePicture* picture) {
  state_->in_cuda = false;
  if (picture == nullptr || picture->right != nullptr || state_->cuda_fails) {
    return;
  }
  try {
    if (!state_->cuda) {
      state_->cuda = std::make_unique<SoftwareProjectors>(state_->pictures, Backend::cuda);
    }
    // Number of pictures of another size after which CUDA computes warps for that size, which takes
    // a second of CPU time. Until then, OpenGL draws.
    constexpr int patience = 120;
    if (state_->cuda->has_other_warps(picture->width_px, picture->height_px) && ++state_->of_another_size < patience) {
      return;
    }
    state_->of_another_size = 0;
    state_->cuda->show_in_place(
        {picture->rgba, picture->width_px, picture->height_px, picture->heat_map, picture->tone});
    wait_for_device(Backend::cuda);
    state_->in_cuda = true;
  } catch (const Error&) {
    give_up_cuda();
  }
}

void ProjectorWindows::give_up_cuda() {
  state_->cuda.reset();
  state_->in_cuda = false;
  state_->cuda_fails = true;
}

bool ProjectorWindows::may_draw_by_kernels(std::size_t projector) const {
  int width = 0;
  int height = 0;
  state_->screens[projector].window->framebuffer_size(width, height);
  const ProjectorPicture& picture = state_->pictures[projector];
  return !state_->screens[projector].changed && width == picture.width_px && height == picture.height_px;
}

void ProjectorWindows::send(std::size_t projector) {
  const ProjectorPicture& picture = state_->pictures[projector];
  Screen& screen = state_->screens[projector];
  screen.window->make_current();
  if (!screen.sent) {
    screen.sent = std::make_unique<RasterTexture>(picture.width_px, picture.height_px);
  }
  if (state_->in_cuda) {
    screen.sent->upload_from_device(state_->cuda->raster(projector));
  } else {
    screen.sent->upload(state_->software->frame(projector).data());
  }
}

bool ProjectorWindows::update_by_cuda(const PresentedPicture& master, const std::vector<std::size_t>& by_kernels) {
  if (!state_->in_cuda || by_kernels.empty()) {
    return false;
  }
  try {
    state_->cuda->set_light(master.light);
    state_->cuda->draw_in_place();
    for (const std::size_t i : by_kernels) {
      send(i);
    }
    return true;
  } catch (const Error&) {
    give_up_cuda();
    return false;
  }
}

void ProjectorWindows::update(const PresentedPicture& master) {
  std::vector<std::size_t> by_kernels;
  for (std::size_t i = 0; i < state_->screens.size(); ++i) {
    if (may_draw_by_kernels(i)) {
      by_kernels.push_back(i);
    }
  }
  const bool by_cuda = update_by_cuda(master, by_kernels);
  if (!by_cuda && (!state_->software || master.texture == 0)) {
    by_kernels.clear();
  }
  if (!by_cuda && !by_kernels.empty()) {
    state_->control.make_current();
    state_->software->show(brought_back(master));
    state_->software->set_light(master.light);
    for (const std::size_t i : by_kernels) {
      send(i);
    }
  }
  leave_others_to_opengl(master, by_kernels);
}

void ProjectorWindows::leave_others_to_opengl(const PresentedPicture& master,
                                              const std::vector<std::size_t>& by_kernels) {
  for (std::size_t i = 0; i < state_->screens.size(); ++i) {
    if (state_->screens[i].sent && std::ranges::find(by_kernels, i) == by_kernels.end()) {
      state_->screens[i].window->make_current();
      state_->screens[i].sent.reset();
    }
  }
  state_->control.make_current();
  if (by_kernels.size() < state_->screens.size()) {
    update_light(master);
  }
}

void ProjectorWindows::update_light(const PresentedPicture& master) {
  state_->light->update(master);
  state_->light_version = master.version;
}

void ProjectorWindows::lay_over(const LaidCaptions& captions) {
  state_->control.make_current();
  state_->captions->set(captions);
}

void ProjectorWindows::draw_by_opengl(std::size_t projector) {
  Screen& screen = state_->screens[projector];
  screen.sent.reset();
  screen.changed = true;
  state_->version = -1;  // makes show() compute the light for OpenGL, which may not have it yet
}

void ProjectorWindows::show(const PresentedPicture& master) {
  state_->control.make_current();
  if (master.version != state_->version) {
    update(master);
    state_->version = master.version;
  }
  if (!state_->captions->empty() && state_->light_version != master.version) {
    update_light(master);
  }
  state_->dimmed = master.light;
  for (std::size_t i = 0; i < state_->screens.size(); ++i) {
    draw(i);
  }
  // Only the first window's swap waits for its display. The others swap at once, because
  // synchronized displays have the same timing.
  for (const Screen& screen : state_->screens) {
    screen.window->make_current();
    screen.window->swap();
  }
  state_->control.make_current();
}

void ProjectorWindows::change(std::size_t projector, const ProjectorPicture& picture) {
  const Screen& screen = state_->screens[projector];
  screen.window->make_current();
  draw_by_opengl(projector);
  screen.drawing->set_warp(picture.warp, picture.offsets);
  screen.drawing->set_colour(picture);
  state_->control.make_current();
}

void ProjectorWindows::replace(std::size_t projector, const ProjectorPicture& picture) {
  Screen& screen = state_->screens[projector];
  screen.window->make_current();
  draw_by_opengl(projector);
  screen.drawing = std::make_unique<ProjectorDrawing>(picture);
  state_->control.make_current();
}

void ProjectorWindows::set_text(std::size_t projector, const std::string& text) {
  const Screen& screen = state_->screens[projector];
  screen.window->make_current();
  int width = 0;
  int height = 0;
  screen.window->framebuffer_size(width, height);
  screen.panel->set(text, std::clamp(height / 30, 12, 48), TextFace::proportional, width);
  state_->control.make_current();
}

void ProjectorWindows::set_raster(std::size_t projector, const Picture* raster) {
  Screen& screen = state_->screens[projector];
  screen.window->make_current();
  screen.raster.reset();
  if (raster != nullptr) {
    screen.raster = std::make_unique<Presenter>();
    screen.raster->upload(*raster);
  }
  state_->control.make_current();
}

std::string ProjectorWindows::join_swap_group(bool joined) {
  std::string problem;
  for (const Screen& screen : state_->screens) {
    screen.window->make_current();
    const std::string one = screen.window->join_swap_group(joined);
    problem = problem.empty() ? one : problem;
  }
  state_->control.make_current();
  return problem;
}

std::vector<WindowEvent> ProjectorWindows::events() {
  std::vector<WindowEvent> all;
  for (const Screen& screen : state_->screens) {
    const std::vector<WindowEvent> some = screen.window->events();
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

bool ProjectorWindows::closed() const {
  return std::ranges::any_of(state_->screens, [](const Screen& screen) { return screen.window->closed(); });
}

bool ProjectorWindows::control_shown() const { return state_->control_shown; }

void ProjectorWindows::save_screenshots(const std::filesystem::path& file, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < state_->screens.size(); ++i) {
    draw(i);
    int width = 0;
    int height = 0;
    state_->screens[i].window->framebuffer_size(width, height);
    std::filesystem::path path = file;
    path.replace_filename(file.stem().string() + "_" + names[i] + ".png");
    write_png(path, read_framebuffer(width, height), width, height);
  }
  state_->control.make_current();
}

}  // namespace ergodome
