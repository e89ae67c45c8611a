#include <fmt/format.h>

#include "content/show/show_schema.h"

namespace ergodome {

namespace {

constexpr auto unused_with_one_eye = [](const Show& show, const StereoSettings& /*stereo*/) {
  return eye_count(show.stereo) == 1
             ? "needs two eyes; layout = \"mono\" has one unless --stereo or a keystroke changes it"
             : nullptr;
};

constexpr auto fade_keys = keys_of<StereoSettings>(
    key<&StereoSettings::fade_from_deg>("from_deg",
                                        "Model `omni`: elevation, up and down, from which the baseline shrinks.")
        .range(0.0, 90.0, "deg")
        .animated(),
    key<&StereoSettings::fade_to_deg>("to_deg", "Model `omni`: elevation at which the baseline is 0.")
        .range(0.0, 90.0, "deg")
        .animated()
        .after([](TomlTable& table, StereoSettings& stereo) {
          if (!(stereo.fade_to_deg - stereo.fade_from_deg >= min_fade_deg)) {
            throw table.error_at(
                "to_deg",
                fmt::format("is {}, less than 1 degree above from_deg ({})", stereo.fade_to_deg, stereo.fade_from_deg),
                "make it at least 1 degree larger than from_deg");
          }
        })
        .page({.bounds = "0 to 90, at least `from_deg` + 1"}));

constexpr auto keys_of_stereo = keys_of<StereoSettings>(
    key<&StereoSettings::layout>("layout", "How the pictures of the two eyes are arranged.").words(stereo_layout_names),
    key<&StereoSettings::model>("model", "Where the eyes are.")
        .words(stereo_model_names)
        .unused_if(unused_with_one_eye),
    key<&StereoSettings::baseline>("baseline", "Distance between the eyes. Near the hole it is reduced to what fits.")
        .range(0.0, 1e6, "M")
        .animated()
        .unused_if(unused_with_one_eye),
    key<&StereoSettings::convergence>("convergence",
                                      "Distance at which both eyes see things at the same position in the picture.")
        .range(1e-6, 1e9, "M")
        .animated()
        .unused_if(unused_with_one_eye)
        .written_if([](const StereoSettings& stereo) { return stereo.convergence > 0.0; })
        .page({.otherwise = "absent: infinity"}),
    group<StereoSettings>("fade", fade_keys).unused_if([](const Show& show, const StereoSettings& stereo) {
      const char* const one_eye = unused_with_one_eye(show, stereo);
      return one_eye == nullptr && stereo.model != StereoModel::omni ? "is used only with model = \"omni\"" : one_eye;
    }),
    key<&StereoSettings::comfort_deg>("comfort_deg", "Difference of disparities above which `play` warns.")
        .range(1e-3, 180.0, "deg")
        .fixed("it describes the viewers, not the show")
        .unused_if(unused_with_one_eye),
    key<&StereoSettings::swap_eyes>("swap_eyes", "Swaps the eyes.").unused_if(unused_with_one_eye),
    key<&StereoSettings::tint_eyes>(
        "tint_eyes", "Tints the left eye's picture red and the right one's cyan, to check which eye gets what.")
        .unused_if(unused_with_one_eye));

}  // namespace

constinit const KeyTable<StereoSettings> stereo_keys = keys_of_stereo;

}  // namespace ergodome
