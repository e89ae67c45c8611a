#pragma once

#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Reads a show from a path, or a built-in one by its name ("first-light"), with the changes of
//! --set. Throws UsageError if these are invalid, and Error if the show is missing or invalid.
Show load_show(const std::string& name_or_path, const ShowSettings& settings = {});

//! Throws UsageError if `option`, which is for stereo, is given for a mono show.
void require_two_eyes(const Show& show, const std::string& option, bool given);

//! Prints a note if a show has two eyes that always see the same, because its baseline is always 0.
void report_equal_eyes(const Show& show);

//! Throws UsageError if a time is outside the show; `option` names it in the message.
void require_time(const std::string& option, const Show& show, double time_s);

//! Throws Error if the show needs a feature that this version cannot draw.
void require_features(const Show& show);

}  // namespace ergodome
