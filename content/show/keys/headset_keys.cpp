#include "content/show/show_schema.h"

namespace ergodome {

namespace {

constexpr auto keys_of_headset = keys_of<HeadsetSettings>(
    key<&HeadsetSettings::stereo>("stereo", "Where the eyes are. `mono`: both at the position of the head.")
        .words(headset_stereo_names),
    key<&HeadsetSettings::scale>("scale",
                                 "Length in the show for one meter of the viewer's room. 0: a tenth of the distance "
                                 "to the horizon (see below).")
        .range(0.0, 1e6, "M/m"),
    key<&HeadsetSettings::rest_frame>("rest_frame", "A ring and a floor grid that are fixed in the viewer's room."),
    key<&HeadsetSettings::vignette>("vignette", "Strength of the vignette while the camera moves. 0: none.")
        .range(0.0, 1.0),
    key<&HeadsetSettings::fade_s>("fade_s",
                                  "Duration of the fade through black at cuts, jumps in time and snap turns. 0: none.")
        .range(0.0, 5.0, "s"),
    key<&HeadsetSettings::snap_turn_deg>("snap_turn_deg", "Angle of a snap turn. 0: the view turns smoothly instead.")
        .range(0.0, 90.0, "deg"),
    key<&HeadsetSettings::exposure_rate>("exposure_rate", "Fastest change of the exposure. 0: no limit.")
        .range(0.0, 1e3, "stops/s"),
    key<&HeadsetSettings::panel>("panel", "Captions and help on a panel in the viewer's room."));

}  // namespace

constinit const KeyTable<HeadsetSettings> headset_keys = keys_of_headset;

}  // namespace ergodome
