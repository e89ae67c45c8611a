#include "app/commands/channels/channel_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "app/cli/backend_choice.h"
#include "app/cli/interrupt.h"
#include "app/cli/lens_options.h"
#include "app/cli/progress.h"
#include "app/commands/channels/channel_metadata.h"
#include "content/camera/camera_path.h"
#include "content/files/atomic_file.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "content/images/image_library.h"
#include "content/show/animated_show.h"
#include "content/sky/sky_map.h"
#include "render/channels/channel_files.h"
#include "render/eyes/view_projection.h"
#include "render/frame/show_renderer.h"
#include "render/output/frame_files.h"
#include "render/output/image_writer.h"
#include "render/passes/disk/disk_pass.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

bool contains(const std::vector<ChannelGroup>& groups, ChannelGroup group) {
  return std::ranges::find(groups, group) != groups.end();
}

std::string exr_compression(const RenderOptions& options) {
  return options.compression.empty() ? exr_compression_names().front() : options.compression;
}

//! Writes the channels of frames in one run.
class ChannelWriter {
 public:
  ChannelWriter(const RenderOptions& options, const Show& show, const FrameRequests& requests)
      : options_(options), show_(show), requests_(requests), groups_(channel_groups(options.channels)) {
    std::ranges::copy_if(groups_, std::back_inserter(traced_), [](ChannelGroup g) { return g != ChannelGroup::color; });
    if (contains(groups_, ChannelGroup::color)) {
      const Backend backend = choose_backend(options.backend);
      renderer_ = std::make_unique<ShowRenderer>(show, backend, lens_choice(options.lens),
                                                 open_stream(show, options.lens, backend));
      renderer_->overlays().set_language(options.language);
      for (const std::string& note : renderer_->notes()) {
        print_note_once(note);
      }
    }
  }

  //! Writes a frame and returns false. With --resume, if a complete file of the same request
  //! exists, keeps it and returns true.
  bool write(int frame) {
    const fs::path path = path_of(frame);
    if (options_.resume && is_there(path, frame)) {
      return true;
    }
    make_folder(path.parent_path());
    if (cleared_.insert(path.parent_path()).second) {
      remove_abandoned_files(path.parent_path());
    }
    const double time_s = frame_time_s(show_, frame);
    const Show now = show_at(show_, time_s);
    const ChannelScene scene = scene_of(now, time_s);
    const std::vector<PixelChannel> channels = channels_at(scene, time_s);
    std::vector<MetadataEntry> metadata = channel_metadata(now, frame, scene);
    metadata.push_back({"request", "REQUEST", requests_.at(time_s), ""});
    write(path, scene.projection, channels, metadata);
    return false;
  }

  [[nodiscard]] long unresolved() const { return unresolved_; }

 private:
  [[nodiscard]] fs::path path_of(int frame) const {
    return fs::path(options_.out) /
           frame_path(show_.name, frame, frame_count(show_), FramePart::whole, options_.format);
  }

  [[nodiscard]] Projection projection_of(const Show& show) const {
    return make_projection(show.view, options_.size_px > 0 ? options_.size_px : show.view.size_px, 0.0);
  }

  [[nodiscard]] bool is_there(const fs::path& path, int frame) const {
    const double time_s = frame_time_s(show_, frame);
    const std::string request = requests_.at(time_s);
    if (options_.format == "fits") {
      return image_library().whole_fits_text(path.string(), "REQUEST", channel_count()) == request;
    }
    const Projection projection = projection_of(show_at(show_, time_s));
    return metadata_of_image(path, "request") == request &&
           is_complete_image(path, projection.width_px, projection.height_px);
  }

  [[nodiscard]] int channel_count() const {
    std::size_t count = 0;
    for (const ChannelGroup group : groups_) {
      count += channels_of(group).size();
    }
    return static_cast<int>(count);
  }

