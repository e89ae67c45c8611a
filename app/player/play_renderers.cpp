#include "app/player/play_renderers.h"

#include <utility>
#include <vector>

#include "kernels/core/error.h"
#include "render/frame/show_renderer.h"

namespace ergodome {

namespace {

std::shared_ptr<ShowRenderer> made_renderer(const Show& show, Backend backend, const RendererWish& wish) {
  std::vector<std::string> notes;
  std::shared_ptr<StationStream> stream =
      open_stream(show, wish.lens, backend, [&](const std::string& note) { notes.push_back(note); });
  if (wish.tells_misses) {
    for (const std::string& note : stream_notes(stream.get(), show, wish.lens, backend, wish.size_px)) {
      notes.push_back(note);
    }
  }
  auto renderer = std::make_shared<ShowRenderer>(show, backend, lens_choice(wish.lens), std::move(stream));
  for (const std::string& note : renderer->notes()) {
    notes.push_back(note);
  }
  wish.notes->post(show.name, notes);
  return renderer;
}

}  // namespace

RendererLoader::Make renderer_maker(const RendererWish& wish) {
  return [wish](const Show& show) {
    try {
      return made_renderer(show, wish.backend, wish);
    } catch (const Error&) {
      if (wish.backend == Backend::cpu || !wish.may_fall_back) {
        throw;
      }
      return made_renderer(show, Backend::cpu, wish);  // the GPU is lost
    }
  };
}

RendererLoader::Make with_first(RendererLoader::Make make, const std::string& name,
                                std::shared_ptr<ShowRenderer> first) {
  const auto kept = std::make_shared<std::shared_ptr<ShowRenderer>>(std::move(first));
  return [make = std::move(make), name, kept](const Show& show) {
    return *kept && show.name == name ? std::exchange(*kept, nullptr) : make(show);
  };
}

}  // namespace ergodome
