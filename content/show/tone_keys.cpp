#include <fmt/format.h>

#include "content/show/show_schema.h"

namespace ergodome {

namespace {

constexpr auto automatic_keys = keys_of<AutoExposureSettings>(
    key<&AutoExposureSettings::target>("target")
        .range(1e-4, 1.0)
        .animated(changes_exposure)
        .means("Display light that the mean light of the picture is brought to."),
    key<&AutoExposureSettings::least_stops>("least_stops")
        .range(-40.0, 40.0)
        .unit("stops")
        .animated(changes_exposure)
        .means("Smallest change of the exposure."),
    key<&AutoExposureSettings::most_stops>("most_stops")
        .range(-40.0, 40.0)
        .bounds("-40 to 40, at least `least_stops`")
        .unit("stops")
        .animated(changes_exposure)
        .after([](TomlTable& table, AutoExposureSettings& automatic) {
          if (automatic.most_stops < automatic.least_stops) {
            throw table.error_at("most_stops", fmt::format("is {}, below least_stops", automatic.most_stops),
                                 fmt::format("choose {} or more", automatic.least_stops));
          }
        })
        .means("Largest change of the exposure."),
    key<&AutoExposureSettings::adapt_s>("adapt_s")
        .range(0.0, 1e3)
        .unit("s")
        .animated(changes_exposure)
        .means("Time in which all but 1/e of a change is followed."));

constexpr auto keys_of_tone = keys_of<ToneSettings>(
    key<&ToneSettings::curve>("curve").words(tone_curve_names).means("Tone curve. See below."),
    key<&ToneSettings::exposure_stops>("exposure_stops")
        .range(-40.0, 40.0)
        .unit("stops")
        .animated()
        .means("The light is multiplied by two to this power before the curve."),
    key<&ToneSettings::white>("white")
        .range(1e-3, 1e6)
        .animated()
        .unused_if([](const Show& /*show*/, const ToneSettings& tone) {
          return tone.curve != ToneCurve::reinhard ? "is used only with curve = \"reinhard\"" : nullptr;
        })
        .means("For `reinhard`: the light that is shown as white."),
    key<&ToneSettings::gamma>("gamma")
        .range(0.1, 10.0)
        .animated()
        .unused_if([](const Show& /*show*/, const ToneSettings& tone) {
          return tone.curve != ToneCurve::gamma ? "is used only with curve = \"gamma\"" : nullptr;
        })
        .means("For `gamma`: exponent of the curve."),
    table<&ToneSettings::automatic>("auto", automatic_keys).means("Automatic exposure. An empty table is enough."));

}  // namespace

constinit const KeyTable<ToneSettings> tone_keys = keys_of_tone;

}  // namespace ergodome
