#include "content/show/show_schema.h"

#include <algorithm>

#include "content/show/key_table.h"
#include "content/timeline/frame_rate.h"
#include "content/timeline/local_text.h"

namespace ergodome {

namespace {

constexpr std::array scheme_names = {"conforming", "quadtree"};

constexpr auto hole_keys = keys_of<Show>(
    key<&Show::spin>(
        "spin", "Spin of the hole, a/M. See the [conditions for animated numbers](#conditions-for-animated-numbers).")
        .range(-1.0, 1.0, "M")
        .animated());

constexpr auto grid_keys = keys_of<Show>(
    key<&Show::grid_scheme>(
        "scheme", "Kind of [lens grid](../explanation/grids.md). `quadtree` is a published grid, for comparison.")
        .words(scheme_names));

constexpr auto quality_keys = keys_of<QualitySettings>(
    key<&QualitySettings::budget_px>(
        "budget_px",
        "Accepted error of the lens on the screen. A smaller budget loses fewer faint star images at the "
        "shadow's edge.")
        .range(1e-6, 100.0, "px")
        .fixed("a show is baked for a single budget"));

constexpr auto readout_keys = keys_of<ReadoutSettings>(
    key<&ReadoutSettings::position, &DomePosition::azimuth_deg>("azimuth_deg", "As for captions.")
        .range(-360.0, 360.0, "deg"),
    key<&ReadoutSettings::position, &DomePosition::elevation_deg>("elevation_deg", "As for captions.")
        .range(-90.0, 90.0, "deg"),
    key<&ReadoutSettings::letter_deg>("letter_deg", "Height of the line.").range(0.05, 45.0, "deg"));

//! Reads the title, which must fit one line in every language. Without one, it is the show's name.
constexpr auto read_title = [](TomlTable& root, Show& show) {
  const toml::node* const node = root.node("title");
  if (node == nullptr || !node->is_table()) {
    show.title = {{"", root.text("title", show.name)}};
    return;
  }
  show.title = read_local_text(root, "title");
  TomlTable languages = root.below(*node->as_table(), "title");
  for (const auto& [tag, words] : show.title) {
    languages.text(tag, "");
  }
};

constexpr auto write_title = [](toml::table& root, const Show& show) {
  if (!show.title.empty()) {
    add_local_text(show.title, "title", root);
  }
};

constexpr std::size_t max_objects = 256;

constexpr auto unused_light = [](const Show& show, const Show& /*settings*/) {
  return std::ranges::none_of(show.objects, &ObjectSettings::lit) ? "is used only by objects with light = \"lambert\""
                                                                  : nullptr;
};

// Only marks [camera] as a known key. read_camera() reads it later, when the numbers that it
// depends on are known.
constexpr auto read_camera_later = [](TomlTable& root, Show& /*show*/) { root.node("camera"); };

constexpr auto write_camera = [](toml::table& root, const Show& show) {
  root.insert("camera", written_settings(camera_keys(), show.camera));
};

}  // namespace

std::span<const ShowKey> show_keys() {
  static const auto all = keys_of<Show>(
      other<Show>("title", "Title of the show. `render` stores it in the frames, in the language of `--language`.")
          .by(read_title, write_title)
          .page({.type = "text", .otherwise = "the file's name", .bounds = "one line, 4096 bytes"}),
      key<&Show::duration_s>("duration_s", "Length of the show. 0 makes a still picture.")
          .range(0.0, 1e9, "s")
          .fixed("a show has only one duration"),
      key<&Show::frame_rate_hz>(
          "frame_rate_hz",
          "Frames per second. 23.976, 29.97, 47.952, 59.94 and 119.88 mean the exact rates, for example "
          "30000/1001.")
          .range(0.001, 1000.0, "1/s")
          .fixed("a show has only one frame rate")
          .after([](const TomlTable& /*root*/, Show& show) { show.frame_rate_hz = exact_rate_hz(show.frame_rate_hz); }),
      table<&Show::camera>("camera", camera_keys())
          .by(read_camera_later, write_camera)
          .fixed("to move the camera, write [[camera.key]]"),
      group<Show>("hole", hole_keys), table<&Show::sky>("sky", sky_keys), table<&Show::sky>("stars", star_keys),
      table<&Show::disk>("disk", disk_keys), table<&Show::effects>("effects", effect_keys),
      table<&Show::view>("view", view_keys), table<&Show::stereo>("stereo", stereo_keys),
      table<&Show::tone>("tone", tone_keys), table<&Show::shells>("shells", shell_keys, "", max_shells),
      table<&Show::flight>("flight", flight_keys), table<&Show::headset>("headset", headset_keys),
      group<Show>("grid", grid_keys), table<&Show::quality>("quality", quality_keys),
      table<&Show::readout>("readout", readout_keys), part<&Show::timeline>(timeline_keys),
      table<&Show::objects>("objects", object_keys, "", max_objects),
      table<&Show::light>("light", light_keys).unused_if(unused_light));
  return all.keys;
}

}  // namespace ergodome
