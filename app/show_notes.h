#pragma once

#include <string>
#include <vector>

#include "content/show.h"

namespace ergodome {

//! Sentences about what a show names and nobody will see (ShowRenderer::notes()), or what cannot be read of its stars and objects. Reads their files, where
//! they are there.
std::vector<std::string> notes_of_files(const Show& show);

}  // namespace ergodome
