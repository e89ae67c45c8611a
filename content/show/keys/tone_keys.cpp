#include <fmt/format.h>

#include "content/show/show_schema.h"

namespace ergodome {

namespace {

constexpr auto automatic_keys = keys_of<AutoExposureSettings>(
    key<&AutoExposureSettings::target>("target", "Display light that the mean light of the picture is brought to.")
        .range(1e-4, 1.0)
        .animated(changes_exposure),
    key<&AutoExposureSettings::least_stops>("least_stops", "Smallest change of the exposure.")
        .range(-40.0, 40.0, "stops")
        .animated(changes_exposure),
    key<&AutoExposureSettings::most_stops>("most_stops", "Largest change of the exposure.")
        .range(-40.0, 40.0, "stops")
        .animated(changes_exposure)
        .after([](TomlTable& table, AutoExposureSettings& automatic) {
          if (automatic.most_stops < automatic.least_stops) {
            throw table.error_at("most_stops", fmt::format("is {}, below least_stops", automatic.most_stops),
                                 fmt::format("choose {} or more", automatic.least_stops));
          }
        })
        .page({.bounds = "-40 to 40, at least `least_stops`"}),
    key<&AutoExposureSettings::adapt_s>("adapt_s", "Time in which all but 1/e of a change is followed.")
        .range(0.0, 1e3, "s")
        .animated(changes_exposure));

constexpr auto keys_of_tone = keys_of<ToneSettings>(
    key<&ToneSettings::curve>("curve", "Tone curve. See below.").words(tone_curve_names),
    key<&ToneSettings::exposure_stops>("exposure_stops",
                                       "The light is multiplied by two to this power before the curve.")
        .range(-40.0, 40.0, "stops")
        .animated(),
    key<&ToneSettings::white>("white", "For `reinhard`: the light that is shown as white.")
        .range(1e-3, 1e6)
        .animated()
        .unused_if([](const Show& /*show*/, const ToneSettings& tone) {
          return tone.curve != ToneCurve::reinhard ? "is used only with curve = \"reinhard\"" : nullptr;
        }),
    key<&ToneSettings::gamma>("gamma", "For `gamma`: exponent of the curve.")
        .range(0.1, 10.0)
        .animated()
        .unused_if([](const Show& /*show*/, const ToneSettings& tone) {
          return tone.curve != ToneCurve::gamma ? "is used only with curve = \"gamma\"" : nullptr;
        }),
    table<&ToneSettings::automatic>("auto", automatic_keys, "Automatic exposure. An empty table is enough."));

}  // namespace

constinit const KeyTable<ToneSettings> tone_keys = keys_of_tone;

}  // namespace ergodome