  [[nodiscard]] ChannelScene scene_of(const Show& now, double time_s) const {
    ChannelScene scene{eye_camera(now, camera_pose(now, time_s), 0.0), projection_of(now)};
    if (now.disk) {
      scene.disk_inner = inner_edge(*now.disk, spacetime_of(now));
      scene.disk_outer = now.disk->outer;
    }
    scene.equatorial_from_sky = glm::transpose(sky_from_equatorial(now.sky));
    return scene;
  }

  //! Returns the channels of a frame in the order of --channels.
  [[nodiscard]] std::vector<PixelChannel> channels_at(const ChannelScene& scene, double time_s) {
    PixelChannels traced = trace_channels(scene, traced_, [] { return !interrupted(); });
    if (interrupted()) {
      throw Error("render", "stopped in the middle of a frame", "continue with --resume");
    }
    unresolved_ += traced.unresolved;
    std::vector<PixelChannel> channels;
    auto next = traced.channels.begin();
    for (const ChannelGroup group : groups_) {
      if (group == ChannelGroup::color) {
        add_light(scene.projection, time_s, channels);
        continue;
      }
      for (std::size_t i = channels_of(group).size(); i > 0; --i) {
        channels.push_back(std::move(*next++));
      }
    }
    return channels;
  }

  //! Renders the frame and adds its color channels.
  void add_light(const Projection& projection, double time_s, std::vector<PixelChannel>& channels) {
    ViewChoice choice;
    choice.size_px = projection.width_px;
    const Picture picture = std::move(renderer_->render(time_s, choice).front().picture);
    const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
    std::size_t component = 0;
    for (const ChannelMeaning& meaning : channels_of(ChannelGroup::color)) {
      PixelChannel channel{meaning, std::vector<double>(pixels)};
      for (std::size_t i = 0; i < pixels; ++i) {
        channel.values[i] = static_cast<double>(picture.rgba[4 * i + component]);
      }
      channels.push_back(std::move(channel));
      ++component;
    }
  }

  void write(const fs::path& path, const Projection& projection, const std::vector<PixelChannel>& channels,
             const std::vector<MetadataEntry>& metadata) const {
    if (options_.format == "fits") {
      return write_channel_fits(path, projection.width_px, projection.height_px, channels, picture_wcs(projection),
                                metadata);
    }
    const ExrCompression compression = frame_format("exr", exr_compression(options_), false).compression;
    write_channel_exr(path, compression, projection.width_px, projection.height_px, channels, metadata);
  }

  const RenderOptions& options_;
  const Show& show_;
  const FrameRequests& requests_;
  std::vector<ChannelGroup> groups_;
  std::vector<ChannelGroup> traced_;        //!< all groups except the light
  std::unique_ptr<ShowRenderer> renderer_;  //!< renders the light; null unless requested
  //! Folders already cleared of files that killed programs left.
  std::set<fs::path> cleared_;
  long unresolved_ = 0;
};

}  // namespace

void write_channel_frames(const RenderOptions& options, const Show& show, const FrameRequests& requests, int first,
                          int last) {
  make_folder(options.out);
  ChannelWriter writer(options, show, requests);
  if (options.format == "fits" && !picture_wcs(make_projection(show.view, 1024, 0.0))) {
    print_note_once(
        "FITS has no projection for these frames, so they have no world coordinates; "
        "add --channels direction for each pixel's direction");
  }
  Progress progress("rendering", last - first + 1);
  int there = 0;
  for (int frame = first; frame <= last; ++frame) {
    if (interrupted()) {
      throw Error("render", fmt::format("stopped after {}", counted(frame - first - there, "frame")),
                  "continue with --resume");
    }
    there += writer.write(frame) ? 1 : 0;
    progress.advance_to(frame - first + 1);
  }
  print_out("{} in {}{}\n", counted(last - first + 1 - there, "frame"), options.out,
            there > 0 ? fmt::format(", {} skipped", counted(there, "frame")) : "");
  if (writer.unresolved() > 0) {
    print_note("rays of {} did not converge; their values are NaN", counted(writer.unresolved(), "pixel"));
  }
}

}  // namespace ergodome
