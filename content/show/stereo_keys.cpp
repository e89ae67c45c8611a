#include <fmt/format.h>

#include "content/show/show_schema.h"
#include "content/timeline/timeline_reader.h"

namespace ergodome {

namespace {

constexpr auto unused_with_one_eye = [](const Show& show, const StereoSettings& /*stereo*/) {
  return eye_count(show.stereo) == 1
             ? "needs two eyes; layout = \"mono\" has one unless --stereo or a keystroke changes it"
             : nullptr;
};

constexpr auto fade_keys = keys_of<StereoSettings>(
    key<&StereoSettings::fade_from_deg>("from_deg")
        .range(0.0, 90.0)
        .unit("deg")
        .animated()
        .means("Model `omni`: elevation, up and down, from which the baseline shrinks."),
    key<&StereoSettings::fade_to_deg>("to_deg")
        .range(0.0, 90.0)
        .bounds("0 to 90, at least `from_deg` + 1")
        .unit("deg")
        .animated()
        .after([](TomlTable& table, StereoSettings& stereo) {
          if (!(stereo.fade_to_deg - stereo.fade_from_deg >= least_fade_deg)) {
            throw table.error_at(
                "to_deg",
                fmt::format("is {}, less than 1 degree above from_deg ({})", stereo.fade_to_deg, stereo.fade_from_deg),
                "make it at least 1 degree larger than from_deg");
          }
        })
        .means("Model `omni`: elevation at which the baseline is 0."));

constexpr auto keys_of_stereo = keys_of<StereoSettings>(
    key<&StereoSettings::layout>("layout")
        .words(stereo_layout_names)
        .means("How the pictures of the two eyes are arranged."),
    key<&StereoSettings::model>("model")
        .words(stereo_model_names)
        .unused_if(unused_with_one_eye)
        .means("Where the eyes are."),
    key<&StereoSettings::baseline>("baseline")
        .range(0.0, 1e6)
        .unit("M")
        .animated()
        .unused_if(unused_with_one_eye)
        .means("Distance between the eyes. Near the hole it is reduced to what fits."),
    key<&StereoSettings::convergence>("convergence")
        .range(1e-6, 1e9)
        .unit("M")
        .otherwise("absent: infinity")
        .animated()
        .unused_if(unused_with_one_eye)
        .written_if([](const StereoSettings& stereo) { return stereo.convergence > 0.0; })
        .means("Distance at which both eyes see things at the same position in the picture."),
    group<StereoSettings>("fade", fade_keys).unused_if([](const Show& show, const StereoSettings& stereo) {
      const char* const one_eye = unused_with_one_eye(show, stereo);
      return one_eye == nullptr && stereo.model != StereoModel::omni ? "is used only with model = \"omni\"" : one_eye;
    }),
    key<&StereoSettings::comfort_deg>("comfort_deg")
        .range(1e-3, 180.0)
        .unit("deg")
        .fixed("it describes the viewers, not the show")
        .unused_if(unused_with_one_eye)
        .means("Difference of disparities above which `play` warns."),
    key<&StereoSettings::swap_eyes>("swap_eyes").unused_if(unused_with_one_eye).means("Swaps the eyes."),
    key<&StereoSettings::tint_eyes>("tint_eyes")
        .unused_if(unused_with_one_eye)
        .means("Tints the left eye's picture red and the right one's cyan, to check which eye gets what."));

}  // namespace

constinit const KeyTable<StereoSettings> stereo_keys = keys_of_stereo;

}  // namespace ergodome
