#include "app/player/renderers/play_renderers.h"

#include <algorithm>
#include <set>
#include <utility>

#include "app/playback/playback.h"
#include "kernels/core/error.h"
#include "render/frame/show_renderer.h"

namespace ergodome {

namespace {

std::shared_ptr<ShowRenderer> made_renderer(const Show& show, Backend backend, const RendererWish& wish) {
  const auto reading = std::make_shared<std::set<std::string>>();
  // The stream's thread reports unreadable stations as long as the stream exists.
  const NoteSink report = [board = wish.notes, reading](const std::string& note) { board->add(reading, note); };
  std::shared_ptr<StationStream> stream = open_stream(show, wish.lens, backend, report);
  if (wish.reports_misses) {
    std::ranges::for_each(stream_notes(stream.get(), show, wish.lens, backend, wish.size_px), report);
  }
  auto renderer = std::make_shared<ShowRenderer>(show, backend, lens_choice(wish.lens), std::move(stream));
  std::ranges::for_each(renderer->notes(), report);
  if (const std::string note = language_note(show.name, show.timeline, wish.language); !note.empty()) {
    report(note);
  }
  wish.notes->supersede(show.name, reading);
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
